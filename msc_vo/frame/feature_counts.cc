// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/feature_counts.h"

#include <algorithm>
#include <vector>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

constexpr int kMinLines = 5;
// Lines do not constrain the position along their direction. With two directions at 30 degrees, the
// position along their bisector is a quarter as certain as across it (tan 15 degrees).
constexpr double kMinAngle = DegreesToRadians(30.0);

bool HasTwoDirections(const std::vector<Eigen::Vector3d>& directions) {
  return std::any_of(directions.begin(), directions.end(), [&](const Eigen::Vector3d& direction) {
    return UndirectedAngle(directions.front(), direction) >= kMinAngle;
  });
}

}  // namespace

int NumWithDepth(const Frame& frame) {
  int count = 0;
  ForEachFeatures(frame, [&](const auto& features) {
    for (const auto& feature : features) count += feature.HasDepth();
  });
  return count;
}

bool HasDynamicFeatures(const Frame& frame) {
  bool any = false;
  ForEachFeatures(frame, [&](const auto& features) {
    any = any || std::any_of(features.begin(), features.end(),
                             [](const auto& feature) { return feature.dynamic; });
  });
  return any;
}

bool CanBeginMap(const Frame& frame, int min_features) {
  if (NumWithDepth(frame) >= min_features) return true;
  std::vector<Eigen::Vector3d> directions;
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    if (!frame.lines[i].depth) continue;
    directions.push_back(frame.LineInCamera(static_cast<int>(i)).Direction());
  }
  return directions.size() >= kMinLines && HasTwoDirections(directions);
}

}  // namespace msc_vo
