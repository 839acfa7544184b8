// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

// A structured-light depth sensor as in ICL-NUIM (Handa et al. 2014), after Khoshelham and Elberink
// (2012): depth is looked up at a disturbed place, turned into disparity, disturbed by smooth
// noise, rounded, and turned back. Errors are constant in disparity, so they grow with z^2.
struct KinectNoiseOptions {
  // The sensor's own image, whatever the size that is rendered: pixels below are the sensor's.
  double focal_length = 525.0;    // pixels
  double baseline = 0.075;        // metres, projector to camera
  double lateral_sigma = 0.5;     // pixels, of the place where depth is looked up
  double disparity_sigma = 0.05;  // pixels
  double correlation = 1.5;       // pixels, of the disparity noise: its window matching smooths it
  double disparity_step = 0.125;  // pixels, the Kinect's resolution
  double min_depth = 0.4;         // metres
  double max_depth = 5.0;         // metres
  // Depth is lost at steep places (surfaces seen at grazing angles, depth edges): the probability
  // rises linearly from 0 at the first to 0.95 towards the second slope, the tangent of the angle
  // between the ray and the surface's normal; 3 is 72 degrees, 9 is 84 degrees.
  double keep_slope = 3.0;
  double lose_slope = 9.0;

  bool IsValid(std::string* error) const;
};

// Replaces exact depth (metres along z, row by row, 0: none; camera.width * camera.height values)
// by what the sensor would deliver. The same seed and frame give the same noise. Throws
// std::invalid_argument on options that are not valid or a buffer of another size.
void AddKinectNoise(const KinectNoiseOptions& options, const PinholeCamera& camera, uint64_t seed,
                    uint64_t frame, std::vector<float>* depth);

}  // namespace msc_vo
