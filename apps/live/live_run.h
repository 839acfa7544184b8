// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/live/pacing.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/odometry/pose_correction.h"
#include "msc_vo/odometry/tracking_observer.h"
#include "msc_vo/report/frame_view.h"
#include "msc_vo/report/report.h"

namespace msc_vo {

/// Properties of a run that is viewed while it goes on.
struct LiveRunOptions {
  int num_frames = 0;         ///< of the sequence
  bool can_pause = true;      ///< false in real time
  LensDistortion distortion;  ///< of the images
  /// A paused run goes on if nobody has asked for data for so long.
  std::chrono::milliseconds vanished{90'000};
};

/// A run in progress as its viewers see it. The thread of the run adds frames; the threads of a
/// server read updates and control the pace. No reader ever waits for a viewer, and the run waits
/// only where a viewer has paused or slowed it down.
class LiveRun {
 public:
  explicit LiveRun(const LiveRunOptions& options);

  // Thread of the run:

  /// Begins with the frames of a run that is resumed, which stay where they are.
  void Continue(const std::vector<FrameResult>& frames);
  /// Takes features, image and map of a frame, before Add(). Does next to nothing while nobody
  /// watches. After a loop or a join of two maps, the frames so far move with the map.
  void Show(const TrackedImage& tracked);
  /// Shows where the run was found in the map of earlier runs; before Show() of that frame.
  void ShowPlace(const PlaceView& place);
  /// Adds a frame, then waits for its turn. Returns early if `is_interrupted` returns true.
  void Add(const FrameResult& frame, const std::function<bool()>& is_interrupted);
  /// Ends the run: viewers get the page of the finished report.
  void Finish(std::string report);
  /// After Finish(): waits until the viewers have the report, at most for `longest`. Returns at
  /// once if nobody watches.
  void WaitForViewers(std::chrono::milliseconds longest) const;

  // Any thread:

  /// What has changed since a viewer had `num_frames` frames, a map and a view, as JSON.
  std::string Update(int num_frames, int map_version, int view);
  /// The finished report, or null before Finish().
  std::shared_ptr<const std::string> Report();
  /// Carries out "pause", "resume", "step" or "speed" (value: a number). Returns false on anything
  /// else and in real time.
  bool Control(const std::string& action, const std::string& value);

  /// Identifies this run among others.
  const std::string& id() const { return id_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool IsWatched(Clock::duration within) const;
  bool WantsView() const;
  // Keeps what the next frame is relative to.
  void Remember(const TrackedFrame& tracked);
  void Append(const FrameResult& frame);
  void ShowView(const TrackedImage& tracked);
  void ShowMap(const TrackedImage& tracked);
  // The frames so far as their keyframes now stand.
  std::vector<ReportFrame> MovedFrames(const MapSnapshot& snapshot) const;

  LiveRunOptions options_;
  std::string id_;
  Pacing pacing_;

  mutable std::mutex mutex_;  // of everything below
  std::vector<ReportFrame> frames_;
  std::shared_ptr<const ReportMap> map_;
  int map_version_ = -1;
  int moved_version_ = -1;  // of the map with which the frames moved for the last time
  std::vector<ReportLoop> loops_;
  std::optional<int> found_frame_;
  std::optional<PlaceView> place_;
  std::shared_ptr<const FrameView> view_;
  bool view_is_wanted_ = true;  // nobody waits for another one before the last was taken
  std::shared_ptr<const std::string> report_;
  std::optional<Clock::time_point> last_request_;
  bool report_was_sent_ = false;

  // Thread of the run only:
  const MapSnapshot* shown_map_ = nullptr;  // only compared, never read
  KeyframeId shown_keyframe_ = kNoId;
  Clock::time_point map_time_, view_time_;
  // One per frame, relative to a keyframe. A frame that is not tracked has the pose of the frame
  // before it; a pose without a keyframe never moves.
  std::vector<ReferencedPose> poses_;
  ReferencedPose pose_;             // of the next frame
  int first_segment_ = kNoSegment;  // of the run; the worlds of earlier runs have smaller numbers
  int num_shown_loops_ = 0;
  int shown_world_ = kNoSegment;
};

}  // namespace msc_vo
