// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/snapshot_schedule.h"

#include <utility>

namespace msc_vo {

bool SnapshotOptions::IsValid(std::string* error) const {
  if (latency_frames >= 0) return true;
  *error = "options: mapping.latency_frames must not be negative";
  return false;
}

SnapshotSchedule::SnapshotSchedule(const SnapshotOptions& options,
                                   std::unique_ptr<MappingRunner> runner, MapSnapshotPtr empty,
                                   Recorder record)
    : options_(options),
      runner_(std::move(runner)),
      snapshot_(std::move(empty)),
      record_(std::move(record)) {}

void SnapshotSchedule::Submit(int frame, KeyframePacket packet) {
  runner_->Submit(std::move(packet));
  unseen_.push_back({frame, std::nullopt});
}

MapSnapshotPtr SnapshotSchedule::SnapshotAt(int frame) {
  while (!unseen_.empty() && IsDue(unseen_.front(), frame)) {
    Keyframe& keyframe = unseen_.front();
    if (!keyframe.step) Receive(Waits() ? runner_->Take() : runner_->TryTake(), &keyframe);
    if (!keyframe.step) {
      num_late_ += keyframe.late ? 0 : 1;
      keyframe.late = true;
      break;
    }
    const MappingStep step = std::move(*keyframe.step);
    unseen_.pop_front();
    if (step.error) std::rethrow_exception(step.error);
    if (step.snapshot) snapshot_ = step.snapshot;
  }
  return snapshot_;
}

void SnapshotSchedule::Drain() {
  std::exception_ptr error;
  for (Keyframe& keyframe : unseen_) {
    if (!keyframe.step) Receive(runner_->Take(), &keyframe);
    if (!error) error = keyframe.step->error;
    keyframe.step->error = nullptr;
  }
  if (error) std::rethrow_exception(error);
}

// Whether the frame should see the map of this keyframe.
bool SnapshotSchedule::IsDue(const Keyframe& keyframe, int frame) const {
  return snapshot_->map.keyframes().empty() || keyframe.frame + options_.latency_frames <= frame;
}

// Whether a map that is due is waited for. The first always is.
bool SnapshotSchedule::Waits() const {
  return !options_.realtime || snapshot_->map.keyframes().empty();
}

void SnapshotSchedule::Receive(std::optional<MappingStep> step, Keyframe* keyframe) {
  if (step && !step->error) record_(keyframe->frame, *step);
  keyframe->step = std::move(step);
}

}  // namespace msc_vo
