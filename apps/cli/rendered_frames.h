// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <deque>
#include <future>
#include <string>

#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

/// Raw units per metre of the depth images, as in TUM's: 0.2 mm steps, 13 m at most.
inline constexpr double kRenderedDepthScale = 5000.0;

struct ColorEncoding {
  bool jpeg = false;  ///< else PNG
  int jpeg_quality = 95;
};

/// A rendered frame as image files.
struct EncodedFrame {
  TimedPose pose;
  std::string color;  ///< PNG or JPEG
  std::string depth;  ///< 16-bit PNG
};

/// Renders and encodes the frames of a sequence, one per processor at a time.
class RenderedFrames {
 public:
  /// `sequence` must outlive this.
  RenderedFrames(const SyntheticSequence& sequence, const ColorEncoding& encoding, int num_frames);

  /// The next frame; call it `num_frames` times at most.
  EncodedFrame Next();

 private:
  void StartMore();

  const SyntheticSequence& sequence_;
  const ColorEncoding encoding_;
  const int num_frames_;
  int num_started_ = 0;
  std::deque<std::future<EncodedFrame>> started_;  // in order
};

}  // namespace msc_vo
