// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/phone_recordings/phone_images.h"

namespace msc_vo {

/// What the recording application of a telephone wrote of one image.
struct PhoneFrame {
  double timestamp = 0.0;  ///< seconds
  PhoneImage image;
  PinholeCamera camera;                  ///< of the colour image
  std::optional<Rigid3> world_from_cam;  ///< x right, y down, z forward; none: not tracked
};

/// A recording, before its images are looked at.
struct PhoneRecording {
  std::vector<PhoneFrame> frames;
  std::shared_ptr<const VideoImages> video;  ///< null: the colour images are files
  ConfidenceValues confidence;
  std::string poses_by;    ///< whose estimate the poses are, "ARKit"
  std::string intrinsics;  ///< where the intrinsics are from, for messages
  std::string times;       ///< where the times are from, for messages
  size_t num_listed = 0;   ///< images that the recording names
  std::vector<std::string> warnings;
};

/// Throws std::runtime_error if the median interval of the times, seconds, is none of a camera:
/// they are in another unit then. `origin` names where they are from.
void CheckIntervals(const std::vector<double>& times, const std::string& origin);

/// Makes a sequence of a recording whose depth images show the view of the colour images, in
/// millimetres. Depths below the confidence `least` are left out. Throws std::runtime_error if
/// there are no frames, the times are not in seconds, or the images are of several sizes.
SequenceIndex MakePhoneSequence(PhoneRecording recording, DepthConfidence least);

/// Pose of the camera with the axes of images (x right, y down, z forward), from its rotation with
/// the axes of ARKit (x right, y up, z backward). None if it is not a rotation.
std::optional<Rigid3> PoseFromArkit(const Eigen::Matrix4d& world_from_arkit_camera);

}  // namespace msc_vo
