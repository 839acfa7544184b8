// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"

#include <cmath>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {
namespace {

constexpr int kKeyframes = 12;
constexpr double kPixelSigma = 0.5;
constexpr double kInverseDepthSigma = 1e-3;

// Keyframes on a lateral trajectory that observe the same points and lines, which have their true
// values. Errors are one factor on the sigmas per landmark: the noise of its observations.
class LandmarkNoiseTest : public ::testing::Test {
 protected:
  const std::vector<Eigen::Vector3d> points_{{0, 0, 2}, {0.3, -0.2, 3}, {-0.4, 0.2, 2.5}};
  const std::vector<LineSegment3> lines_{{{-0.3, -0.5, 2}, {-0.3, 0.5, 2}},
                                         {{0.4, -0.5, 3}, {0.4, 0.5, 2.8}}};

  // `depth_offsets`: measured minus true depth of each line, metres.
  void Observe(const std::vector<double>& point_errors, const std::vector<double>& line_errors,
               const std::vector<double>& depth_offsets) {
    window_.camera = {525.0, 525.0, 319.5, 239.5, 640, 480};
    for (size_t i = 0; i < points_.size(); ++i) {
      window_.points.push_back({static_cast<int64_t>(i), points_[i]});
    }
    for (size_t i = 0; i < lines_.size(); ++i) {
      window_.lines.push_back({static_cast<int64_t>(i), lines_[i]});
    }
    for (int k = 0; k < kKeyframes; ++k) {
      const Rigid3 cam_from_world(Eigen::Quaterniond::Identity(), {0.05 * k, 0, 0});
      window_.keyframes.push_back({k, cam_from_world, k < 2});
      for (size_t i = 0; i < points_.size(); ++i) {
        ObservePoint(k, i, cam_from_world * points_[i], point_errors[i]);
      }
      for (size_t i = 0; i < lines_.size(); ++i) {
        ObserveLine(k, i, cam_from_world * lines_[i], line_errors[i], depth_offsets[i]);
      }
    }
  }

  // Estimates noise and offsets at the current state. `inliers`: whether observations are inliers.
  void Estimate(bool inliers = true) {
    const WindowIndex index = ValidateWindow(BundleAdjustmentOptions(), window_);
    int num_behind = 0;
    WindowInlierMask inlier_mask =
        InitialInlierMask(BundleAdjustmentOptions(), index, window_, &num_behind);
    if (!inliers) {
      inlier_mask.points.assign(inlier_mask.points.size(), {});
      inlier_mask.lines.assign(inlier_mask.lines.size(), {});
    }
    EstimateLandmarkNoise(options_, index, inlier_mask, WindowState(window_), &window_);
  }

  WindowData window_;
  LandmarkNoiseOptions options_{/*enabled=*/true};

 private:
  double Error(double factor, double sigma) {
    return factor * sigma * std::normal_distribution<double>()(random_);
  }
  void ObservePoint(int keyframe, size_t i, const Eigen::Vector3d& in_cam, double errors) {
    WindowData::PointObservation o;
    o.keyframe = keyframe;
    o.point = static_cast<int64_t>(i);
    o.pixel = window_.camera.Project(in_cam) +
              Eigen::Vector2d(Error(errors, kPixelSigma), Error(errors, kPixelSigma));
    o.sigma = kPixelSigma;
    o.inverse_depth = 1.0 / in_cam.z() + Error(errors, kInverseDepthSigma);
    o.inverse_depth_sigma = kInverseDepthSigma;
    window_.point_observations.push_back(o);
  }
  void ObserveLine(int keyframe, size_t i, const LineSegment3& in_cam, double errors,
                   double offset) {
    const auto end = [&](const Eigen::Vector3d& x) {
      return Eigen::Vector2d(window_.camera.Project(x) +
                             Eigen::Vector2d(Error(errors, kPixelSigma), 0.0));
    };
    WindowData::LineObservation o;
    o.keyframe = keyframe;
    o.line = static_cast<int64_t>(i);
    o.segment.start = end(in_cam.start);
    o.segment.end = end(in_cam.end);
    o.sigma = kPixelSigma;
    o.has_depth = true;
    o.depth.start = 1.0 / (in_cam.start.z() + offset);
    o.depth.end = 1.0 / (in_cam.end.z() + offset);
    o.depth.covariance.diagonal().setConstant(kInverseDepthSigma * kInverseDepthSigma);
    window_.line_observations.push_back(o);
  }

