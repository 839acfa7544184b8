// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/last_frame.h"

#include "msc_vo/frame/frame_intrinsics.h"

namespace msc_vo {

LastFrame::LastFrame(const TrackedFrame& tracked)
    : frame(tracked.frame),
      reference(tracked.reference),
      cam_from_reference(tracked.cam_from_reference),
      matches(tracked.matches),
      keyframe(tracked.keyframe.id) {}

void LastFrame::UpdateTo(const MapSnapshot& snapshot) {
  frame = ChangeIntrinsics(frame, snapshot.intrinsics);
  if (keyframe == kNoId || keyframe != snapshot.newest_keyframe) return;
  reference = keyframe;
  cam_from_reference = Rigid3();
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const std::vector<LandmarkId>& landmarks = SlotsOf<L>(*snapshot.map.FindKeyframe(keyframe));
    auto& of_kind = OfKind<L>(matches);
    of_kind.clear();
    for (size_t i = 0; i < landmarks.size(); ++i) {
      if (landmarks[i] != kNoId) of_kind.push_back({static_cast<int>(i), landmarks[i]});
    }
  });
}

}  // namespace msc_vo
