// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>
#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/loop_closer.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/pose_correction.h"

namespace msc_vo {

/// A loop of the trajectory that was closed: two frames show the same place.
struct Loop {
  int frame = 0;             ///< index of the frame that completed it
  int reference = 0;         ///< index of the older one; -1: it is of an earlier session
  int num_keyframes = 0;     ///< that agree on the correction
  double rotation = 0.0;     ///< of the correction at `frame`, radians
  double translation = 0.0;  ///< of the correction at `frame`, metres
};

/// Keeps the loops of a run while frames are tracked and keyframes are mapped.
class LoopLog {
 public:
  /// Reports that frame `frame` became a keyframe.
  void RecordKeyframe(int frame, KeyframeId keyframe) { frames_[keyframe] = frame; }
  /// Reports a loop that frame `frame` completed.
  void Record(int frame, const LoopClosure& loop);

  /// How loops have moved the map since the frame before the last one of `frames`; std::nullopt if
  /// they have not. `poses`: one per frame. `map`: that of the last frame.
  std::optional<WorldChange> FindChange(const std::vector<FrameResult>& frames,
                                        const std::vector<ReferencedPose>& poses,
                                        const MapSnapshot& map);

  const std::vector<Loop>& loops() const { return loops_; }  ///< in order of time

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [loops, frames, seen] = *this;  // all members, or it does not compile
    archive(loops, frames, seen);
  }

 private:
  std::vector<Loop> loops_;
  std::map<KeyframeId, int> frames_;  // of the keyframes
  int num_seen_ = 0;                  // in the map of the last frame
};

}  // namespace msc_vo
