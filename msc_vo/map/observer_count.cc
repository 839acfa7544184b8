// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/observer_count.h"

#include <algorithm>

namespace msc_vo {

ObserverCount::ObserverCount(const Map& map) {
  if (map.keyframes().empty()) return;
  first_ = map.keyframes().front().first;
  counts_.assign(map.keyframes().back().first - first_ + 1, 0);
}

void ObserverCount::Add(const Landmark& landmark) {
  for (const Observation& observation : landmark.observations) {
    ++counts_[observation.keyframe - first_];
  }
}

std::vector<Map::Covisible> ObserverCount::Ranked() const {
  std::vector<Map::Covisible> ranked;
  for (size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0) ranked.push_back({first_ + static_cast<KeyframeId>(i), counts_[i]});
  }
  std::sort(ranked.begin(), ranked.end(), [](const Map::Covisible& a, const Map::Covisible& b) {
    return a.num_shared != b.num_shared ? a.num_shared > b.num_shared : a.keyframe > b.keyframe;
  });
  return ranked;
}

}  // namespace msc_vo
