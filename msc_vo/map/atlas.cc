// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/atlas.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

const Map* FindMapOf(const InactiveMaps& maps, KeyframeId keyframe) {
  for (const std::shared_ptr<const Map>& map : maps) {
    if (map->KnowsKeyframe(keyframe)) return map.get();
  }
  return nullptr;
}

bool IsOlder(const Map& a, const Map& b) {
  return a.keyframes().front().first < b.keyframes().front().first;
}

void Atlas::Begin(bool keep_current) {
  Map next = current_.Next();
  if (keep_current && !current_.keyframes().empty()) {
    inactive_.push_back(std::make_shared<const Map>(std::move(current_)));
  }
  current_ = std::move(next);
}

bool Atlas::Join(KeyframeId other, const Rigid3& current_from_other_world) {
  const auto place = std::find_if(inactive_.begin(), inactive_.end(),
                                  [other](const auto& map) { return map->KnowsKeyframe(other); });
  if (place == inactive_.end()) return false;
  if (IsOlder(**place, current_)) {
    current_.Transform(current_from_other_world.Inverse());
    current_.Merge(**place);
  } else {
    Map moved;
    moved.Merge(**place);
    moved.Transform(current_from_other_world);
    current_.Merge(moved);
  }
  inactive_.erase(place);
  return true;
}

InactiveMaps Atlas::ShareAll() {
  InactiveMaps all = inactive_;
  all.push_back(std::make_shared<const Map>(current_.Share()));
  return all;
}

void Atlas::ChangeAll(const std::function<void(Map*)>& change) {
  for (std::shared_ptr<const Map>& map : inactive_) {
    Map changed;
    changed.Merge(*map);
    change(&changed);
    map = std::make_shared<const Map>(std::move(changed));
  }
  change(&current_);
}

const Map* Atlas::FindMapOf(KeyframeId keyframe) const {
  if (current_.KnowsKeyframe(keyframe)) return &current_;
  return msc_vo::FindMapOf(inactive_, keyframe);
}

}  // namespace msc_vo
