// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/map/map_contents.h"
#include "msc_vo/mapping/mapper.h"
#include "msc_vo/odometry/segment_log.h"
#include "msc_vo/tracking/tracker.h"

namespace msc_vo {

/// The sessions that built the maps of a run: earlier ones, and the run.
class SessionLog {
 public:
  /// Begins the run with the maps of earlier sessions, expressed in `camera`, that of the run.
  void BeginWith(MapContents earlier, const PinholeCamera& camera, Tracker* tracker,
                 SegmentLog* segments, Mapper* mapper);
  /// Whether there are earlier sessions.
  bool has_earlier() const { return !earlier_.empty(); }
  const std::vector<MapSession>& earlier() const { return earlier_; }
  /// All maps, to be saved; the present session has the name `session`.
  MapContents Share(const std::string& session, Mapper* mapper) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [sessions, first_keyframe] = *this;  // all members, or it does not compile
    archive(sessions, first_keyframe);
  }

 private:
  std::vector<MapSession> earlier_;
  KeyframeId first_keyframe_ = 0;  // of the present session
};

}  // namespace msc_vo
