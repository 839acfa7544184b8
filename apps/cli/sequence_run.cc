// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/sequence_run.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/command_log.h"
#include "apps/cli/cost_meter.h"
#include "apps/cli/progress.h"
#include "msc_vo/datasets/paced_source.h"
#include "msc_vo/datasets/rgbd_source.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// The images of a sequence, as fast as they are asked for or at the pace of their time stamps.
class ImageFeed {
 public:
  virtual ~ImageFeed() = default;
  // False at the end. The indices of images before this one that came too late are appended to
  // `dropped`. Throws UnreadableImage, and goes on with the image behind it when called again.
  virtual bool Next(RgbdImage* image, std::vector<int>* dropped) = 0;
  // The pose of the last image is known now.
  virtual void RecordPose() {}
  virtual std::optional<RealtimeSummary> Realtime() const { return std::nullopt; }
};

class FastFeed : public ImageFeed {
 public:
  FastFeed(const RgbdDecoder& decoder, int num_frames) : source_(decoder, 0, num_frames) {}

  bool Next(RgbdImage* image, std::vector<int>* /*dropped*/) override {
    return source_.Next(image);
  }

 private:
  RgbdSource source_;
};

class PacedFeed : public ImageFeed {
 public:
  PacedFeed(const RgbdDecoder& decoder, int num_frames) : source_(decoder, 0, num_frames) {}

  bool Next(RgbdImage* image, std::vector<int>* dropped) override {
    return source_.Next(image, dropped);
  }
  void RecordPose() override { ages_.push_back(1000.0 * source_.Age()); }
  std::optional<RealtimeSummary> Realtime() const override {
    return RealtimeSummary{SummarizeStage("pose_age", ages_), 0};
  }

 private:
  PacedSource source_;
  std::vector<double> ages_;  // milliseconds
};

std::unique_ptr<ImageFeed> MakeFeed(const RgbdDecoder& decoder, int num_frames, bool realtime) {
  if (realtime) return std::make_unique<PacedFeed>(decoder, num_frames);
  return std::make_unique<FastFeed>(decoder, num_frames);
}

// Says which pauses between two stamps a feed in real time cuts short; empty: none.
std::string DescribeCutPauses(const std::vector<SequenceEntry>& entries, int num_frames) {
  int count = 0;
  int longest = 0;  // index of the image behind it
  const auto pause = [&entries](int i) { return entries[i].timestamp - entries[i - 1].timestamp; };
  for (int i = 1; i < num_frames; ++i) {
    if (pause(i) <= PacedSource::kMaxPause) continue;
    if (count++ == 0 || pause(i) > pause(longest)) longest = i;
  }
  if (count == 0) return "";
  return FormatText(
             "%d pauses longer than %g s between two images are cut to that in real time; the "
             "longest, %.3f s, is before ",
             count, PacedSource::kMaxPause, pause(longest)) +
         entries[longest].color_path;
}

// Takes the images of a feed through the odometry, one after the other.
class FrameLoop {
 public:
  FrameLoop(const RgbdDecoder& decoder, int num_frames, bool strict, ImageFeed* feed,
            Odometry* odometry)
      : entries_(decoder.index().entries),
        num_frames_(num_frames),
        strict_(strict),
        feed_(feed),
        odometry_(odometry) {}

  // False at the end. Throws what the odometry throws, UnreadableImage if the loop is strict, and
  // std::runtime_error if too many images cannot be read.
  bool Step(FrameResult* frame) {
    dropped_.clear();
    std::optional<UnreadableImage> unreadable;
    try {
      if (!feed_->Next(&image_, &dropped_)) return false;
    } catch (const UnreadableImage& error) {
      if (strict_) throw;
      unreadable = error;
    }
    for (const int i : dropped_) odometry_->Drop(i, entries_[i].timestamp);
    if (unreadable) {
      *frame = Skip(*unreadable);
    } else {
      *frame = odometry_->Process(image_);
      feed_->RecordPose();
    }
    return true;
  }

  // The message of the first image that could not be read; empty: there was none.
  const std::string& first_unreadable() const { return first_unreadable_; }

 private:
  FrameResult Skip(const UnreadableImage& image) {
    if (num_unreadable_++ == 0) first_unreadable_ = image.what();
    Log().warn("{}", image.what());
    const FrameResult frame = odometry_->Drop(image.index(), entries_[image.index()].timestamp,
                                              TrackingStatus::kUnreadable);
    CheckNumUnreadable(image.index() + 1);
    return frame;
  }

  // A few images may be bad. With more than half, or none at all good at the beginning, the user
  // should know before the end of a long sequence that something else is wrong.
  void CheckNumUnreadable(int num_done) const {
    constexpr int kMaxBeforeTheFirst = 30;  // images: a second of most cameras
    if (2 * num_unreadable_ > num_frames_) {
      throw std::runtime_error(
          FormatText("more than half of the %d images cannot be read; the first: ", num_frames_) +
          first_unreadable_);
    }
    if (num_unreadable_ == num_done && num_done >= kMaxBeforeTheFirst) {
      throw std::runtime_error(
          FormatText("none of the first %d images can be read; the first: ", num_done) +
          first_unreadable_);
    }
  }

  const std::vector<SequenceEntry>& entries_;
  int num_frames_;
  bool strict_;
  ImageFeed* feed_;
  Odometry* odometry_;
  RgbdImage image_;
  std::vector<int> dropped_;
  int num_unreadable_ = 0;
  std::string first_unreadable_;
};

