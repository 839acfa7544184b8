// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/sequence_run.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/cost_meter.h"
#include "apps/cli/frame_loop.h"
#include "apps/cli/image_feed.h"
#include "apps/cli/progress.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// The readout time of the options takes precedence over that of the calibration. Writes the result
// to both; nullopt if it is to be self-calibrated.
void ResolveReadoutTime(std::optional<double>* option, Calibration* calibration) {
  if (*option) {
    calibration->readout_time = *option;
    calibration->readout_origin = "mapping.readout_time";
  } else {
    *option = calibration->readout_time;
  }
}

// The context of a complete run.
RunContext MakeContext(const RgbdDecoder& decoder, const Configuration& configuration) {
  RunContext context;
  context.command_line = CommandLine();
  context.outcome = "complete";
  context.sequence_name = SequenceName(decoder.index().directory);
  context.sequence = decoder.index();
  context.sequence.warnings = decoder.Warnings();
  context.calibration = decoder.calibration();
  context.configuration = configuration;
  ResolveReadoutTime(&context.configuration.odometry.mapping.readout_time, &context.calibration);
  return context;
}

void LogStart(const RunContext& context, int num_frames) {
  const Calibration& calibration = context.calibration;
  Log().info("{}", context.command_line);
  Log().info("sequence {}: {} images", context.sequence.directory, num_frames);
  Log().info("camera: {}; depth scale {}; readout time: {}", calibration.origin,
             calibration.depth_scale, calibration.readout_origin);
}

void Fail(ExitCode exit_code, const std::string& outcome, SequenceRun* run) {
  run->context.outcome = outcome;
  run->exit_code = exit_code;
}

// Warns about pauses that replay in real time shortens, also in the results.
void WarnAboutShortenedPauses(int num_frames, SequenceIndex* sequence) {
  const std::string pauses = DescribeShortenedPauses(sequence->entries, num_frames);
  if (pauses.empty()) return;
  PrintWarning(pauses);
  sequence->warnings.push_back(pauses);
}

// Processes images until the end, an error or an interruption.
void RunLoop(const RunArguments& arguments, int num_frames, const InterruptGuard& interrupt,
             const RunCallbacks& callbacks, const CostMeter& cost, Odometry* odometry,
             FrameLoop* loop, SequenceRun* run) {
  Progress progress(num_frames, arguments.label);
  try {
    for (FrameResult frame; !interrupt.IsInterrupted() && loop->Step(&frame);) {
      callbacks.frame(frame);
      if (!arguments.quiet) progress.Update(loop->progress().num_images, ToString(frame.status));
      if (callbacks.checkpoints != nullptr) {
        callbacks.checkpoints->SaveIfDue(odometry, cost, loop->progress());
      }
      if (callbacks.map != nullptr) callbacks.map->SaveIfDue(odometry);
    }
  } catch (const std::exception& error) {
    Fail(kExitError, error.what(), run);
  }
  if (callbacks.checkpoints != nullptr) callbacks.checkpoints->Wait();
  if (!arguments.quiet) progress.Finish();
  const bool ends_early = loop->progress().num_images < num_frames;  // never for an endless camera
  if (run->exit_code == kExitSuccess && interrupt.IsInterrupted() && ends_early) {
    Fail(kExitInterrupted, "interrupted", run);
    if (callbacks.checkpoints != nullptr) {
      callbacks.checkpoints->Save(odometry, cost, loop->progress());
    }
  }
}

// Takes the result, also after an error in the last keyframe step.
void FinishOdometry(bool localizes, Odometry* odometry, SequenceRun* run) {
  try {
    run->result = odometry->Finish(localizes);
    run->map = odometry->Map();
  } catch (const std::exception& error) {
    Fail(kExitError, error.what(), run);
    run->result = odometry->Finish(localizes);
    run->map = odometry->Map();
  }
}

// Takes where the run was found in the map, and saves the map for the last time.
void SaveMap(RunMap* map, Odometry* odometry, SequenceRun* run) {
  run->context.place = map->place();
  try {
    map->Save(odometry);
  } catch (const std::exception& error) {
    Fail(kExitError, error.what(), run);
  }
}

// Number of images from frame `first` on that were processed.
int NumProcessedFrom(int first, const OdometryResult& result) {
  return static_cast<int>(
      std::count_if(result.frames.begin() + first, result.frames.end(),
                    [](const FrameResult& frame) { return HasImage(frame.status); }));
}

// What counts as a failure of tracking, in the map of a run that only localises.
void CheckLocalization(const std::string& map, const std::optional<int>& first, SequenceRun* run) {
  if (!first) {
    Fail(kExitTrackingFailed,
         "never found in the map " + map +
             "; record the same place, or extend the map by this sequence with --map",
         run);
  } else if (run->summary.num_estimated <
             kMinTrackedRatio * NumProcessedFrom(*first, run->result)) {
    Fail(kExitTrackingFailed, DescribeFailure(run->summary), run);
  }
}

