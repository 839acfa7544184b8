// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/frame_loop.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/logging/logger.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

FrameLoop::FrameLoop(const RgbdDecoder& decoder, int num_frames, bool strict, ImageFeed* feed,
                     Odometry* odometry, LoopProgress progress)
    : entries_(decoder.index().entries),
      num_frames_(num_frames),
      strict_(strict),
      feed_(feed),
      odometry_(odometry),
      progress_(std::move(progress)) {}

bool FrameLoop::Step(FrameResult* frame) {
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
  progress_.num_images = static_cast<int>(frame->id) + 1;
  return true;
}

FrameResult FrameLoop::Skip(const UnreadableImage& image) {
  if (progress_.num_unreadable++ == 0) progress_.first_unreadable = image.what();
  Log().warn("{}", image.what());
  FrameResult frame = odometry_->Drop(image.index(), entries_[image.index()].timestamp,
                                      TrackingStatus::kUnreadable);
  CheckNumUnreadable(image.index() + 1);
  return frame;
}

// Ends a run early if the problem is evidently not a few damaged images.
void FrameLoop::CheckNumUnreadable(int num_done) const {
  constexpr int kMaxBeforeFirstReadable = 30;
  if (2 * progress_.num_unreadable > num_frames_) {
    throw std::runtime_error(
        FormatText("more than half of the %d images cannot be read; the first: ", num_frames_) +
        progress_.first_unreadable);
  }
  if (progress_.num_unreadable == num_done && num_done >= kMaxBeforeFirstReadable) {
    throw std::runtime_error(
        FormatText("none of the first %d images can be read; the first: ", num_done) +
        progress_.first_unreadable);
  }
}

}  // namespace msc_vo
