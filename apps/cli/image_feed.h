// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// The images of a sequence in order, either as fast as they are requested or at the pace of their
/// time stamps, or those of a live camera.
class ImageFeed {
 public:
  virtual ~ImageFeed() = default;

  /// Returns false at the end. Appends the indices of images that were dropped before this one to
  /// `dropped`. Throws UnreadableImage; the next call continues with the image after it.
  virtual bool Next(RgbdImage* image, std::vector<int>* dropped) = 0;

  /// Call as soon as the pose of the last image is available.
  virtual void RecordPose() {}

  /// Latency so far, without the number of late maps; nullopt unless the feed is in real time.
  virtual std::optional<RealtimeSummary> Realtime() const { return std::nullopt; }

  /// Images of a live camera that were dropped because the reader was late. They are no frames.
  virtual int num_dropped_by_camera() const { return 0; }
};

/// Number of images to process, at most `max_frames` unless it is 0; 0: a live camera without end.
int NumFrames(const RgbdDecoder& decoder, int max_frames);

/// A feed of images `first` to `num_frames` - 1. A live camera begins with 0, and 0 `num_frames`
/// mean without end. The decoder must outlive it.
std::unique_ptr<ImageFeed> MakeImageFeed(const RgbdDecoder& decoder, int first, int num_frames,
                                         bool realtime);

/// Warning about pauses between images that a feed in real time shortens; empty if there are none.
std::string DescribeShortenedPauses(const std::vector<SequenceEntry>& entries, int num_frames);

}  // namespace msc_vo
