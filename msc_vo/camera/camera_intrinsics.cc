// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/camera_intrinsics.h"

#include <cmath>

namespace msc_vo {

CameraIntrinsics Corrected(const CameraIntrinsics& given,
                           const SensorCorrection::Vector& correction) {
  using S = SensorCorrection;
  CameraIntrinsics corrected = given;
  LensDistortion& lens = corrected.distortion;
  PinholeCamera& recorded = lens.recorded ? *lens.recorded : corrected.camera;
  recorded.cx += recorded.FocalLength() * correction(S::kCenterX);
  recorded.cy += recorded.FocalLength() * correction(S::kCenterY);
  recorded.fx *= std::exp(correction(S::kFocalLength));
  recorded.fy *= std::exp(correction(S::kFocalLength));
  lens.k[0] += correction(S::kK1);
  lens.k[1] += correction(S::kK2);
  if (!S::RegistrationOf(correction).isZero(0.0)) corrected.registration = correction;
  return corrected;
}

bool HasSameRegistration(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  using S = SensorCorrection;
  const auto registration = [](const CameraIntrinsics& intrinsics) {
    return S::RegistrationOf(intrinsics.registration.value_or(S::Vector::Zero()));
  };
  return registration(a) == registration(b);
}

Eigen::Vector2d MovePixel(const CameraIntrinsics& from, const CameraIntrinsics& to,
                          const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d recorded =
      from.distortion.IsZero() ? pixel : from.distortion.Distort(from.camera, pixel);
  return to.distortion.IsZero() ? recorded : to.distortion.Undistort(to.camera, recorded);
}

}  // namespace msc_vo
