// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_camera.h"

#include <cmath>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Two cameras of one device are closer than that, metres; a larger number is in millimetres.
constexpr double kMaxDistance = 1.0;
// Largest difference of the length of the quaternion from 1.
constexpr double kMaxLengthError = 1e-6;
// The offset corrects small errors of a sensor; this is the inverse depth of two metres.
constexpr double kMaxInverseDepthOffset = 0.5;

std::string Number(double value) { return FormatText("%g", value); }

}  // namespace

double DepthCamera::Roll() const {
  const Eigen::Matrix3d rotation = depth_from_color.rotation().toRotationMatrix();
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

bool DepthCamera::IsValid(std::string* error) const {
  if (!camera.IsValid(error) || !IsInvertible(distortion, camera, error)) {
    *error = "depth " + *error;
    return false;
  }
  const double distance = depth_from_color.translation().norm();
  if (!(distance <= kMaxDistance)) {
    *error = "depth camera: translation is " + Number(distance) + " long, but must be at most " +
             Number(kMaxDistance) + " metre";
    return false;
  }
  const double length = depth_from_color.rotation().norm();
  if (!(std::abs(length - 1.0) <= kMaxLengthError)) {
    *error =
        "depth camera: rotation must be a quaternion x y z w of length 1, not " + Number(length);
    return false;
  }
  // Otherwise the colour camera would see nothing of the depth image.
  if (!((depth_from_color.rotation() * Eigen::Vector3d::UnitZ()).z() > 0.0)) {
    *error =
        "depth camera: rotation must leave the optical axes within 90 degrees of each other; "
        "is the order of the quaternion x y z w?";
    return false;
  }
  if (!(std::abs(inverse_depth_offset) <= kMaxInverseDepthOffset)) {
    *error = "depth camera: inverse_depth_offset = " + Number(inverse_depth_offset) +
             " must be from -" + Number(kMaxInverseDepthOffset) + " to " +
             Number(kMaxInverseDepthOffset) + " 1/metres";
    return false;
  }
  return true;
}

}  // namespace msc_vo
