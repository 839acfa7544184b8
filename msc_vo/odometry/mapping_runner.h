// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <exception>
#include <memory>
#include <optional>

#include "msc_vo/mapping/mapper.h"

namespace msc_vo {

/// Result of one of the two steps of a keyframe: the map with the keyframe inserted
/// (KeyframeTask::IsInserted), then the map refined with it.
struct MappingStep {
  MappingSummary summary;
  MapSnapshotPtr snapshot;    ///< the map after the step; null if it or the first step failed
  double snapshot_ms = 0.0;   ///< total time of the snapshots of the keyframe, milliseconds
  double milliseconds = 0.0;  ///< total time since the beginning of the keyframe's first step
  std::exception_ptr error;   ///< exception of the step; null if it succeeded

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(summary, snapshot, snapshot_ms, milliseconds);  // steps with an error are not saved
  }
};

/// Runs the mapper: synchronously, on a thread of its own, or on request of the caller (Run), with
/// identical results. For use by one thread at a time.
///
/// Steps run sequentially in the order of their keyframes. A step that throws does not affect the
/// next keyframes.
class MappingRunner {
 public:
  /// Waits for the running step and discards the queued keyframes.
  virtual ~MappingRunner() = default;

  /// Queues a keyframe. Blocks while kMaxWaiting keyframes are queued.
  virtual void Submit(KeyframePacket packet) = 0;

  /// Returns the oldest step that has not been returned, two for each keyframe, and waits for it.
  /// Throws std::logic_error if no keyframe is pending.
  virtual MappingStep Take() = 0;
  /// The same without waiting; std::nullopt if the step is not ready.
  virtual std::optional<MappingStep> TryTake() = 0;

  /// Whether Run() has work to do.
  virtual bool HasWork() const { return false; }
  /// Runs slices of the work as long as the next one is expected to end within `seconds` of wall
  /// clock time. The time of a slice is expected from the same slice of earlier keyframes.
  virtual void Run(double /*seconds*/) {}

  /// Largest number of queued keyframes besides the one that is processed. A longer queue would
  /// only make maps older.
  static constexpr int kMaxWaiting = 2;
};

/// Makes a runner as the options of the same names say (OdometryOptions). With `external_mapping`,
/// it works in Run(), and in Take() and Submit() where these would have to wait. The mapper must
/// outlive the runner, and must not be used by others while a keyframe is pending (submitted, and
/// its steps not yet taken).
std::unique_ptr<MappingRunner> MakeRunner(int threads, bool external_mapping, Mapper* mapper);

}  // namespace msc_vo
