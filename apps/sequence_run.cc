// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/sequence_run.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "apps/cost_meter.h"
#include "apps/progress.h"
#include "msc_vo/io/paced_source.h"
#include "msc_vo/io/rgbd_source.h"

namespace msc_vo {

namespace {

// Gives the odometry one image after the other until there is none left.
class ImageFeed {
 public:
  virtual ~ImageFeed() = default;
  // False at the end. Throws what decoding and the odometry throw.
  virtual bool Step(Odometry* odometry, FrameResult* frame) = 0;
  virtual std::optional<RealtimeSummary> Realtime() const = 0;
};

class FastFeed : public ImageFeed {
 public:
  FastFeed(const RgbdDecoder& decoder, int num_frames) : source_(decoder, 0, num_frames) {}

  bool Step(Odometry* odometry, FrameResult* frame) override {
    if (!source_.Next(&image_)) return false;
    *frame = odometry->Process(image_);
    return true;
  }
  std::optional<RealtimeSummary> Realtime() const override { return std::nullopt; }

 private:
  RgbdSource source_;
  RgbdImage image_;
};

class PacedFeed : public ImageFeed {
 public:
  PacedFeed(const RgbdDecoder& decoder, int num_frames)
      : decoder_(decoder), source_(decoder, 0, num_frames) {}

  bool Step(Odometry* odometry, FrameResult* frame) override {
    dropped_.clear();
    if (!source_.Next(&image_, &dropped_)) return false;
    for (const int i : dropped_) odometry->Drop(i, decoder_.index().entries[i].timestamp);
    *frame = odometry->Process(image_);
    ages_.push_back(1000.0 * source_.Age());
    return true;
  }
  std::optional<RealtimeSummary> Realtime() const override {
    return RealtimeSummary{SummarizeStage("pose_age", ages_), 0};
  }

 private:
  const RgbdDecoder& decoder_;
  PacedSource source_;
  RgbdImage image_;
  std::vector<int> dropped_;
  std::vector<double> ages_;  // milliseconds
};

std::unique_ptr<ImageFeed> MakeFeed(const RgbdDecoder& decoder, int num_frames, bool realtime) {
  if (realtime) return std::make_unique<PacedFeed>(decoder, num_frames);
  return std::make_unique<FastFeed>(decoder, num_frames);
}

}  // namespace

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
  OdometryOptions& options = context.configuration.odometry;
  if (!options.mapping.readout_time) {
    options.mapping.readout_time = context.calibration.readout_time;
  }
  Odometry odometry(options, context.calibration.camera, context.calibration.distortion);
  odometry.SetWindowObserver(window_observer);
  const std::unique_ptr<ImageFeed> feed =
      MakeFeed(decoder, num_frames, configuration.odometry.snapshots.realtime);
  Progress progress(num_frames);
  int done = 0;
  try {
    for (FrameResult frame; !interrupt.IsInterrupted() && feed->Step(&odometry, &frame);) {
      done = static_cast<int>(frame.id) + 1;
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
  context.realtime = feed->Realtime();
  if (context.realtime) context.realtime->num_late_maps = run.result.num_late_maps;
  run.summary = Summarize(run.result);
  if (run.exit_code == kExitSuccess && TrackingFailed(run.summary)) {
    context.outcome = DescribeFailure(run.summary);
    run.exit_code = kExitTrackingFailed;
  }
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
