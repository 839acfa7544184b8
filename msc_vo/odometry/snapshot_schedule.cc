// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/snapshot_schedule.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

SnapshotSchedule::SnapshotSchedule(const SnapshotOptions& options,
                                   std::unique_ptr<MappingRunner> runner, MapSnapshotPtr empty,
                                   Recorder record)
    : options_(options),
      runner_(std::move(runner)),
      snapshot_(std::move(empty)),
      record_(std::move(record)) {}

void SnapshotSchedule::Submit(int frame, double timestamp, KeyframePacket packet) {
  const bool begins_map = packet.begins_map;
  runner_->Submit(std::move(packet));
  const double latency = options_.latency;
  const double insertion_latency = begins_map ? 0.0 : options_.insertion_latency;
  pending_.push_back({frame, timestamp + std::min(insertion_latency, latency)});
  pending_.back().begins_map = begins_map;
  pending_.push_back({frame, timestamp + latency});
}

MapSnapshotPtr SnapshotSchedule::SnapshotAt(double timestamp, const ErrorHandler& on_error) {
  while (IsAnyDue(timestamp)) {
    PendingStep& next = pending_.front();
    Take(Waits(), &next);
    if (!next.step) {
      num_late_ += next.late ? 0 : 1;
      next.late = true;
      break;
    }
    Record(&next);
    const MappingStep step = std::move(*next.step);
    pending_.pop_front();
    if (step.error) on_error(step.error);
    if (step.snapshot) snapshot_ = step.snapshot;
  }
  return snapshot_;
}

void SnapshotSchedule::Drain() {
  std::exception_ptr error;
  for (PendingStep& pending : pending_) {
    Take(true, &pending);
    Record(&pending);
    if (!error) error = pending.step->error;
    pending.step->error = nullptr;
  }
  if (error) std::rethrow_exception(error);
}

bool SnapshotSchedule::WaitForMapper() {
  bool succeeded = true;
  for (PendingStep& pending : pending_) {
    Take(true, &pending);
    if (pending.step->error) succeeded = false;
  }
  return succeeded;
}

bool SnapshotSchedule::IsMapperIdle() {
  for (PendingStep& pending : pending_) {
    Take(false, &pending);
    if (!pending.step) return false;
  }
  return true;
}

// Whether one of the pending maps is due at the time of a frame. Earlier ones are then used as
// well, because a keyframe is inserted into the map that has been refined with the previous one.
bool SnapshotSchedule::IsAnyDue(double timestamp) const {
  if (snapshot_->map.keyframes().empty()) return !pending_.empty();
  return std::any_of(pending_.begin(), pending_.end(),
                     [timestamp](const PendingStep& pending) { return pending.due <= timestamp; });
}

// Whether a frame waits for a map that is due; always for the first one of a segment.
bool SnapshotSchedule::Waits() const {
  return !options_.realtime || snapshot_->map.keyframes().empty() ||
         std::any_of(pending_.begin(), pending_.end(),
                     [](const PendingStep& pending) { return pending.begins_map; });
}

void SnapshotSchedule::Take(bool wait, PendingStep* pending) {
  if (pending->step) return;
  if (wait) {
    pending->step = runner_->Take();
  } else {
    pending->step = runner_->TryTake();
  }
}

void SnapshotSchedule::Record(PendingStep* pending) {
  if (pending->step->snapshot && !pending->recorded) record_(pending->keyframe, *pending->step);
  pending->recorded = true;
}

}  // namespace msc_vo