// The readout time that the options give precedes that of the calibration; both get the one that
// applies, none if it is to be learnt.
void ResolveReadoutTime(std::optional<double>* option, Calibration* calibration) {
  if (*option) {
    calibration->readout_time = *option;
    calibration->readout_origin = "mapping.readout_time";
  } else {
    *option = calibration->readout_time;
  }
}

// Of a run that goes well until the end.
RunContext MakeContext(const RgbdDecoder& decoder, const Configuration& configuration) {
  RunContext context;
  context.command_line = CommandLine();
  context.outcome = "complete";
  context.sequence = decoder.index();
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

void WarnOfCutPauses(int num_frames, SequenceIndex* sequence) {
  const std::string pauses = DescribeCutPauses(sequence->entries, num_frames);
  if (pauses.empty()) return;
  PrintWarning(pauses);
  sequence->warnings.push_back(pauses);
}

// Processes the images until the end, an error or an interruption. Returns how many were processed.
int RunLoop(const RunArguments& arguments, int num_frames, const InterruptGuard& interrupt,
            const FrameObserver& frame_observer, FrameLoop* loop, SequenceRun* run) {
  Progress progress(num_frames);
  int done = 0;
  try {
    for (FrameResult frame; !interrupt.IsInterrupted() && loop->Step(&frame);) {
      done = static_cast<int>(frame.id) + 1;
      frame_observer(frame);
      if (!arguments.quiet) progress.Update(done, ToString(frame.status));
    }
  } catch (const std::exception& error) {
    Fail(kExitError, error.what(), run);
  }
  if (!arguments.quiet) progress.Finish();
  if (run->exit_code == kExitSuccess && interrupt.IsInterrupted() && done < num_frames) {
    Fail(kExitInterrupted, "interrupted", run);
  }
  return done;
}

void FinishOdometry(Odometry* odometry, SequenceRun* run) {
  try {
    run->result = odometry->Finish();
  } catch (const std::exception& error) {  // of the last keyframe step
    Fail(kExitError, error.what(), run);
    run->result = odometry->Finish();
  }
}

void PrintUnreadable(const SequenceRun& run) {
  if (run.context.first_unreadable.empty() || run.exit_code == kExitError) return;
  PrintWarning(FormatText("%d of %d images cannot be read; their frames have the status unreadable "
                          "and poses between their neighbours (--strict stops at the first): ",
                          run.summary.Count(TrackingStatus::kUnreadable), run.summary.num_frames) +
               run.context.first_unreadable);
}

}  // namespace

void AddRunArguments(CLI::App* command, RunArguments* arguments) {
  const auto at_least_one = [](const std::string& text) -> std::string {
    const std::optional<double> number = ParseNumber(text);
    if (number && *number >= 1.0) return "";
    return "must be at least 1, not " + text + "; leave it out to take all images";
  };
  command
      ->add_option("--max-frames", arguments->max_frames,
                   "Stop after so many images of the sequence")
      ->check(at_least_one);
  command->add_flag("--strict", arguments->strict,
                    "Stop at the first image that cannot be read, instead of going on without it");
  command->add_flag("--quiet", arguments->quiet, "No progress, no table");
}

bool SequenceRun::HasImages() const {
  return summary.Count(TrackingStatus::kUnreadable) < summary.num_frames;
}

SequenceRun RunSequence(const RgbdDecoder& decoder, const Configuration& configuration,
                        const RunArguments& arguments, const InterruptGuard& interrupt,
                        const FrameObserver& frame_observer,
                        const WindowObserver& window_observer) {
  SequenceRun run;
  RunContext& context = run.context;
  context = MakeContext(decoder, configuration);
  const int num_frames =
      arguments.max_frames > 0 ? std::min(arguments.max_frames, decoder.size()) : decoder.size();

  LogStart(context, num_frames);

  const CostMeter cost;
  const OdometryOptions& options = context.configuration.odometry;
  Odometry odometry(options, context.calibration.camera, context.calibration.distortion);
  odometry.SetWindowObserver(window_observer);
  if (options.snapshots.realtime) WarnOfCutPauses(num_frames, &context.sequence);
  const std::unique_ptr<ImageFeed> feed = MakeFeed(decoder, num_frames, options.snapshots.realtime);
  FrameLoop loop(decoder, num_frames, arguments.strict, feed.get(), &odometry);
  const int done = RunLoop(arguments, num_frames, interrupt, frame_observer, &loop, &run);
  FinishOdometry(&odometry, &run);
  context.cost = cost.Read();
  context.realtime = feed->Realtime();
  if (context.realtime) context.realtime->num_late_maps = run.result.num_late_maps;
  context.first_unreadable = loop.first_unreadable();
  run.summary = Summarize(run.result);
  if (run.exit_code == kExitSuccess && TrackingFailed(run.summary)) {
    Fail(kExitTrackingFailed, DescribeFailure(run.summary), &run);
  }
  if (!context.sequence.ground_truth.empty() && done > 0) {
    context.error = EvaluateTrajectory(context.sequence.ground_truth, TrajectoryOf(run.result));
  }
  PrintUnreadable(run);
  return run;
}

void PrintWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) PrintWarning(warning);
}

}  // namespace msc_vo
