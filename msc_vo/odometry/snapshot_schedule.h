// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <optional>

#include "msc_vo/odometry/mapping_runner.h"

namespace msc_vo {

/// When frames are tracked in the map of a new keyframe.
struct SnapshotOptions {
  /// Seconds by time stamps from a keyframe to the frames that are tracked in its map. The map is
  /// not used earlier even if it is ready, so every frame is tracked in the same map however fast
  /// the mapper is, and the trajectory does not depend on the number of threads. 0: the keyframe
  /// itself waits for the map; at most the interval of frames: the same poses, but features of
  /// the next frame are extracted meanwhile; above: frames are tracked in parallel with the mapper.
  /// The insertion latency holds for the map with the keyframe's new landmarks, which is soon
  /// ready; it counts no more than `latency`, which holds for the map refined with the keyframe. At
  /// 30 Hz, the defaults are the next and the third frame; they are no multiples of usual
  /// intervals, so that rounding decides nothing. Chosen by measurement, see
  /// docs/lab/snapshot_latency.md.
  double insertion_latency = 0.015;
  double latency = 0.085;
  /// No frame waits for a map, as with a live camera: a map that is late is used from the first
  /// frame that finds it ready. A run is repeatable as long as no map is late.
  bool realtime = false;
};

/// Passes keyframes to the mapper and determines which map each frame is tracked in. The first map
/// of a segment is always waited for.
class SnapshotSchedule {
 public:
  /// Called in order for every step that resulted in a map, when the map becomes visible or the
  /// schedule is drained.
  /// `frame` is the keyframe as passed to Submit().
  using Recorder = std::function<void(int frame, const MappingStep& step)>;

  /// The runner's mapper must outlive the schedule, and must not be used by others until Drain().
  SnapshotSchedule(const SnapshotOptions& options, std::unique_ptr<MappingRunner> runner,
                   MapSnapshotPtr empty, Recorder record);

  /// Submits frame `frame`, with the time stamp `timestamp`, as a keyframe. Frames are numbered
  /// from 0.
  void Submit(int frame, double timestamp, KeyframePacket packet);

  /// Receives the exceptions of failed steps.
  using ErrorHandler = std::function<void(const std::exception_ptr& error)>;

  /// The map in which the frame with time stamp `timestamp` is tracked. Passes the exception of a
  /// failed step to `on_error`, once, when its map would have become visible; the previous map
  /// remains in use. By default, the exception is thrown.
  MapSnapshotPtr SnapshotAt(double timestamp,
                            const ErrorHandler& on_error = std::rethrow_exception);

  /// Waits for all keyframes. The maps of later frames do not change. Throws the exception of a
  /// failed step unless SnapshotAt() has; all other steps have been recorded by then.
  void Drain();

  /// Whether RunMapper() has work to do, and runs it (MappingRunner::Run).
  bool HasWork() const { return runner_->HasWork(); }
  void RunMapper(double seconds) { runner_->Run(seconds); }

  /// Waits until the mapper is idle. Its maps become visible when they are due nevertheless.
  /// Returns whether all steps have succeeded.
  bool WaitForMapper();
  /// Whether WaitForMapper() would not wait.
  bool IsMapperIdle();
  /// Lists the state for a checkpoint, after WaitForMapper() has returned true.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(snapshot_, pending_, num_late_);
  }

  /// Number of maps that were not ready for the first frame that should have been tracked in them.
  int num_late() const { return num_late_; }

 private:
  // A step whose map has not been used yet.
  struct PendingStep {
    int keyframe = 0;                                // number of its frame
    double due = 0.0;                                // earliest time of a frame in its map
    std::optional<MappingStep> step = std::nullopt;  // set when it was taken from the runner
    bool late = false;
    bool begins_map = false;  // the first map of a segment: no later frame is tracked without it
    bool recorded = false;    // the step has been passed to the recorder
  };

  bool IsAnyDue(double timestamp) const;
  bool Waits() const;
  // Takes the step from the runner unless it was taken before. It remains empty if it is not ready
  // and `wait` is false.
  void Take(bool wait, PendingStep* pending);
  // Passes the step to the recorder, once.
  void Record(PendingStep* pending);

  SnapshotOptions options_;
  std::unique_ptr<MappingRunner> runner_;
  MapSnapshotPtr snapshot_;
  Recorder record_;
  std::deque<PendingStep> pending_;  // in the order of the mapper
  int num_late_ = 0;
};

}  // namespace msc_vo
