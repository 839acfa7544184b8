// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Maps that frames are not tracked in. Any thread may read them.
using InactiveMaps = std::vector<std::shared_ptr<const Map>>;

/// The map of `maps` that contains or contained the keyframe; nullptr if there is none.
inline const Map* FindMapOf(const InactiveMaps& maps, KeyframeId keyframe) {
  for (const std::shared_ptr<const Map>& map : maps) {
    if (map->KnowsKeyframe(keyframe)) return map.get();
  }
  return nullptr;
}

}  // namespace msc_vo
