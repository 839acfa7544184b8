// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/checkpoints.h"
#include "apps/cli/commands.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/run_map.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// Arguments of all commands that run the odometry.
struct RunArguments {
  int max_frames = 0;   ///< 0: all
  bool strict = false;  ///< stop at the first unreadable image
  bool quiet = false;   ///< print neither progress nor results
  bool json = false;    ///< print results as JSON
  std::string label;    ///< shown before the progress; no argument
};

/// Declares --max-frames, --strict, --quiet and --json.
void AddRunArguments(CLI::App* command, RunArguments* arguments);

/// Result of the odometry on a sequence. After an error or an interruption it contains the frames
/// up to that point.
struct SequenceRun {
  OdometryResult result;
  MapSnapshotPtr map;  ///< at the end
  RunSummary summary;
  RunContext context;  ///< contains the errors, if the sequence has ground truth
  /// With kExitError and kExitTrackingFailed, context.outcome is the error message.
  ExitCode exit_code = kExitSuccess;

  bool HasImages() const;  ///< whether any image was readable
};

/// Called with every frame as soon as it has been processed.
using FrameObserver = std::function<void(const FrameResult&)>;

/// Functions that a run calls.
struct RunCallbacks {
  FrameObserver frame;
  WindowObserver window;                ///< may be empty
  WindowFactorCallback window_factors;  ///< may be empty
  TrackingObserver tracking = {};       ///< may be empty
  Checkpoints* checkpoints = nullptr;   ///< null: none are written
  /// Called before the first image of a run that is resumed with its frames so far; if it is empty,
  /// no run is resumed.
  std::function<void(const std::vector<FrameResult>&)> resume = {};
  RunMap* map = nullptr;  ///< null: the run begins without a map, which is not saved
};

/// Runs the odometry on a sequence. Prints progress and a warning about unreadable images to
/// standard error. The run fails if more than half of the images, or all at the beginning, are
/// unreadable. Exceptions of the odometry and of the callbacks end the run and become its outcome.
/// Throws std::invalid_argument on invalid options.
SequenceRun RunSequence(const RgbdDecoder& decoder, const Configuration& configuration,
                        const RunArguments& arguments, const InterruptGuard& interrupt,
                        const RunCallbacks& callbacks);

}  // namespace msc_vo
