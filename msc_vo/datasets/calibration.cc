// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr double kMaxReadoutTime = 1.0;  // seconds; no camera takes longer for an image

// Raw units per metre of 16-bit depth images: a step of 10 cm, and a range of 65 cm.
constexpr double kMinDepthScale = 10.0;
constexpr double kMaxDepthScale = 1e5;

}  // namespace

bool Calibration::IsValid(std::string* error) const {
  if (!camera.IsValid(error)) return false;
  if (!IsInvertible(distortion, camera, error)) return false;
  if (depth_camera && !depth_camera->IsValid(error)) return false;
  if (!(depth_scale >= kMinDepthScale && depth_scale <= kMaxDepthScale)) {
    *error = "camera: depth_scale = " + FormatNumber(depth_scale) + " must be from " +
             FormatNumber(kMinDepthScale) + " to " + FormatNumber(kMaxDepthScale) +
             " raw depth units per metre";
    return false;
  }
  if (readout_time && !(std::abs(*readout_time) < kMaxReadoutTime)) {
    *error = "camera: readout_time = " + FormatNumber(*readout_time) + " must be between -" +
             FormatNumber(kMaxReadoutTime) + " and " + FormatNumber(kMaxReadoutTime) +
             " seconds from the first image row to the last";
    return false;
  }
  return true;
}

std::optional<Eigen::Quaterniond> NormalizedQuaternion(const std::vector<double>& xyzw) {
  constexpr double kMaxLengthError = 0.05;
  const Eigen::Quaterniond rotation(xyzw.at(3), xyzw.at(0), xyzw.at(1), xyzw.at(2));
  if (!(std::abs(rotation.norm() - 1.0) <= kMaxLengthError)) return std::nullopt;
  return rotation.normalized();
}

bool DepthCameraSettings::IsEmpty() const {
  return !fx && !fy && !cx && !cy && !width && !height && translation.empty() && rotation.empty() &&
         !inverse_depth_offset;
}

bool CameraSettings::IsEmpty() const {
  return preset.empty() && !fx && !fy && !cx && !cy && !width && !height && !depth_scale &&
         depth_camera.IsEmpty() &&
         std::none_of(distortion.begin(), distortion.end(),
                      [](const std::optional<double>& k) { return k.has_value(); });
}

}  // namespace msc_vo
