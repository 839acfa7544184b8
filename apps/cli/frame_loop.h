// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "apps/cli/image_feed.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// How far the images of a sequence have been processed.
struct LoopProgress {
  int num_images = 0;  ///< processed or skipped; the next one has this number
  int num_unreadable = 0;
  std::string first_unreadable;  ///< error message; empty without one
};

/// Processes the images of a feed with the odometry, one per step. Unreadable images become frames
/// with the status unreadable.
class FrameLoop {
 public:
  /// `num_frames`: images of the run. `strict`: an unreadable image is an error. `progress`: images
  /// that precede those of the feed. All references must outlive the loop.
  FrameLoop(const RgbdDecoder& decoder, int num_frames, bool strict, ImageFeed* feed,
            Odometry* odometry, LoopProgress progress = {});

  /// Returns false at the end. Throws exceptions of the odometry, UnreadableImage if the loop is
  /// strict, and std::runtime_error if more than half of the images or all of the first 30 are
  /// unreadable.
  bool Step(FrameResult* frame);

  const LoopProgress& progress() const { return progress_; }

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
  LoopProgress progress_;
};

}  // namespace msc_vo
