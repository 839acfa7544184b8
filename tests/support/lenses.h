// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

// Factory calibration of the colour camera of one Azure Kinect at 1280x720.
inline PinholeCamera AzureKinectCamera() { return {613.02, 612.93, 648.1, 373.49, 1280, 720}; }
inline LensDistortion AzureKinectLens() {
  return {{0.403863, -2.602884, 0.000894, -0.000042, 1.511878, 0.284275, -2.420721, 1.435424},
          LensModel::kRational};
}

// A wide fisheye camera: 120 degrees from the left to the right border.
inline PinholeCamera WideCamera() { return {300.0, 301.0, 322.0, 238.0, 640, 480}; }
inline LensDistortion WideLens() { return {{0.02, -0.012, 0.006, -0.0015}, LensModel::kFisheye}; }

}  // namespace msc_vo
