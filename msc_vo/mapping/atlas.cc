// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/atlas.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

namespace {

std::shared_ptr<const Map> Share(SubMap* submap) {
  return std::make_shared<const Map>(submap->map.Share());
}

SavedSubMap ToSave(SubMap* submap) {
  return {submap->id, submap->map.Share(), submap->axes.Saved(), submap->noise.scale(),
          submap->planes.Save(submap->map)};
}

}  // namespace

Atlas::Atlas(const SceneAxesOptions& axes, const NoiseEstimatorOptions& noise)
    : axes_(axes), noise_(noise), current_(MakeEmpty()) {
  current_.id = 0;
}

SubMap Atlas::MakeEmpty() const {
  return {kNoSubMap, {}, SceneAxes(axes_), NoiseEstimator(noise_), {}};
}

SubMap Atlas::Restored(SavedSubMap saved) const {
  SubMap submap = MakeEmpty();
  submap.map = std::move(saved.map);
  submap.map.BeginSession();
  if (saved.axes) submap.axes.Restore(*saved.axes);
  submap.noise.Restore(saved.noise_scale);
  submap.planes.Restore(saved.planes);
  return submap;
}

void Atlas::BeginWith(std::vector<SavedSubMap> submaps) {
  for (SavedSubMap& saved : submaps) {
    SubMap submap = Restored(std::move(saved));
    submap.id = static_cast<SubMapId>(inactive_.size());
    current_.map.ContinueIds(submap.map.next_keyframe(), submap.map.next_landmark());
    inactive_.push_back(std::move(submap));
    inactive_maps_.push_back(Share(&inactive_.back()));
  }
  current_.map.BeginSession();
  current_.id = static_cast<SubMapId>(inactive_.size());
  next_id_ = current_.id + 1;
}

void Atlas::BeginWith(SavedSubMap submap) {
  if (!current_.map.keyframes().empty()) Begin(true);
  const SubMapId id = current_.id;
  current_ = Restored(std::move(submap));
  current_.id = id;
}

std::vector<SavedSubMap> Atlas::ShareSubMaps() {
  std::vector<SavedSubMap> submaps;
  for (SubMap& submap : inactive_) submaps.push_back(ToSave(&submap));
  if (!current_.map.keyframes().empty()) submaps.push_back(ToSave(&current_));
  std::sort(submaps.begin(), submaps.end(),
            [](const SavedSubMap& a, const SavedSubMap& b) { return a.id < b.id; });
  return submaps;
}

void Atlas::Begin(bool keep_current) {
  SubMap next = MakeEmpty();
  next.id = keep_current ? next_id_++ : current_.id;
  next.map = current_.map.Next();
  next.noise = current_.noise;
  if (keep_current && !current_.map.keyframes().empty()) {
    inactive_.push_back(std::move(current_));
    inactive_maps_.push_back(Share(&inactive_.back()));
  }
  current_ = std::move(next);
}

bool Atlas::Join(KeyframeId other, const Rigid3& current_from_other_world) {
  const auto place =
      std::find_if(inactive_.begin(), inactive_.end(),
                   [other](const SubMap& submap) { return submap.map.KnowsKeyframe(other); });
  if (place == inactive_.end()) return false;
  if (IsOlder(*place, current_)) {
    current_.map.Transform(current_from_other_world.Inverse());
    current_.id = place->id;
    current_.axes = place->axes;
  } else {
    place->map.Transform(current_from_other_world);
  }
  current_.map.Merge(place->map);
  current_.planes.Join(std::move(place->planes));
  inactive_maps_.erase(inactive_maps_.begin() + (place - inactive_.begin()));
  inactive_.erase(place);
  return true;
}

InactiveMaps Atlas::ShareAll() {
  InactiveMaps all = inactive_maps_;
  all.push_back(Share(&current_));
  return all;
}

void Atlas::ChangeAll(const std::function<void(SubMap*)>& change) {
  for (size_t i = 0; i < inactive_.size(); ++i) {
    change(&inactive_[i]);
    inactive_maps_[i] = Share(&inactive_[i]);
  }
  change(&current_);
}

const SubMap* Atlas::Find(SubMapId id) const {
  if (current_.id == id) return &current_;
  const auto place = std::find_if(inactive_.begin(), inactive_.end(),
                                  [id](const SubMap& submap) { return submap.id == id; });
  return place != inactive_.end() ? &*place : nullptr;
}

const SubMap* Atlas::FindSubMapOf(KeyframeId keyframe) const {
  if (current_.map.KnowsKeyframe(keyframe)) return &current_;
  const auto place =
      std::find_if(inactive_.begin(), inactive_.end(),
                   [keyframe](const SubMap& submap) { return submap.map.KnowsKeyframe(keyframe); });
  return place != inactive_.end() ? &*place : nullptr;
}

}  // namespace msc_vo
