// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Constant-time lookup of selected keyframes of a map by id. Valid until the next change of the
/// map.
class KeyframeIndex {
 public:
  explicit KeyframeIndex(const Map& map) {
    if (map.keyframes().empty()) return;
    first_ = map.keyframes().front().first;
    keyframes_.resize(map.keyframes().back().first - first_ + 1, nullptr);
  }

  void Add(const Keyframe& keyframe) { keyframes_[keyframe.id - first_] = &keyframe; }

  /// Returns nullptr if the keyframe was not added. `id` must belong to a keyframe of the map.
  const Keyframe* Find(KeyframeId id) const { return keyframes_[id - first_]; }

 private:
  KeyframeId first_ = 0;
  std::vector<const Keyframe*> keyframes_;  // first_, first_ + 1, ...
};

}  // namespace msc_vo
