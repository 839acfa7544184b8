// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_camera_correction.h"

#include <cmath>

#include <Eigen/Geometry>

namespace msc_vo {

using S = SensorCorrection;

DepthCamera RegisteredDepthCamera(const PinholeCamera& recorded, const LensDistortion& lens) {
  DepthCamera depth_camera;
  depth_camera.camera = recorded;
  depth_camera.distortion = lens;
  depth_camera.distortion.recorded.reset();
  return depth_camera;
}

DepthCamera Corrected(const DepthCamera& depth_camera, const PinholeCamera& given,
                      const PinholeCamera& corrected, const S::Vector& correction) {
  // A point with the normalised coordinates x and inverse depth w has colour pixel p = F x + c. Its
  // depth is at pixel s R (p - c_0) + c_0 + d + f_0 t w of the given depth image: at
  // A x + b + w u with the normalised coordinates of the given camera.
  const double scale = std::exp(correction(S::kDepthFocalLength));
  const Eigen::Matrix2d roll = Eigen::Rotation2Dd(correction(S::kDepthRoll)).toRotationMatrix();
  const Eigen::Vector2d given_focal(given.fx, given.fy);
  const Eigen::Vector2d offset(corrected.cx - given.cx, corrected.cy - given.cy);
  const Eigen::Vector2d shift =
      given.FocalLength() * Eigen::Vector2d(correction(S::kDepthX), correction(S::kDepthY));
  const Eigen::Vector2d b = (scale * roll * offset + shift).cwiseQuotient(given_focal);
  const Eigen::Vector2d parallax =
      given.FocalLength() *
      Eigen::Vector2d(correction(S::kDepthParallaxX), correction(S::kDepthParallaxY))
          .cwiseQuotient(given_focal);
  const double magnification = scale * corrected.fx / given.fx;

  DepthCamera result = depth_camera;
  PinholeCamera& depth = result.camera;
  const Eigen::Matrix2d given_rotation =
      result.depth_from_color.rotation().toRotationMatrix().topLeftCorner<2, 2>();
  const Eigen::Vector2d center_shift = given_rotation * b;
  depth.cx += depth.fx * center_shift.x();
  depth.cy += depth.fy * center_shift.y();
  depth.fx *= magnification;
  depth.fy *= magnification;
  const Eigen::Vector2d translation = given_rotation * parallax / magnification;
  const Eigen::Vector3d given_translation = result.depth_from_color.translation();
  const Eigen::AngleAxisd turn(correction(S::kDepthRoll), Eigen::Vector3d::UnitZ());
  result.depth_from_color =
      Rigid3(result.depth_from_color.rotation() * Eigen::Quaterniond(turn),
             Eigen::Vector3d(given_translation.x() / magnification + translation.x(),
                             given_translation.y() / magnification + translation.y(),
                             given_translation.z()));
  return result;
}

DepthCamera DepthCameraOf(const CameraIntrinsics& given, const CameraIntrinsics& corrected) {
  const LensDistortion& lens = corrected.distortion;
  const PinholeCamera& camera = lens.Recorded(corrected.camera);
  if (!corrected.registration) return RegisteredDepthCamera(camera, lens);
  const PinholeCamera& given_camera = given.distortion.Recorded(given.camera);
  return Corrected(RegisteredDepthCamera(given_camera, lens), given_camera, camera,
                   *corrected.registration);
}

}  // namespace msc_vo
