// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// The depth image that would have been taken at the time of the colour image. `depth` (CV_32FC1,
// metres, 0: none) was taken at another time, and `motion` takes points from the frame of the
// camera at the time of the colour image to that at the time of the depth image.
//
// Why: most RGB-D cameras take their two images one after the other. In TUM's freiburg1_rpy they
// are 4 ms apart in the mean, and 11 at most; at its 70 degrees per second that moves the image by
// 3 px, and the depth of what is near an edge is that of something else. Pixels are those of the
// raw image: what distortion would change about a shift of a few pixels is left out.
//
// Returns `depth` itself where nothing at a metre moves by half a pixel.
cv::Mat AlignDepth(const PinholeCamera& camera, const cv::Mat& depth, const Rigid3& motion);

}  // namespace msc_vo
