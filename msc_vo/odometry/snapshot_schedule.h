// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "msc_vo/odometry/mapping_runner.h"

namespace msc_vo {

struct SnapshotOptions {
  // A map is seen from the frame so many behind its keyframe on, and not earlier even if it is
  // ready. So every frame sees the same map however fast the mapper is, which makes the trajectory
  // the same at any number of threads. 0: the keyframe itself waits for it; 1: the same poses, but
  // the features of the next frame are extracted meanwhile; above, frames are tracked beside the
  // mapper. The first is for the map that the keyframe has been inserted into, which is soon ready
  // and holds what tracking needs where the camera goes on: with 2 instead of 1, errors were larger
  // by 4 and 14 %. The second is for the map refined with the keyframe, which takes the mapper
  // longer than the tracker takes for a frame: between 1 and 4 nothing is to be told apart
  // (docs/lab/performance.md). The first counts no more than the second.
  int insertion_latency_frames = 1;
  int latency_frames = 3;
  // Nothing waits, as nothing can with a camera: a map that is not ready for the frame that should
  // see it is seen by the first one that finds it ready. A run repeats as long as no map is late.
  bool realtime = false;

  bool IsValid(std::string* error) const;
};

// Gives keyframes to the mapper, and decides which map each frame is tracked against. The first map
// is always waited for, as there is nothing to track against without it.
class SnapshotSchedule {
 public:
  // Is told of every step that left a map, in order, as soon as the schedule knows: `frame` is the
  // keyframe as Submit() was told.
  using Recorder = std::function<void(int frame, const MappingStep& step)>;

  // The mapper, which must outlive the schedule, belongs to it until Drain().
  SnapshotSchedule(const SnapshotOptions& options, std::unique_ptr<MappingRunner> runner,
                   MapSnapshotPtr empty, Recorder record);

  // Frame `frame` is a keyframe. Frames are counted from 0.
  void Submit(int frame, KeyframePacket packet);

  // The map that frame `frame` sees. Throws what the mapper threw, once, where the map that is
  // missing for it would have become visible; the one before stays.
  MapSnapshotPtr SnapshotAt(int frame);

  // Waits for all keyframes. What frames see stays as it would have been. Throws what the mapper
  // threw, unless SnapshotAt() did; what else it did has been recorded by then.
  void Drain();

  // Maps that were not ready for the frame that should have seen them.
  int num_late() const { return num_late_; }

 private:
  // A step that no frame has seen the map of yet.
  struct Unseen {
    int keyframe = 0;                                // its frame
    int due = 0;                                     // the first frame that should see it
    std::optional<MappingStep> step = std::nullopt;  // once it was taken from the runner
    bool late = false;
  };

  bool IsAnyDue(int frame) const;
  bool Waits() const;
  void Receive(std::optional<MappingStep> step, Unseen* unseen);

  SnapshotOptions options_;
  std::unique_ptr<MappingRunner> runner_;
  MapSnapshotPtr snapshot_;
  Recorder record_;
  std::deque<Unseen> unseen_;  // in the order of the mapper
  int num_late_ = 0;
};

}  // namespace msc_vo
