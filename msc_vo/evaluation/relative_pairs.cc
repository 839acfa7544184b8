// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/relative_pairs.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

using Pairs = std::vector<std::pair<int, int>>;

constexpr double kMaxPathDeviation = 0.1;  // of delta

Pairs PairsByIndex(int count, int delta, bool all_pairs) {
  Pairs pairs;
  for (int i = 0; i + delta < count; i += all_pairs ? 1 : delta) pairs.emplace_back(i, i + delta);
  return pairs;
}

Pairs ConsecutivePairsByPath(const std::vector<double>& path, double delta) {
  Pairs pairs;
  int previous = -1;
  double start = 0.0;
  for (size_t i = 0; i < path.size(); ++i) {
    if (path[i] - start < delta) continue;
    if (previous >= 0) pairs.emplace_back(previous, static_cast<int>(i));
    previous = static_cast<int>(i);
    start = path[i];
  }
  return pairs;
}

// Index after `from` whose value, of ascending ones, is closest to `target`; -1 if there is none.
int ClosestAfter(const std::vector<double>& values, int from, double target) {
  const auto first = values.begin() + from + 1;
  if (first == values.end()) return -1;
  auto closest = std::lower_bound(first, values.end(), target);
  const bool lower_is_closer =
      closest == values.end() || (closest != first && target - *(closest - 1) <= *closest - target);
  if (lower_is_closer) --closest;
  return static_cast<int>(closest - values.begin());
}

Pairs PairsByValue(const std::vector<double>& values, double delta, double tolerance,
                   bool all_pairs) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(values.size());) {
    const int j = ClosestAfter(values, i, values[i] + delta);
    const bool found = j >= 0 && std::abs(values[j] - values[i] - delta) <= tolerance;
    if (found) pairs.emplace_back(i, j);
    i = found && !all_pairs ? j : i + 1;
  }
  return pairs;
}

}  // namespace

std::string RelativeDelta::Problem() const {
  if (unit != DeltaUnit::kFrames) return value > 0.0 ? "" : "must be positive";
  const bool is_count = value >= 1.0 && value <= 1e9 && value == std::floor(value);
  return is_count ? "" : "must be a whole number of frames, 1 or more";
}

std::vector<double> PathLengths(const std::vector<Eigen::Vector3d>& positions) {
  std::vector<double> lengths;
  for (size_t i = 0; i < positions.size(); ++i) {
    lengths.push_back(i == 0 ? 0.0 : lengths.back() + (positions[i] - positions[i - 1]).norm());
  }
  return lengths;
}

std::vector<std::pair<int, int>> FindRelativePairs(const std::vector<double>& stamps,
                                                   const std::vector<Eigen::Vector3d>& positions,
                                                   const RelativeDelta& delta, double tolerance) {
  switch (delta.unit) {
    case DeltaUnit::kFrames:
      return PairsByIndex(static_cast<int>(stamps.size()), static_cast<int>(delta.value),
                          delta.all_pairs);
    case DeltaUnit::kMetres: {
      const std::vector<double> path = PathLengths(positions);
      if (!delta.all_pairs) return ConsecutivePairsByPath(path, delta.value);
      return PairsByValue(path, delta.value, kMaxPathDeviation * delta.value, true);
    }
    case DeltaUnit::kSeconds:
      return PairsByValue(stamps, delta.value, tolerance, delta.all_pairs);
  }
  return {};
}

}  // namespace msc_vo
