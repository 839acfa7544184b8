// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Counts, for each keyframe, how many of the given landmarks it observes. Ids are dense, so that a
/// table serves with one step per observation.
class ObserverCount {
 public:
  /// Counts observations by the keyframes of `map`.
  explicit ObserverCount(const Map& map);

  void Add(const Landmark& landmark);

  /// Keyframes with at least one landmark, most landmarks first, then newest first.
  std::vector<Map::Covisible> Ranked() const;

 private:
  KeyframeId first_ = 0;
  std::vector<int> counts_;  // of keyframes first_, first_ + 1, ...
};

}  // namespace msc_vo
