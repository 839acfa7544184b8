// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <string>

#include "apps/cli/cost_meter.h"
#include "apps/cli/frame_loop.h"
#include "apps/cli/replay_views.h"
#include "apps/cli/run_identity.h"
#include "apps/cli/run_map.h"
#include "msc_vo/checkpoint/checkpoint_file.h"
#include "msc_vo/inertial/gravity_factors.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

/// The folder of the checkpoint in a folder of results.
std::string CheckpointFolder(const std::string& output);

/// Removes the checkpoint in a folder of results. Returns its path; empty if there was none. Warns
/// if it cannot be removed.
std::string RemoveCheckpoint(const std::string& output);

/// Reads the identity of the run whose checkpoint is open. Throws std::runtime_error.
RunIdentity ReadIdentity(CheckpointFile* file);

/// The parts of a replay that have a state, apart from the odometry.
struct CheckpointedParts {
  ReplayViews* views = nullptr;
  RunMap* map = nullptr;
  GravityFactors* gravity = nullptr;  ///< null: none
};

/// Writes checkpoints of a run while it is in progress, and restores them. The clock decides when a
/// checkpoint is written, and affects nothing else. The first image waits for the first one. Other
/// images wait for neither the disk nor the mapper: a checkpoint is begun when the mapper is idle,
/// and written in parts after successive images if it is large.
class Checkpoints {
 public:
  /// `interval`: seconds between checkpoints. 0: after every image, which waits until it is
  /// written. Longer where writing takes more than a fiftieth of the time.
  Checkpoints(CheckpointFile file, RunIdentity identity, double interval,
              const CheckpointedParts& parts);

  /// Restores the checkpoint that the file was opened with. Throws std::runtime_error that names
  /// the file.
  void Restore(Odometry* odometry, CostMeter* cost, LoopProgress* progress);

  /// Call after every image.
  void SaveIfDue(Odometry* odometry, const CostMeter& cost, const LoopProgress& progress);
  /// Call when the run ends early between two images. A checkpoint that cannot be written is a
  /// warning: the one before remains, if there is one.
  void Save(Odometry* odometry, const CostMeter& cost, const LoopProgress& progress);
  /// Waits until the last checkpoint is on the disk.
  void Wait();

 private:
  // Writes at most `max_new_bytes` of new objects. The checkpoint may then be incomplete.
  void Write(Odometry* odometry, const CostMeter& cost, const LoopProgress& progress,
             uint64_t max_new_bytes);
  // Calls a function of the file, whose errors are warnings.
  template <typename Function>
  void Try(const Function& function);

  CheckpointFile file_;
  RunIdentity identity_;
  double interval_;
  CheckpointedParts parts_;
  Stopwatch since_saved_;
  std::optional<double> pause_;  // seconds until the next one is due; none: at once
  Stopwatch since_part_;
  double duration_ = 0.0;      // of the parts of the next one so far, milliseconds
  double longest_part_ = 0.0;  // of these
  bool has_warned_ = false;
  std::future<void> commit_;  // valid while a checkpoint is being completed; last: it uses the file
};

}  // namespace msc_vo
