// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/odometry/tracking_observer.h"
#include "msc_vo/report/frame_view.h"

namespace msc_vo {

/// Bounds on the views of a report.
struct FrameViewLimits {
  int max_spaced = 200;        ///< evenly spaced frames
  size_t max_bytes = 5 << 20;  ///< of all views; base64 makes a third more of them
};

/// Collects views of a run for the report: of every keyframe, and of every 2^k-th frame with the
/// smallest k for which there are at most `max_spaced` of these. While the views take more than
/// `max_bytes`, k grows; if keyframes alone take more, only every 2^j-th of them is kept.
class FrameViewCollector {
 public:
  /// `num_frames`: expected frames of the run. `distortion`: of the images.
  FrameViewCollector(int num_frames, const LensDistortion& distortion,
                     const FrameViewLimits& limits = {});

  void Add(const TrackedImage& tracked);

  /// Views by ascending id of the frame; the collector is then empty.
  std::vector<FrameView> Take();

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [distortion, limits, entries, num_bytes, num_keyframes, stride, keyframe_stride] =
        *this;  // all members, or it does not compile
    archive(entries, num_bytes, num_keyframes, stride, keyframe_stride);
  }

 private:
  struct Entry {
    std::shared_ptr<FrameView> view;  // unchanged until Take(): checkpoints write it once
    int keyframe = -1;                // number of the keyframe; -1: another frame
  };

  // Whether a frame is kept with the present strides.
  bool IsKept(int frame, int keyframe) const;
  // Doubles a stride; false if nothing is left to thin.
  bool Thin();

  LensDistortion distortion_;
  FrameViewLimits limits_;
  std::map<int, Entry> entries_;  // by id of the frame
  size_t num_bytes_ = 0;
  int num_keyframes_ = 0;
  int stride_ = 1;           // of frames
  int keyframe_stride_ = 1;  // of keyframes
};

}  // namespace msc_vo