  std::mt19937 random_{1};
};

TEST_F(LandmarkNoiseTest, EstimatesTheNoiseOfEachLandmark) {
  Observe({1.0, 0.2, 1.7}, {1.0, 0.2}, {0.0, 0.0});
  Estimate();
  // With 33 degrees of freedom the standard deviation is 12 %; the bounds are twice that. The prior
  // draws estimates towards 1: sqrt((2 + 33 * 0.04) / 35) = 0.31, and 1.67.
  EXPECT_NEAR(window_.points[0].noise, 1.0, 0.24);
  EXPECT_NEAR(window_.points[1].noise, 0.31, 0.07);
  EXPECT_NEAR(window_.points[2].noise, 1.67, 0.4);
  // The depths of lines are exact here.
  EXPECT_NEAR(window_.lines[0].noise, 0.85, 0.25);
  EXPECT_LT(window_.lines[1].noise, 0.4);
  // The estimate does not depend on the previous noise factor.
  const double first = window_.points[1].noise;
  Estimate();
  EXPECT_DOUBLE_EQ(window_.points[1].noise, first);
}

// The end points of such a line project to one pixel, which does not tell its depth.
TEST_F(LandmarkNoiseTest, LeavesOutTheDepthOfALineAlongAViewingRay) {
  Observe({1.0, 1.0, 1.0}, {1.0, 1.0}, {0.0, 0.0});
  window_.lines[1].segment = {{0.25, -0.125, 2.0}, {0.5, -0.25, 4.0}};  // from the first keyframe
  Estimate();
  EXPECT_TRUE(std::isfinite(window_.lines[1].noise)) << window_.lines[1].noise;
  EXPECT_TRUE(std::isfinite(window_.lines[1].depth_offset)) << window_.lines[1].depth_offset;
}

TEST_F(LandmarkNoiseTest, KeepsValuesWithoutInliers) {
  Observe({0.0, 0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0});
  window_.points[1].noise = 0.7;
  window_.lines[1].depth_offset = 0.003;
  Estimate(false);
  EXPECT_EQ(window_.points[0].noise, 1.0);
  EXPECT_EQ(window_.points[1].noise, 0.7);
  EXPECT_EQ(window_.lines[0].noise, 1.0);
  EXPECT_EQ(window_.lines[1].depth_offset, 0.003);
}

TEST_F(LandmarkNoiseTest, EstimatesDepthOffsetsOfLines) {
  Observe({1.0, 1.0, 1.0}, {0.1, 0.1}, {0.008, -0.004});
  Estimate();
  // The prior draws the estimate towards zero.
  EXPECT_GT(window_.lines[0].depth_offset, 0.004);
  EXPECT_LT(window_.lines[0].depth_offset, 0.008);
  EXPECT_LT(window_.lines[1].depth_offset, -0.001);
  // With the offset compensated, the noise is smaller and the depths have more weight.
  const double noise = window_.lines[0].noise;
  Estimate();
  EXPECT_LT(window_.lines[0].noise, 0.7 * noise);
  Estimate();
  EXPECT_NEAR(window_.lines[0].depth_offset, 0.008, 0.0004);
}

TEST_F(LandmarkNoiseTest, ChangesNothingWhenDisabled) {
  Observe({0.2, 0.2, 0.2}, {0.2, 0.2}, {0.01, 0.01});
  options_.enabled = false;
  Estimate();
  EXPECT_EQ(window_.points[0].noise, 1.0);
  EXPECT_EQ(window_.lines[0].depth_offset, 0.0);
}

TEST_F(LandmarkNoiseTest, NoiseScalesSigmasAndOffsetShiftsDepth) {
  Observe({1.0, 1.0, 1.0}, {1.0, 1.0}, {0.01, 0.01});
  WindowData same = window_;
  for (WindowData::Point& point : window_.points) point.noise = 3.0;
  for (WindowData::Line& line : window_.lines) {
    line.noise = 0.5;
    line.depth_offset = 0.01;
  }
  for (WindowData::PointObservation& o : same.point_observations) {
    o.sigma *= 3.0;
    o.inverse_depth_sigma *= 3.0;
  }
  for (WindowData::LineObservation& o : same.line_observations) {
    o.sigma *= 0.5;
    o.depth.covariance *= 0.25;
    o.depth.start = 1.0 / (1.0 / o.depth.start - 0.01);
    o.depth.end = 1.0 / (1.0 / o.depth.end - 0.01);
  }
  const double cost = LocalBundleAdjustment(BundleAdjustmentOptions(), &window_).initial_cost;
  EXPECT_GT(cost, 1.0);
  EXPECT_NEAR(LocalBundleAdjustment(BundleAdjustmentOptions(), &same).initial_cost, cost,
              1e-9 * cost);
}

TEST_F(LandmarkNoiseTest, IsEstimatedByLocalBundleAdjustment) {
  Observe({0.2, 2.0, 0.2}, {0.2, 0.2}, {0.0, 0.0});
  WindowData without = window_;
  BundleAdjustmentOptions options;
  options.landmark_noise = options_;
  ASSERT_TRUE(LocalBundleAdjustment(options, &window_).usable);
  EXPECT_LT(window_.points[0].noise, 0.6);
  EXPECT_GT(window_.points[1].noise, 1.2);
  // The second solve uses the estimate, so the noisy point has less influence on the poses.
  ASSERT_TRUE(LocalBundleAdjustment(BundleAdjustmentOptions(), &without).usable);
  EXPECT_EQ(without.points[1].noise, 1.0);
  const auto error = [](const WindowData& window) {
    double sum = 0.0;
    for (const WindowData::Keyframe& k : window.keyframes) {
      sum += (k.cam_from_world.translation() - Eigen::Vector3d(0.05 * k.id, 0, 0)).squaredNorm();
    }
    return sum;
  };
  EXPECT_LT(error(window_), 0.5 * error(without));
}

}  // namespace
}  // namespace msc_vo
