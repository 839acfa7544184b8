// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

// Depth images, metres, of a camera that moves by half a metre through a scene, 0.2 s apart.
inline std::vector<cv::Mat> RenderDepth(SceneKind scene, SyntheticDepth sensor, int count) {
  SyntheticSequenceOptions options;
  options.scene = scene;
  options.depth = sensor;
  options.width = 320;
  options.height = 240;
  options.fps = 5.0;
  const SyntheticSequence sequence(options);
  std::vector<cv::Mat> images;
  for (int i = 0; i < count; ++i) {
    std::vector<float> depth = sequence.Render(i).image.depth;
    images.push_back(cv::Mat(options.height, options.width, CV_32FC1, depth.data()).clone());
  }
  return images;
}

// The values with `units` per metre, as a driver writes them.
inline cv::Mat RoundedTo(double units, const cv::Mat& metres) {
  cv::Mat raw;
  metres.convertTo(raw, CV_16UC1, units);
  return raw;
}

}  // namespace msc_vo
