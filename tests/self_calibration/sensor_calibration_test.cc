// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/sensor_calibration.h"

#include <algorithm>
#include <array>
#include <memory>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

const PinholeCamera kGiven{520.0, 520.0, 319.5, 239.5, 640, 480};

// A box-shaped room around the cameras: half of its size, metres.
const Eigen::Vector3d kHalf(2.0, 1.5, 3.0);

// Distance along `direction` from `origin` to the walls, which is the depth for z = 1 rays.
double DistanceToWall(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double distance = 1e9;
  for (int i = 0; i < 3; ++i) {
    if (direction(i) == 0.0) continue;
    const double wall = direction(i) > 0.0 ? kHalf(i) : -kHalf(i);
    distance = std::min(distance, (wall - origin(i)) / direction(i));
  }
  return distance;
}

// Images of a room by a camera whose calibration differs from kGiven by `truth`.
class SimulatedCamera {
 public:
  SimulatedCamera(const S::Vector& truth, unsigned seed)
      : camera_(kGiven, LensDistortion()), truth_(truth), engine_(seed) {
    for (int i = 0; i < 3000; ++i) {
      Eigen::Vector3d direction(Normal(), Normal(), Normal());
      points_.push_back(DistanceToWall(Eigen::Vector3d::Zero(), direction) * direction);
      Descriptor descriptor;
      for (uint8_t& byte : descriptor) byte = static_cast<uint8_t>(engine_() & 0xffU);
      descriptors_.push_back(descriptor);
    }
  }

  CalibrationView View(const Rigid3& cam_from_world) {
    const InverseDepthImage depth(DepthImage(cam_from_world), 0.2, 10.0);
    auto frame = std::make_shared<Frame>();
    frame->camera = kGiven;
    for (size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d x = cam_from_world * points_[i];
      if (x.z() < 0.3) continue;
      PointFeature point;
      point.pixel = camera_.Pixel<double>(Eigen::Vector2d(x.head<2>() / x.z()), truth_.data());
      point.pixel += 0.2 * Eigen::Vector2d(Normal(), Normal());
      if (!kGiven.IsInside(point.pixel, 4.0)) continue;
      point.sigma = 0.5;
      point.descriptor = descriptors_[i];
      point.inverse_depth = depth.Nearest(point.pixel);
      point.inverse_depth_sigma = 0.004;
      frame->points.push_back(point);
    }
    frame->grid = FeatureGrid(frame->camera, frame->points);
    return {frame, depth, cam_from_world};
  }

  CalibrationSequence Sequence(int count) {
    CalibrationSequence views;
    for (int i = 0; i < count; ++i) {
      const double t = 0.5 * i;
      const Eigen::Vector3d rotation(0.3 * std::sin(t), 0.45 * std::sin(0.7 * t),
                                     0.2 * std::cos(t));
      views.push_back(
          View({ExpSO3(rotation), 0.3 * Eigen::Vector3d(std::sin(0.9 * t), 0.5 * std::cos(0.6 * t),
                                                        std::sin(0.4 * t))}));
    }
    return views;
  }

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
    const double scale = std::exp(truth_(S::kDepthFocalLength));
    const Eigen::Vector2d center(kGiven.cx, kGiven.cy);
    const Eigen::Vector2d shift(truth_(S::kDepthX), truth_(S::kDepthY));
    const Eigen::Vector2d parallax =
        kGiven.fx * Eigen::Vector2d(truth_(S::kDepthParallaxX), truth_(S::kDepthParallaxY));
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
  S::Vector truth_;
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

SensorCalibrationResult Calibrate(const S::Vector& truth, unsigned seed, int num_views = 24) {
  return CalibrateSensor(kGiven, LensDistortion(),
                         {SimulatedCamera(truth, seed).Sequence(num_views)});
}

void ExpectNear(const CorrectionEstimate& estimate, const S::Vector& truth, S::Index index,
                double tolerance) {
  EXPECT_NEAR(estimate.correction(index), truth(index), tolerance) << index;
  EXPECT_LT(std::abs(estimate.correction(index) - truth(index)), 3.0 * estimate.sigma(index))
      << index;
}

TEST(SensorCalibration, KeepsARightCalibration) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SensorCalibrationResult result = Calibrate(S::Vector::Zero(), seed);
    EXPECT_GT(result.num_pairs, 50);
    EXPECT_FALSE(result.estimate.IsCorrected()) << seed;
  }
}

TEST(SensorCalibration, FindsTheFocalLength) {
  for (const double error : {0.03, -0.03}) {
    S::Vector truth = S::Vector::Zero();
    truth(S::kFocalLength) = error;
    const CorrectionEstimate estimate = Calibrate(truth, 4, 60).estimate;
    EXPECT_EQ(estimate.is_corrected, (WrongGroups{true, false, false, false}))
        << "log odds " << estimate.log_odds[0];
    ExpectNear(estimate, truth, S::kFocalLength, 0.005);
  }
}

TEST(SensorCalibration, FindsThePrincipalPoint) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kCenterX) = 8.0;
  truth(S::kCenterY) = -8.0;
  const CorrectionEstimate estimate = Calibrate(truth, 5).estimate;
  EXPECT_EQ(estimate.is_corrected, (WrongGroups{false, true, false, false}));
  ExpectNear(estimate, truth, S::kCenterX, 1.0);
  ExpectNear(estimate, truth, S::kCenterY, 1.0);
}

TEST(SensorCalibration, FindsTheDistortionOfTheLens) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kK1) = -0.1;
  const CorrectionEstimate estimate = Calibrate(truth, 6).estimate;
  EXPECT_EQ(estimate.is_corrected, (WrongGroups{false, false, true, false}));
  ExpectNear(estimate, truth, S::kK1, 0.01);
}

TEST(SensorCalibration, FindsADepthCameraBesideTheColourCamera) {
  S::Vector truth = S::Vector::Zero();
  truth(S::kDepthFocalLength) = 0.1;
  truth(S::kDepthParallaxX) = -0.03;
  const CorrectionEstimate estimate = Calibrate(truth, 7).estimate;
  EXPECT_EQ(estimate.is_corrected, (WrongGroups{false, false, false, true}));
  // The image is read up to 32 px beside the true place; `calibrate` registers it and repeats.
  ExpectNear(estimate, truth, S::kDepthFocalLength, 0.015);
  // Shift and parallax together: the parallax alone needs a large range of depths.
  const auto shift_at_two_metres = [](const S::Vector& correction) {
    return correction(S::kDepthX) + 0.5 * kGiven.fx * correction(S::kDepthParallaxX);
  };
  EXPECT_NEAR(shift_at_two_metres(estimate.correction), shift_at_two_metres(truth), 2.0);
}

TEST(SensorCalibration, LeavesAloneWhatAPathCannotTell) {
  // Two equal images: without motion, every calibration makes the scene rigid.
  S::Vector truth = S::Vector::Zero();
  truth(S::kFocalLength) = 0.03;
  SimulatedCamera camera(truth, 8);
  const CalibrationSequence still = {camera.View(Rigid3()), camera.View(Rigid3())};
  const CorrectionEstimate estimate = CalibrateSensor(kGiven, LensDistortion(), {still}).estimate;
  EXPECT_FALSE(estimate.IsCorrected());
  EXPECT_GT(estimate.sigma(S::kFocalLength), 0.9 * WrongCalibrationSigma()(S::kFocalLength));
}

}  // namespace
}  // namespace msc_vo
