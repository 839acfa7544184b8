// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/sequence_run.h"

#include <algorithm>
#include <exception>
#include <iostream>

#include "apps/cost_meter.h"
#include "apps/progress.h"
#include "msc_vo/io/rgbd_source.h"

namespace msc_vo {

SequenceRun RunSequence(const RgbdDecoder& decoder, const Configuration& configuration,
                        int max_frames, bool quiet, const InterruptGuard& interrupt,
                        const WindowObserver& window_observer) {
  SequenceRun run;
  RunContext& context = run.context;
  context.command_line = CommandLine();
  context.outcome = "complete";
  context.sequence = decoder.index();
  context.calibration = decoder.calibration();
  context.configuration = configuration;
  const int num_frames = max_frames > 0 ? std::min(max_frames, decoder.size()) : decoder.size();

  const CostMeter cost;
  Odometry odometry(configuration.odometry, context.calibration.camera,
                    context.calibration.distortion);
  odometry.SetWindowObserver(window_observer);
  RgbdSource source(decoder, 0, num_frames);
  Progress progress(num_frames);
  int done = 0;
  try {
    for (RgbdImage image; !interrupt.IsInterrupted() && source.Next(&image);) {
      const FrameResult frame = odometry.Process(image);
      ++done;
      if (!quiet) progress.Update(done, ToString(frame.status));
    }
  } catch (const std::exception& error) {
    context.outcome = error.what();
    run.exit_code = kExitError;
  }
  if (!quiet) progress.Finish();
  if (run.exit_code == kExitSuccess && interrupt.IsInterrupted() && done < num_frames) {
    context.outcome = "interrupted";
    run.exit_code = kExitInterrupted;
  }
  try {
    run.result = odometry.Finish();
  } catch (const std::exception& error) {  // of a keyframe that no image came behind
    context.outcome = error.what();
    run.exit_code = kExitError;
    run.result = odometry.Finish();
  }
  context.cost = cost.Read();
  run.summary = Summarize(run.result);
  if (!context.sequence.ground_truth.empty() && done > 0) {
    context.error = EvaluateTrajectory(context.sequence.ground_truth, TrajectoryOf(run.result));
  }
  return run;
}

void PrintWarnings(const RgbdDecoder& decoder) {
  for (const std::string& warning : decoder.index().warnings) {
    std::cerr << "msc_vo: warning: " << warning << std::endl;
  }
}

}  // namespace msc_vo
