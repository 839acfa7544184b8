// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/map.h"
#include "msc_vo/self_calibration/sensor_calibration.h"
#include "msc_vo/sensor/depth_camera_correction.h"
#include "msc_vo/sensor/depth_registration.h"

namespace msc_vo {

inline const PinholeCamera kGiven{520.0, 520.0, 319.5, 239.5, 640, 480};
// Focal lengths.
constexpr double kPixel = 1.0 / 520.0;

// A box-shaped room around the cameras: half of its size, metres.
inline const Eigen::Vector3d kHalf(2.0, 1.5, 3.0);

// Distance along `direction` from `origin` to the walls, which is the depth for z = 1 rays.
inline double DistanceToWall(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double distance = 1e9;
  for (int i = 0; i < 3; ++i) {
    if (direction(i) == 0.0) continue;
    const double wall = direction(i) > 0.0 ? kHalf(i) : -kHalf(i);
    distance = std::min(distance, (wall - origin(i)) / direction(i));
  }
  return distance;
}

// Landmarks of simulated frames by their descriptors.
using LandmarksByDescriptor = std::map<Descriptor, LandmarkId>;

// Adds the observations of a keyframe to a map. A new landmark is where this frame measures it.
inline void Observe(KeyframeId keyframe, LandmarksByDescriptor* landmarks, Map* map) {
  const std::shared_ptr<const Frame> frame = map->FindKeyframe(keyframe)->frame;
  const Rigid3 world_from_cam = map->CamFromWorld(keyframe).Inverse();
  for (int i = 0; i < static_cast<int>(frame->points.size()); ++i) {
    const auto known = landmarks->find(frame->points[i].descriptor);
    if (known != landmarks->end()) {
      map->Observe<PointLandmark>(known->second, keyframe, i);
    } else {
      (*landmarks)[frame->points[i].descriptor] =
          map->Add<PointLandmark>(keyframe, i, world_from_cam * frame->PointInCamera(i));
    }
  }
}

// Images of a room by a camera whose calibration differs from kGiven by `truth`.
class SimulatedCamera {
 public:
  SimulatedCamera(const SensorCorrection::Vector& truth, unsigned seed)
      : camera_(kGiven, LensDistortion()), truth_(truth), engine_(seed) {
    for (int i = 0; i < 3000; ++i) {
      Eigen::Vector3d direction{Normal(), Normal(), Normal()};
      points_.push_back(DistanceToWall(Eigen::Vector3d::Zero(), direction) * direction);
      Descriptor descriptor;
      for (uint8_t& byte : descriptor) byte = static_cast<uint8_t>(engine_() & 0xffU);
      descriptors_.push_back(descriptor);
    }
  }

  // Features and depth image, metres.
  std::pair<std::shared_ptr<const Frame>, cv::Mat> Record(const Rigid3& cam_from_world) {
    const cv::Mat metres = DepthImage(cam_from_world);
    const InverseDepthImage depth(metres, 0.2, 10.0);
    auto frame = std::make_shared<Frame>();
    frame->camera = kGiven;
    frame->intrinsics = given_;
    for (size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d x = cam_from_world * points_[i];
      // Beyond 45 degrees a lens that compresses the border would fold over.
      if (x.z() < 0.3 || x.head<2>().norm() > x.z()) continue;
      PointFeature point;
      point.pixel = camera_.Pixel<double>(Eigen::Vector2d(x.head<2>() / x.z()), truth_.data());
      point.pixel += 0.2 * Eigen::Vector2d{Normal(), Normal()};
      if (!kGiven.IsInside(point.pixel, 4.0)) continue;
      point.sigma = 0.5;
      point.descriptor = descriptors_[i];
      point.inverse_depth = depth.Nearest(point.pixel);
      point.inverse_depth_sigma = 0.004;
      frame->points.push_back(point);
    }
    frame->grid = FeatureGrid(frame->camera, frame->points);
    return {frame, metres};
  }

