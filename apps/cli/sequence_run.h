// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/interrupt_guard.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

// How the user limits a run.
struct RunArguments {
  int max_frames = 0;   // 0: all
  bool strict = false;  // the first image that cannot be read ends the run
  bool quiet = false;   // neither progress nor table
};

// Declares --max-frames, --strict and --quiet.
void AddRunArguments(CLI::App* command, RunArguments* arguments);

// How the odometry went over a sequence. It may have ended early (too many images that cannot be
// read, Ctrl-C): what was found until then is here.
struct SequenceRun {
  OdometryResult result;
  RunSummary summary;
  RunContext context;  // compared with the ground truth, if there is one
  // kExitError, kExitTrackingFailed: context.outcome is the message.
  ExitCode exit_code = kExitSuccess;

  bool HasImages() const;  // at least one image could be read
};

// Is shown every frame as soon as it has been processed.
using FrameObserver = std::function<void(const FrameResult&)>;

// Runs the odometry over the images, with the progress and a warning about those that cannot be
// read on standard error. They get the status unreadable; if more than half are, or all at the
// beginning, the run has failed. What `frame_observer` throws ends the run as the
// odometry's own exceptions do. `window_observer` may be empty. Throws std::invalid_argument on
// options that are not valid.
SequenceRun RunSequence(const RgbdDecoder& decoder, const Configuration& configuration,
                        const RunArguments& arguments, const InterruptGuard& interrupt,
                        const FrameObserver& frame_observer,
                        const WindowObserver& window_observer = {});

// The warnings, on standard error.
void PrintWarnings(const std::vector<std::string>& warnings);

}  // namespace msc_vo
