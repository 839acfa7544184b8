// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/snapshot_schedule.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

bool SnapshotOptions::IsValid(std::string* error) const {
  const char* negative = insertion_latency_frames < 0 ? "insertion_latency_frames"
                         : latency_frames < 0         ? "latency_frames"
                                                      : nullptr;
  if (negative == nullptr) return true;
  *error = std::string("options: mapping.") + negative + " must not be negative";
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
  const int latency = options_.latency_frames;
  unseen_.push_back({frame, frame + std::min(options_.insertion_latency_frames, latency)});
  unseen_.push_back({frame, frame + latency});
}

MapSnapshotPtr SnapshotSchedule::SnapshotAt(int frame) {
  while (IsAnyDue(frame)) {
    Unseen& next = unseen_.front();
    if (!next.step) Receive(Waits() ? runner_->Take() : runner_->TryTake(), &next);
    if (!next.step) {
      num_late_ += next.late ? 0 : 1;
      next.late = true;
      break;
    }
    const MappingStep step = std::move(*next.step);
    unseen_.pop_front();
    if (step.error) std::rethrow_exception(step.error);
    if (step.snapshot) snapshot_ = step.snapshot;
  }
  return snapshot_;
}

void SnapshotSchedule::Drain() {
  std::exception_ptr error;
  for (Unseen& unseen : unseen_) {
    if (!unseen.step) Receive(runner_->Take(), &unseen);
    if (!error) error = unseen.step->error;
    unseen.step->error = nullptr;
  }
  if (error) std::rethrow_exception(error);
}

// Whether the frame should see one of the maps. It then sees those before it as well: the map that
// a keyframe is inserted into has been refined with the one before.
bool SnapshotSchedule::IsAnyDue(int frame) const {
  if (snapshot_->map.keyframes().empty()) return !unseen_.empty();
  return std::any_of(unseen_.begin(), unseen_.end(),
                     [frame](const Unseen& unseen) { return unseen.due <= frame; });
}

// Whether a map that is due is waited for. The first always is.
bool SnapshotSchedule::Waits() const {
  return !options_.realtime || snapshot_->map.keyframes().empty();
}

void SnapshotSchedule::Receive(std::optional<MappingStep> step, Unseen* unseen) {
  if (step && step->snapshot) record_(unseen->keyframe, *step);
  unseen->step = std::move(step);
}

}  // namespace msc_vo
