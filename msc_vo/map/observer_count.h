// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"

namespace msc_vo {

// Counts how many of some landmarks each keyframe observes. Ids are dense enough for a table: one
// step per observation, as this is done for hundreds of landmarks at every frame.
class ObserverCount {
 public:
  // Counts observations by the keyframes that `map` has now.
  explicit ObserverCount(const Map& map);

  void Add(const Landmark& landmark);

  // Keyframes that were counted, most landmarks first, then newest first.
  std::vector<Map::Covisible> Ranked() const;

 private:
  KeyframeId first_ = 0;
  std::vector<int> counts_;  // of keyframes first_, first_ + 1, ...
};

}  // namespace msc_vo
