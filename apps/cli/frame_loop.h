// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "apps/cli/image_feed.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// Processes the images of a feed with the odometry, one per step. Unreadable images become frames
/// with the status unreadable.
class FrameLoop {
 public:
  /// `num_frames`: images in the feed. `strict`: an unreadable image is an error. All references
  /// must outlive the loop.
  FrameLoop(const RgbdDecoder& decoder, int num_frames, bool strict, ImageFeed* feed,
            Odometry* odometry);

  /// Returns false at the end. Throws exceptions of the odometry, UnreadableImage if the loop is
  /// strict, and std::runtime_error if more than half of the images or all of the first 30 are
  /// unreadable.
  bool Step(FrameResult* frame);

  /// Error message of the first unreadable image; empty without one.
  const std::string& first_unreadable() const { return first_unreadable_; }

 private:
  FrameResult Skip(const UnreadableImage& image);
  void CheckNumUnreadable(int num_done) const;

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

}  // namespace msc_vo
