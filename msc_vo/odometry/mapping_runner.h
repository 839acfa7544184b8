// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <exception>
#include <memory>
#include <optional>

#include "msc_vo/mapping/mapper.h"

namespace msc_vo {

// What became of one keyframe so far. There are two steps to it, as to the mapper's work on it: the
// map that it has been inserted into, then the map refined with it.
struct MappingStep {
  MappingSummary summary;
  MapSnapshotPtr snapshot;    // the map behind the step; null if it or the one before failed
  double snapshot_ms = 0.0;   // milliseconds that snapshots took
  double milliseconds = 0.0;  // all since the keyframe's first step began
  std::exception_ptr error;   // what the step threw, if it failed
};

// Takes keyframes to the mapper, either at once or on a thread of its own; the calls and their
// results are the same. For one caller at a time.
//
// Steps run one after the other in the order of their keyframes. One that throws does not keep the
// next keyframes from being worked on.
class MappingRunner {
 public:
  // Discards the keyframes that wait, and ends behind the step that runs.
  virtual ~MappingRunner() = default;

  // Hands a keyframe over. Waits if kMaxWaiting others wait already.
  virtual void Submit(KeyframePacket packet) = 0;

  // The oldest step that was not taken yet: two for each keyframe. Waits for it. Throws
  // std::logic_error if no keyframe is under way.
  virtual MappingStep Take() = 0;
  // The same if it is ready.
  virtual std::optional<MappingStep> TryTake() = 0;

  // Keyframes that wait behind the one that the mapper works on: more only make the map older.
  static constexpr int kMaxWaiting = 2;
};

// The mapper must outlive the runner. While a keyframe is under way (submitted, and its steps not
// taken) nobody else may use it.
std::unique_ptr<MappingRunner> MakeInlineRunner(Mapper* mapper);
std::unique_ptr<MappingRunner> MakeThreadedRunner(Mapper* mapper);

}  // namespace msc_vo
