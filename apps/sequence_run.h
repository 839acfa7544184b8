// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "apps/commands.h"
#include "apps/interrupt_guard.h"
#include "msc_vo/io/rgbd_decoder.h"
#include "msc_vo/io/run_summary.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

// How the odometry went over a sequence. It may have ended early (an image that cannot be read,
// Ctrl-C): what was found until then is here.
struct SequenceRun {
  OdometryResult result;
  RunSummary summary;
  RunContext context;  // compared with the ground truth, if there is one
  // kExitError, kExitTrackingFailed: context.outcome is the message.
  ExitCode exit_code = kExitSuccess;
};

// Runs the odometry over the first `max_frames` images (0: over all), with the progress on standard
// error unless `quiet`. `window_observer` may be empty. Throws std::invalid_argument on options
// that are not valid.
SequenceRun RunSequence(const RgbdDecoder& decoder, const Configuration& configuration,
                        int max_frames, bool quiet, const InterruptGuard& interrupt,
                        const WindowObserver& window_observer = {});

// The warnings about the sequence, on standard error.
void PrintWarnings(const RgbdDecoder& decoder);

}  // namespace msc_vo
