// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/image_feed.h"

#include "msc_vo/datasets/camera_source.h"
#include "msc_vo/datasets/paced_source.h"
#include "msc_vo/datasets/rgbd_source.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

class FastFeed : public ImageFeed {
 public:
  FastFeed(const RgbdDecoder& decoder, int first, int num_frames)
      : source_(decoder, first, num_frames) {}

  bool Next(RgbdImage* image, std::vector<int>* /*dropped*/) override {
    return source_.Next(image);
  }

 private:
  RgbdSource source_;
};

class PacedFeed : public ImageFeed {
 public:
  PacedFeed(const RgbdDecoder& decoder, int first, int num_frames)
      : source_(decoder, first, num_frames) {}

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

class CameraFeed : public ImageFeed {
 public:
  CameraFeed(const RgbdDecoder& decoder, int num_frames)
      : decoder_(decoder),
        num_frames_(num_frames),
        source_(decoder.index().camera.get(), PacedSource::kMaxWaiting) {}

  bool Next(RgbdImage* image, std::vector<int>* /*dropped*/) override {
    CameraImage taken;
    if (num_frames_ > 0 && next_ == num_frames_) return false;
    if (!source_.Next(&taken, &num_dropped_)) return false;
    *image = decoder_.Convert(taken, next_++);
    return true;
  }
  void RecordPose() override { ages_.push_back(source_.AgeMilliseconds()); }
  std::optional<RealtimeSummary> Realtime() const override {
    return RealtimeSummary{SummarizeStage("pose_age", ages_), 0};
  }
  int num_dropped_by_camera() const override { return num_dropped_; }

 private:
  const RgbdDecoder& decoder_;
  int num_frames_;
  int next_ = 0;
  int num_dropped_ = 0;
  CameraSource source_;
  std::vector<double> ages_;  // milliseconds
};

}  // namespace

int NumFrames(const RgbdDecoder& decoder, int max_frames) {
  if (decoder.index().camera) return max_frames;
  return max_frames > 0 ? std::min(max_frames, decoder.size()) : decoder.size();
}

std::unique_ptr<ImageFeed> MakeImageFeed(const RgbdDecoder& decoder, int first, int num_frames,
                                         bool realtime) {
  if (decoder.index().camera) return std::make_unique<CameraFeed>(decoder, num_frames);
  if (realtime) return std::make_unique<PacedFeed>(decoder, first, num_frames);
  return std::make_unique<FastFeed>(decoder, first, num_frames);
}

std::string DescribeShortenedPauses(const std::vector<SequenceEntry>& entries, int num_frames) {
  int count = 0;
  int longest = 0;  // index of the image after it
  const auto pause = [&entries](int i) { return entries[i].timestamp - entries[i - 1].timestamp; };
  for (int i = 1; i < num_frames; ++i) {
    if (pause(i) <= PacedSource::kMaxPause) continue;
    if (count++ == 0 || pause(i) > pause(longest)) longest = i;
  }
  if (count == 0) return "";
  return FormatText(
             "%d pauses longer than %g s between two images are shortened to that in real time; "
             "the longest, %.3f s, is before ",
             count, PacedSource::kMaxPause, pause(longest)) +
         entries[longest].color_path;
}

}  // namespace msc_vo
