// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/keyframe_revisit.h"

namespace msc_vo {

FrameInTwoMaps InTwoMaps(const KeyframeRevisit& found, const Map& own, const Map& other) {
  const Revisit& revisit = found.revisit;
  return {own.CamFromWorld(found.keyframe),
          revisit.cam_from_reference * other.CamFromWorld(revisit.reference), found.covariance,
          revisit.covariance};
}

void AddRecent(const KeyframeRevisit& found, std::vector<KeyframeRevisit>* recent) {
  constexpr size_t kMaxRecent = 10;
  if (recent->size() == kMaxRecent) recent->erase(recent->begin());
  recent->push_back(found);
}

}  // namespace msc_vo
