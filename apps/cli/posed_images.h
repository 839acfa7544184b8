// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// Largest difference of the stamps of an image and its pose in a trajectory, seconds: both come
/// from the same list.
constexpr double kMaxPoseDelay = 0.005;

/// Which poses of a trajectory are used.
struct PoseSelection {
  int every = 1;           ///< every n-th one
  bool all_poses = false;  ///< also those that are predicted, not estimated from the image
};

/// Returns the poses of a trajectory file. Throws std::runtime_error, naming the file, if none is
/// left, and as ReadTrajectory() does.
std::vector<TimedPose> ReadPoses(const std::string& path, const PoseSelection& selection);

/// The same for one world, that of most poses, because the transform to others is unknown. Prints a
/// warning if there are others.
std::vector<TimedPose> ReadPosesOfOneWorld(const std::string& path, const PoseSelection& selection);

/// An image of a sequence and its pose.
struct PosedImage {
  int index = 0;
  TimedPose pose;
};

/// Returns the images that a trajectory has poses of, as ReadPosesOfOneWorld(). Throws
/// std::runtime_error, naming the file, if there are none.
std::vector<PosedImage> FindPosedImages(const std::string& path, const PoseSelection& selection,
                                        const RgbdDecoder& decoder);

}  // namespace msc_vo