// Summarises the result, and decides whether tracking has failed.
void SummarizeRun(const RunMap* map, SequenceRun* run) {
  run->summary = Summarize(run->result);
  if (run->exit_code != kExitSuccess) return;
  if (map != nullptr && map->localizes()) {
    CheckLocalization(map->localize(), FirstLocalizedFrame(run->result), run);
  } else if (TrackingFailed(run->summary)) {
    Fail(kExitTrackingFailed, DescribeFailure(run->summary), run);
  }
}

void WarnAboutUnreadableImages(const SequenceRun& run) {
  if (run.context.first_unreadable.empty() || run.exit_code == kExitError) return;
  PrintWarning(FormatText("%d of %d images cannot be read; their frames have the status unreadable "
                          "and interpolated poses (--strict stops at the first one): ",
                          run.summary.Count(TrackingStatus::kUnreadable), run.summary.num_frames) +
               run.context.first_unreadable);
}

}  // namespace

void AddRunArguments(CLI::App* command, RunArguments* arguments) {
  const CLI::Validator whole = WholeNumberFrom(1, std::numeric_limits<int>::max());
  const auto at_least_one = [whole](std::string& text) {
    const std::string problem = whole(text);
    return problem.empty() ? problem : problem + "; omit it to process all images";
  };
  command->add_option("--max-frames", arguments->max_frames, "Process only the first N images")
      ->transform(CLI::Validator(at_least_one, ""));
  command->add_flag("--strict", arguments->strict, "Stop at the first image that cannot be read");
  CLI::Option* quiet =
      command->add_flag("--quiet", arguments->quiet, "Print neither progress nor results");
  command->add_flag("--json", arguments->json, "Print the results as JSON")->excludes(quiet);
}

bool SequenceRun::HasImages() const {
  return summary.Count(TrackingStatus::kUnreadable) < summary.num_frames;
}

SequenceRun RunSequence(const RgbdDecoder& decoder, const Configuration& configuration,
                        const RunArguments& arguments, const InterruptGuard& interrupt,
                        const RunCallbacks& callbacks) {
  SequenceRun run;
  RunContext& context = run.context;
  context = MakeContext(decoder, configuration);
  const int num_frames = NumFrames(decoder, arguments.max_frames);

  LogStart(context, num_frames);

  CostMeter cost;
  const OdometryOptions& options = context.configuration.odometry;
  Odometry odometry(options, context.calibration.camera, context.calibration.distortion);
  if (!decoder.index().camera) odometry.SkipClippedDepthSearch();
  odometry.SetWindowObserver(callbacks.window);
  odometry.SetWindowFactors(callbacks.window_factors);
  odometry.SetTrackingObserver(callbacks.tracking);
  if (options.snapshots.realtime && !decoder.index().camera) {
    WarnAboutShortenedPauses(num_frames, &context.sequence);
  }
  LoopProgress progress;
  if (callbacks.resume) {
    callbacks.checkpoints->Restore(&odometry, &cost, &progress);
    if (progress.num_images > num_frames) {
      throw std::runtime_error(FormatText(
          "the run to be resumed has %d images already, more than the %d of --max-frames",
          progress.num_images, num_frames));
    }
    callbacks.resume(odometry.frames());
  }
  if (callbacks.map != nullptr) callbacks.map->Begin(&odometry);
  const std::unique_ptr<ImageFeed> feed =
      MakeImageFeed(decoder, progress.num_images, num_frames, options.snapshots.realtime);
  FrameLoop loop(decoder, num_frames, arguments.strict, feed.get(), &odometry, progress);
  RunLoop(arguments, num_frames, interrupt, callbacks, cost, &odometry, &loop, &run);
  ReturnFreedMemory();  // for the final bundle adjustment of lines, which is larger than a window
  FinishOdometry(callbacks.map != nullptr && callbacks.map->localizes(), &odometry, &run);
  if (callbacks.map != nullptr) SaveMap(callbacks.map, &odometry, &run);
  context.cost = cost.Read();
  context.realtime = feed->Realtime();
  if (context.realtime) context.realtime->num_late_maps = run.result.num_late_maps;
  if (feed->num_dropped_by_camera() > 0) {
    PrintWarning(FormatText("%d images of the camera were dropped, because tracking was late",
                            feed->num_dropped_by_camera()));
  }
  context.first_unreadable = loop.progress().first_unreadable;
  SummarizeRun(callbacks.map, &run);
  if (!context.sequence.ground_truth.empty() && loop.progress().num_images > 0) {
    const std::vector<TimedPose> poses = TrajectoryOf(run.result);
    EvaluationOptions options;
    options.estimate_is_own = true;
    context.error = EvaluateTrajectory(context.sequence.ground_truth, poses, options);
    for (const std::string& warning : context.error->warnings) {
      PrintWarning(TruthName(context.sequence) + ": " + warning);
    }
    context.segment_errors = EvaluateSegments(context.sequence.ground_truth, poses, options);
  }
  WarnAboutUnreadableImages(run);
  return run;
}

}  // namespace msc_vo
