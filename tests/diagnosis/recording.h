// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

// A sequence in memory that tests damage and write as a folder in TUM layout.
struct Recording {
  struct Image {
    double color_stamp = 0.0;  // seconds
    double depth_stamp = 0.0;
    cv::Mat color;  // CV_8UC1 or CV_8UC3
    cv::Mat depth;  // CV_16UC1
  };

  std::vector<Image> images;
  Calibration calibration;
  std::vector<TimedPose> truth;
  double stamp_factor = 1.0;  // of the stamps in the lists

  // Writes rgb/, depth/, rgb.txt, depth.txt, camera.txt and groundtruth.txt.
  void Write(const std::string& folder) const;
};

// A slow sequence of small images with the depth noise of a Kinect.
SyntheticSequenceOptions SmallRoom();

// Renders `count` images with 5000 depth units per metre.
Recording Record(const SyntheticSequenceOptions& options, int count);

}  // namespace msc_vo
