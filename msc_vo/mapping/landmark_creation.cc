// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_creation.h"

namespace msc_vo {

namespace {

template <typename L>
void CreateKind(const Keyframe& keyframe, std::set<LandmarkId>* probation, Map* map) {
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  const auto& features = FeaturesOf<L>(*keyframe.frame);
  for (size_t i = 0; i < features.size(); ++i) {
    const int feature = static_cast<int>(i);
    if (SlotsOf<L>(keyframe)[i] != kNoId || !features[i].HasDepth() || features[i].dynamic) {
      continue;
    }
    probation->insert(
        map->Add<L>(keyframe.id, feature, world_from_cam * L::InCamera(*keyframe.frame, feature)));
  }
}

}  // namespace

void CreateLandmarks(KeyframeId id, Probation* probation, Map* map) {
  const Keyframe keyframe = *map->FindKeyframe(id);  // a copy: adding landmarks changes it
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    CreateKind<L>(keyframe, &probation->Of<L>(), map);
  });
}

}  // namespace msc_vo
