// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/keyframe_inserter.h"

#include <utility>

#include "msc_vo/geometry/pose_covariance.h"

namespace msc_vo {

namespace {

// Adds the observations of a keyframe, and what its frames have counted since the last one.
void AddObservations(const KeyframePacket& packet, KeyframeId keyframe, Map* map) {
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : OfKind<L>(packet.matches)) {
      map->Observe<L>(match.id, keyframe, match.feature);
    }
    for (const TrackingCount& count : packet.counts.Of<L>()) {
      map->CountTracking<L>(count.id, count.num_visible, count.num_found);
    }
  });
}

// Of a keyframe relative to those before it. Alignment alone links the first keyframe of a map to
// the keyframes of others.
PoseCovariance StepCovariance(const KeyframePacket& packet) {
  return packet.reference != kNoId ? packet.covariance : ViewCovariance();
}

}  // namespace

void KeyframeInserter::BeginMap(const KeyframePacket& packet, Atlas* atlas) {
  const bool keeps_last = packet.keeps_last_map && !atlas->current().map.keyframes().empty();
  if (keeps_last && packet.last_tracked) joiner_.AddLastPose(*packet.last_tracked);
  atlas->Begin(packet.keeps_last_map);
  joiner_.Clear();
  newest_ = kNoId;
}

void KeyframeInserter::Insert(const KeyframePacket& packet, std::shared_ptr<const Frame> frame,
                              Atlas* atlas, MappingSummary* summary) {
  Map* const map = &atlas->current().map;
  Rigid3 cam_from_world = packet.cam_from_reference;
  if (packet.reference != kNoId) {
    cam_from_world = cam_from_world * map->CamFromWorld(packet.reference);
  }
  newest_ = map->AddKeyframe(std::move(frame), cam_from_world, packet.id);
  map->SetStepCovariance(newest_, StepCovariance(packet));
  summary->keyframe = newest_;
  summary->submap = atlas->current().id;
  AddObservations(packet, newest_, map);
  if (packet.revisit && !map->KnowsKeyframe(packet.revisit->reference)) {
    joiner_.Add({newest_, packet.covariance, *packet.revisit});
    summary->join = joiner_.TryJoin(atlas);
  }
  summary->num_refused_joins = joiner_.num_refused();
}

}  // namespace msc_vo
