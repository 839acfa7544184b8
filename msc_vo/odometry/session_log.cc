// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/session_log.h"

#include <algorithm>
#include <utility>

#include "msc_vo/mapping/keyframe_graph.h"

namespace msc_vo {

void SessionLog::BeginWith(MapContents earlier, const PinholeCamera& camera, Tracker* tracker,
                           SegmentLog* segments, Mapper* mapper) {
  for (const SavedSubMap& submap : earlier.submaps) {
    first_keyframe_ = std::max(first_keyframe_, submap.map.next_keyframe());
  }
  earlier_ = std::move(earlier.sessions);
  tracker->SetFirstKeyframe(first_keyframe_);
  segments->BeginWith(static_cast<int>(earlier.submaps.size()));
  mapper->BeginWith(std::move(earlier.submaps), earlier.loops, camera);
}

MapContents SessionLog::Share(const std::string& session, Mapper* mapper) const {
  MapContents contents;
  contents.sessions = earlier_;
  contents.sessions.push_back({first_keyframe_, session});
  contents.submaps = mapper->ShareSubMaps();
  contents.loops = LoopsBetweenKeyframes(contents.submaps, mapper->loop_edges());
  return contents;
}

}  // namespace msc_vo
