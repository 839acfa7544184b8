// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/rolling_shutter.h"

namespace msc_vo {

namespace {

// What would come to less than half of its depth during a readout stays: no camera is so fast, but
// a wrong pose may say so.
constexpr double kMinDepthRatio = 0.5;

// Moves features of a frame from where they are to where it unrolls them.
class Shutter {
 public:
  Shutter(const Frame& rolled, const CameraVelocity& velocity, double readout_time)
      : camera_(rolled.camera),
        old_velocity_(rolled.velocity.value_or(CameraVelocity())),
        old_readout_time_(rolled.readout_time),
        velocity_(velocity),
        readout_time_(readout_time) {}

  // *inverse_depth (1/metres) stays zero where it is: far away only the rotation counts.
  Eigen::Vector2d Moved(const Eigen::Vector2d& pixel, double* inverse_depth) const {
    const double phase = RowPhase(camera_, pixel);
    const Rigid3 motion = velocity_.Over(phase * readout_time_).Inverse() *
                          old_velocity_.Over(phase * old_readout_time_);
    const Eigen::Vector3d ray =
        motion.rotation() * camera_.Ray(pixel) + *inverse_depth * motion.translation();
    if (ray.z() < kMinDepthRatio) return pixel;
    *inverse_depth /= ray.z();
    return camera_.Project(ray);
  }

 private:
  PinholeCamera camera_;
  CameraVelocity old_velocity_;
  double old_readout_time_;
  CameraVelocity velocity_;
  double readout_time_;
};

}  // namespace

double RowPhase(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return (pixel.y() + 0.5) / camera.height - 0.5;
}

Eigen::Vector3d RayChange(const Frame& frame, const Eigen::Vector2d& pixel, double inverse_depth) {
  if (!frame.velocity) return Eigen::Vector3d::Zero();
  return -RowPhase(frame.camera, pixel) * (frame.velocity->angular.cross(frame.camera.Ray(pixel)) +
                                           inverse_depth * frame.velocity->linear);
}

Frame CompensateRollingShutter(const Frame& rolled, const CameraVelocity& velocity,
                               double readout_time) {
  Frame frame = rolled;
  frame.velocity = velocity;
  frame.readout_time = readout_time;
  if (readout_time == 0.0 && rolled.readout_time == 0.0) return frame;
  const Shutter shutter(rolled, velocity, readout_time);
  for (PointFeature& point : frame.points) {
    point.pixel = shutter.Moved(point.pixel, &point.inverse_depth);
  }
  for (LineFeature& line : frame.lines) {
    LineDepth far;
    LineDepth& depth = line.depth ? *line.depth : far;
    line.segment.start = shutter.Moved(line.segment.start, &depth.start);
    line.segment.end = shutter.Moved(line.segment.end, &depth.end);
  }
  frame.grid = FeatureGrid(frame.camera, frame.points);
  return frame;
}

}  // namespace msc_vo