  CalibrationView View(const Rigid3& cam_from_world) {
    const auto [frame, depth] = Record(cam_from_world);
    return {frame, InverseDepthImage(depth, 0.2, 10.0), cam_from_world};
  }

  // Pose of image `i` of a hand-held camera.
  static Rigid3 PoseOf(int i) {
    const double t = 0.5 * i;
    const Eigen::Vector3d rotation(0.3 * std::sin(t), 0.45 * std::sin(0.7 * t), 0.2 * std::cos(t));
    return {ExpSO3(rotation),
            0.3 * Eigen::Vector3d(std::sin(0.9 * t), 0.5 * std::cos(0.6 * t), std::sin(0.4 * t))};
  }

  CalibrationSequence Sequence(int count) {
    CalibrationSequence views;
    for (int i = 0; i < count; ++i) views.push_back(View(PoseOf(i)));
    return views;
  }

  // The calibration that features are undistorted with.
  const std::shared_ptr<const CameraIntrinsics>& given() const { return given_; }

 private:
  double Normal() { return normal_(engine_); }

  // Inverse depth of the colour pixel.
  double InverseDepthAt(const Rigid3& world_from_cam, const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d x = camera_.Ray<double>(pixel, truth_.data());
    return 1.0 / DistanceToWall(world_from_cam.translation(),
                                world_from_cam.rotation() * Eigen::Vector3d(x.x(), x.y(), 1.0));
  }

  // The colour pixel that a depth pixel belongs to depends on its depth.
  cv::Mat DepthImage(const Rigid3& cam_from_world) const {
    const Rigid3 world_from_cam = cam_from_world.Inverse();
    const double scale = std::exp(truth_(SensorCorrection::kDepthFocalLength));
    const Eigen::Vector2d center(kGiven.cx, kGiven.cy);
    const Eigen::Vector2d shift = kGiven.fx * Eigen::Vector2d(truth_(SensorCorrection::kDepthX),
                                                              truth_(SensorCorrection::kDepthY));
    const Eigen::Vector2d parallax =
        kGiven.fx * Eigen::Vector2d(truth_(SensorCorrection::kDepthParallaxX),
                                    truth_(SensorCorrection::kDepthParallaxY));
    cv::Mat depth(kGiven.height, kGiven.width, CV_32FC1);
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 0; u < depth.cols; ++u) {
        double w = 0.5;
        const int steps = parallax.isZero() ? 1 : 5;
        for (int i = 0; i < steps; ++i) {
          const Eigen::Vector2d pixel =
              (Eigen::Vector2d(u, v) - center - shift - w * parallax) / scale + center;
          w = InverseDepthAt(world_from_cam, pixel);
        }
        depth.at<float>(v, u) = static_cast<float>(1.0 / w);
      }
    }
    return depth;
  }

  CorrectedCamera camera_;
  SensorCorrection::Vector truth_;
  std::shared_ptr<const CameraIntrinsics> given_ =
      std::make_shared<CameraIntrinsics>(CameraIntrinsics{kGiven, {}});
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

// Returns the frame of a SimulatedCamera with other intrinsics and the depths that its features
// have in the depth image registered as these say.
inline std::shared_ptr<const Frame> MeasureSimulatedDepth(
    const Frame& frame, const cv::Mat& metres,
    const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  const CameraIntrinsics given{kGiven, {}};
  auto measured =
      std::make_shared<Frame>(*ChangeIntrinsics(std::make_shared<Frame>(frame), intrinsics));
  cv::Mat registered = metres;
  if (intrinsics->registration) {
    registered = DepthRegistration(DepthCameraOf(given, *intrinsics), intrinsics->camera,
                                   intrinsics->distortion)
                     .Register(metres);
  }
  const InverseDepthImage depth(registered, 0.2, 10.0);
  for (PointFeature& point : measured->points) {
    point.inverse_depth = depth.Nearest(MovePixel(*intrinsics, given, point.pixel));
    point.inverse_depth_sigma = point.HasDepth() ? 0.004 : 0.0;
  }
  return measured;
}

}  // namespace msc_vo
