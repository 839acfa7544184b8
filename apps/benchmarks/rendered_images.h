// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

/// The sequence used by the benchmarks: a furnished room at 640x480 with the noise of a Kinect.
inline SyntheticSequence BenchmarkSequence() {
  SyntheticSequenceOptions options;
  options.kinect_depth = true;
  return SyntheticSequence(options);
}

/// Renders image `index` of a sequence.
inline RgbdImage RenderImage(const SyntheticSequence& sequence, int index) {
  SyntheticFrame frame = sequence.Render(index);
  std::vector<uint8_t> gray = frame.image.Gray();
  RgbdImage image;
  image.id = index;
  image.timestamp = frame.pose.timestamp;
  const int height = frame.image.height;
  const int width = frame.image.width;
  image.gray = cv::Mat(height, width, CV_8UC1, gray.data()).clone();
  image.depth = cv::Mat(height, width, CV_32FC1, frame.image.depth.data()).clone();
  return image;
}

}  // namespace msc_vo
