// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {

// Projects a point with a rolling shutter: pixel and inverse depth of the point that is at `in_cam`
// (metres, camera frame) at the time stamp. The exposure time of the point depends on its row and
// vice versa, hence the iteration.
inline PointFeature ProjectRolling(const PinholeCamera& camera, const Eigen::Vector3d& in_cam,
                                   const CameraVelocity& velocity, double readout_time) {
  PointFeature point;
  point.pixel = camera.Project(in_cam);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d then =
        velocity.Over(RowPhase(camera, point.pixel) * readout_time) * in_cam;
    point.pixel = camera.Project(then);
    point.inverse_depth = 1.0 / then.z();
  }
  return point;
}

// Frames of a rotating camera with a rolling shutter in a world of points; every point is the
// feature with the same index.
class RollingFrames {
 public:
  RollingFrames(double readout_time, double pixel_noise)
      : readout_time_(readout_time), pixel_noise_(pixel_noise) {
    for (int i = 0; i < 150; ++i) {
      points_.push_back({Uniform(-1.5, 1.5), Uniform(-1.0, 1.0), Uniform(2.0, 4.0)});
      descriptors_.emplace_back();
      for (uint8_t& bits : descriptors_.back()) bits = static_cast<uint8_t>(random_());
    }
  }

  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  // Rotates at about one radian per second in changing directions.
  static CameraVelocity Velocity(int index) {
    return {Eigen::Vector3d(std::cos(1.3 * index), std::sin(0.9 * index), 0.5 * std::sin(index)),
            Eigen::Vector3d(0.1, 0.0, 0.2 * std::cos(index))};
  }
  static Rigid3 CamFromWorld(int index) {
    return Rigid3(ExpSO3({0.02 * std::sin(index), 0.03 * std::cos(2.0 * index), 0.0}),
                  {0.05 * std::sin(2.0 * index), 0.0, 0.02 * index});
  }

  // The frame with its velocity, but not compensated for the rolling shutter.
  std::shared_ptr<Frame> MakeFrame(int index) {
    auto frame = std::make_shared<Frame>();
    frame->id = index;
    frame->timestamp = 0.3 * index;
    frame->velocity = Velocity(index);
    for (size_t i = 0; i < points_.size(); ++i) {
      PointFeature feature = ProjectRolling(frame->camera, CamFromWorld(index) * points_[i],
                                            Velocity(index), readout_time_);
      feature.descriptor = descriptors_[i];
      feature.pixel.x() += Normal();
      feature.pixel.y() += Normal();
      feature.inverse_depth_sigma = 1e-3;
      frame->points.push_back(feature);
    }
    frame->grid = FeatureGrid(frame->camera, frame->points);
    return frame;
  }

 private:
  double Uniform(double low, double high) {
    return low + (high - low) * (random_() / 4294967296.0);
  }
  double Normal() { return std::normal_distribution<double>(0.0, 1.0)(random_) * pixel_noise_; }

  double readout_time_;
  double pixel_noise_;
  std::mt19937 random_{1};
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

}  // namespace msc_vo
