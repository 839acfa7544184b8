// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/rolling_shutter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace msc_vo {

namespace {

// Features whose depth would shrink below this fraction during a readout are not moved: no camera
// is so fast, but the velocity of a wrong pose may be.
constexpr double kMinDepthRatio = 0.5;

// Moves the features of a frame from its present compensation to another one.
class RowMotion {
 public:
  RowMotion(const Frame& frame, const CameraVelocity& velocity, double readout_time)
      : frame_(frame),
        camera_(frame.camera),
        old_velocity_(frame.velocity.value_or(CameraVelocity())),
        old_readout_time_(frame.readout_time),
        velocity_(velocity),
        readout_time_(readout_time) {}

  // *inverse_depth (1/metres); zero stays zero, because only the rotation moves points at infinity.
  Eigen::Vector2d Moved(const Eigen::Vector2d& pixel, double* inverse_depth) const {
    const double phase = RowPhase(frame_, pixel);
    const Rigid3 motion = velocity_.Over(phase * readout_time_).Inverse() *
                          old_velocity_.Over(phase * old_readout_time_);
    const Eigen::Vector3d ray =
        motion.rotation() * camera_.Ray(pixel) + *inverse_depth * motion.translation();
    if (ray.z() < kMinDepthRatio) return pixel;
    *inverse_depth /= ray.z();
    return camera_.Project(ray);
  }

 private:
  const Frame& frame_;
  PinholeCamera camera_;
  CameraVelocity old_velocity_;
  double old_readout_time_;
  CameraVelocity velocity_;
  double readout_time_;
};

// Fits the plane to where four of its points are moved, whose rays have its mean and its spread.
void MovePlane(const PinholeCamera& camera, const RowMotion& motion, PlaneFeature* plane) {
  const Eigen::Matrix3d& moments = plane->mean_square_ray;
  const Eigen::Vector3d mean = moments.col(2);
  Eigen::Matrix3d square_rays = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rays_times_depth = Eigen::Vector3d::Zero();
  const Eigen::Vector3d spread =
      (moments.diagonal() - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();  // its z is 0
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector3d ray = mean + spread.cwiseProduct(Eigen::Vector3d(x, y, 0.0));
      double inverse_depth = plane->inverse_depth.dot(ray);
      const Eigen::Vector3d moved = camera.Ray(motion.Moved(camera.Project(ray), &inverse_depth));
      square_rays += moved * moved.transpose();
      rays_times_depth += inverse_depth * moved;
    }
  }
  const Eigen::Vector3d fitted = square_rays.inverse() * rays_times_depth;
  if (fitted.allFinite()) plane->inverse_depth = fitted;
}

}  // namespace

double RowPhase(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return (pixel.y() + 0.5) / camera.height - 0.5;
}

double RowPhase(const Frame& frame, const Eigen::Vector2d& pixel) {
  if (!frame.lens) return RowPhase(frame.camera, pixel);
  return RowPhase(frame.lens->Recorded(frame.camera), frame.lens->Distort(frame.camera, pixel));
}

Eigen::Vector3d RayChange(const Frame& frame, const Eigen::Vector2d& pixel, double inverse_depth) {
  if (!frame.velocity) return Eigen::Vector3d::Zero();
  return -RowPhase(frame, pixel) * (frame.velocity->angular.cross(frame.camera.Ray(pixel)) +
                                    inverse_depth * frame.velocity->linear);
}

Frame CompensateRollingShutter(const Frame& frame, const CameraVelocity& velocity,
                               double readout_time) {
  Frame compensated = frame;
  compensated.velocity = velocity;
  compensated.readout_time = readout_time;
  if (readout_time == 0.0 && frame.readout_time == 0.0) return compensated;
  const RowMotion motion(frame, velocity, readout_time);
  const auto move = [&](const Eigen::Vector2d& pixel, double* inverse_depth) {
    return motion.Moved(pixel, inverse_depth);
  };
  ForEachFeatures(compensated, [&](auto& features) {
    for (auto& feature : features) feature.MovePixels(move);
  });
  for (PlaneFeature& plane : compensated.planes) MovePlane(frame.camera, motion, &plane);
  compensated.grid = FeatureGrid(compensated.camera, compensated.points);
  return compensated;
}

void SetDepthVelocity(const CameraVelocity& velocity, Frame* frame) {
  DepthMotion& present = frame->depth_motion;
  if (present.delay == 0.0) return;
  const Rigid3 motion =
      velocity.Over(present.delay).Inverse() * present.velocity.Over(present.delay);
  for (PlaneFeature& plane : frame->planes) plane.Move(motion);
  present.velocity = velocity;
}

}  // namespace msc_vo
