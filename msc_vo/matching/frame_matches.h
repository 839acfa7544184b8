// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/map/landmark_kinds.h"

namespace msc_vo {

/// The match of one feature of a frame with a landmark of the map, or with a feature of another
/// frame that has a measured depth (id == kNoId).
struct PointMatch {
  int feature = 0;
  LandmarkId id = kNoId;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  bool inlier = true;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, feature, id, position, inlier);
  }
};

struct LineMatch {
  int feature = 0;
  LandmarkId id = kNoId;
  LineSegment3 segment{};  ///< metres, world
  bool inlier = true;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, feature, id, segment, inlier);
  }
};

/// Number of points that a line counts as: with its depth it constrains four of the six degrees of
/// freedom of a pose, and the pixel of a point two.
constexpr int kPointsPerLine = 2;

/// The matches of one frame; each feature occurs at most once.
struct FrameMatches {
  std::vector<PointMatch> points;
  std::vector<LineMatch> lines;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, points, lines);
  }
};

}  // namespace msc_vo
