// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration_correction.h"

#include <cmath>

#include <Eigen/Geometry>

#include "msc_vo/camera/camera_intrinsics.h"

namespace msc_vo {

namespace {

using S = SensorCorrection;

bool CorrectsRegistration(const S::Vector& correction) {
  return (correction.segment<S::kDepthOffset - S::kDepthFocalLength>(S::kDepthFocalLength)
              .array() != 0.0)
      .any();
}

// The depth camera of registered images is the colour camera.
DepthCamera DepthCameraOf(const Calibration& calibration) {
  if (calibration.depth_camera) return *calibration.depth_camera;
  DepthCamera depth_camera;
  depth_camera.camera = calibration.Recorded();
  // The correction of a radial-tangential lens is small, and neglects it.
  if (calibration.distortion.model != LensModel::kRadialTangential) {
    depth_camera.distortion = calibration.distortion;
    depth_camera.distortion.recorded.reset();
  }
  return depth_camera;
}

}  // namespace

Calibration Corrected(const Calibration& calibration, const S::Vector& correction) {
  const PinholeCamera& given = calibration.Recorded();
  LensDistortion lens = calibration.distortion;
  lens.recorded.reset();
  const CameraIntrinsics recorded = Corrected(CameraIntrinsics{given, lens}, correction);
  const PinholeCamera& camera = recorded.camera;
  Calibration corrected = calibration;
  corrected.distortion.k = recorded.distortion.k;
  corrected.SetRecorded(camera);
  corrected.SetUndistorted();
  if (!CorrectsRegistration(correction)) return corrected;

  // A point with the normalised coordinates x and inverse depth w has colour pixel p = F x + c. Its
  // depth is at pixel s R (p - c_0) + c_0 + d + f_0 t w of the given depth image: at
  // A x + b + w u with the normalised coordinates of the given camera.
  const double scale = std::exp(correction(S::kDepthFocalLength));
  const Eigen::Matrix2d roll = Eigen::Rotation2Dd(correction(S::kDepthRoll)).toRotationMatrix();
  const Eigen::Vector2d given_focal(given.fx, given.fy);
  const Eigen::Vector2d offset(camera.cx - given.cx, camera.cy - given.cy);
  const Eigen::Vector2d shift(correction(S::kDepthX), correction(S::kDepthY));
  const Eigen::Vector2d b = (scale * roll * offset + shift).cwiseQuotient(given_focal);
  const Eigen::Vector2d parallax =
      given.FocalLength() *
      Eigen::Vector2d(correction(S::kDepthParallaxX), correction(S::kDepthParallaxY))
          .cwiseQuotient(given_focal);
  const double magnification = scale * camera.fx / given.fx;

  DepthCamera depth_camera = DepthCameraOf(calibration);
  PinholeCamera& depth = depth_camera.camera;
  const Eigen::Matrix2d given_rotation =
      depth_camera.depth_from_color.rotation().toRotationMatrix().topLeftCorner<2, 2>();
  const Eigen::Vector2d center_shift = given_rotation * b;
  depth.cx += depth.fx * center_shift.x();
  depth.cy += depth.fy * center_shift.y();
  depth.fx *= magnification;
  depth.fy *= magnification;
  const Eigen::Vector2d translation = given_rotation * parallax / magnification;
  const Eigen::Vector3d given_translation = depth_camera.depth_from_color.translation();
  const Eigen::AngleAxisd turn(correction(S::kDepthRoll), Eigen::Vector3d::UnitZ());
  depth_camera.depth_from_color =
      Rigid3(depth_camera.depth_from_color.rotation() * Eigen::Quaterniond(turn),
             Eigen::Vector3d(given_translation.x() / magnification + translation.x(),
                             given_translation.y() / magnification + translation.y(),
                             given_translation.z()));
  corrected.depth_camera = depth_camera;
  return corrected;
}

}  // namespace msc_vo
