// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"

#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {
namespace {

constexpr int kKeyframes = 12;
constexpr double kPixelSigma = 0.5;
constexpr double kInverseDepthSigma = 1e-3;

// Keyframes along a sideways walk that see the same points and lines, which are at their true
// places. `errors` are multiples of the sigmas, of one landmark each: its observations' errors.
class LandmarkNoise : public ::testing::Test {
 protected:
  const std::vector<Eigen::Vector3d> points_{{0, 0, 2}, {0.3, -0.2, 3}, {-0.4, 0.2, 2.5}};
  const std::vector<LineSegment3> lines_{{{-0.3, -0.5, 2}, {-0.3, 0.5, 2}},
                                         {{0.4, -0.5, 3}, {0.4, 0.5, 2.8}}};

  // depth_offset: metres, by which the depths of lines are measured too far.
  void See(const std::vector<double>& point_errors, const std::vector<double>& line_errors,
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
        SeePoint(k, i, cam_from_world * points_[i], point_errors[i]);
      }
      for (size_t i = 0; i < lines_.size(); ++i) {
        SeeLine(k, i, cam_from_world * lines_[i], line_errors[i], depth_offsets[i]);
      }
    }
  }

  // With the window as it is; `active`: whether observations take part.
  void Learn(bool active = true) {
    const WindowIndex index = ValidateWindow(BundleAdjustmentOptions(), window_);
    int num_behind = 0;
    WindowInlierMask inlier_mask =
        AllInFront(BundleAdjustmentOptions(), index, window_, &num_behind);
    if (!active) {
      inlier_mask.points.assign(inlier_mask.points.size(), {});
      inlier_mask.lines.assign(inlier_mask.lines.size(), {});
    }
    LearnLandmarkNoise(options_, index, inlier_mask, WindowState(window_), &window_);
  }

  WindowData window_;
  LandmarkNoiseOptions options_{/*enabled=*/true};

 private:
  double Error(double factor, double sigma) {
    return factor * sigma * std::normal_distribution<double>()(random_);
  }
  void SeePoint(int keyframe, size_t i, const Eigen::Vector3d& in_cam, double errors) {
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
  void SeeLine(int keyframe, size_t i, const LineSegment3& in_cam, double errors, double offset) {
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

TEST_F(LandmarkNoise, IsThatOfTheLandmarksOwnErrors) {
  See({1.0, 0.2, 1.7}, {1.0, 0.2}, {0.0, 0.0});
  Learn();
  // With 33 degrees of freedom each is known to 12 %; bounds are twice that. Toward 1 they are
  // drawn by the prior: sqrt((2 + 33 * 0.04) / 35) = 0.31, and 1.67.
  EXPECT_NEAR(window_.points[0].noise, 1.0, 0.24);
  EXPECT_NEAR(window_.points[1].noise, 0.31, 0.07);
  EXPECT_NEAR(window_.points[2].noise, 1.67, 0.4);
  // Lines have no errors of depth here.
  EXPECT_NEAR(window_.lines[0].noise, 0.85, 0.25);
  EXPECT_LT(window_.lines[1].noise, 0.4);
  // What was learnt does not change what is learnt.
  const double first = window_.points[1].noise;
  Learn();
  EXPECT_DOUBLE_EQ(window_.points[1].noise, first);
}

TEST_F(LandmarkNoise, StaysWithoutEvidence) {
  See({0.0, 0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0});
  window_.points[1].noise = 0.7;
  window_.lines[1].depth_offset = 0.003;
  Learn(false);
  EXPECT_EQ(window_.points[0].noise, 1.0);
  EXPECT_EQ(window_.points[1].noise, 0.7);
  EXPECT_EQ(window_.lines[0].noise, 1.0);
  EXPECT_EQ(window_.lines[1].depth_offset, 0.003);
}

TEST_F(LandmarkNoise, DepthOffsetsOfLinesAreFound) {
  See({1.0, 1.0, 1.0}, {0.1, 0.1}, {0.008, -0.004});
  Learn();
  // The prior holds back a part of what the depths say.
  EXPECT_GT(window_.lines[0].depth_offset, 0.004);
  EXPECT_LT(window_.lines[0].depth_offset, 0.008);
  EXPECT_LT(window_.lines[1].depth_offset, -0.001);
  // With its offset known a line has little noise; its depths then count for more.
  const double noise = window_.lines[0].noise;
  Learn();
  EXPECT_LT(window_.lines[0].noise, 0.7 * noise);
  Learn();
  EXPECT_NEAR(window_.lines[0].depth_offset, 0.008, 0.0004);
}

TEST_F(LandmarkNoise, IsLeftAloneWhenSwitchedOff) {
  See({0.2, 0.2, 0.2}, {0.2, 0.2}, {0.01, 0.01});
  options_.enabled = false;
  Learn();
  EXPECT_EQ(window_.points[0].noise, 1.0);
  EXPECT_EQ(window_.lines[0].depth_offset, 0.0);
}

TEST_F(LandmarkNoise, ScalesSigmasAndOffsetsShiftDepths) {
  See({1.0, 1.0, 1.0}, {1.0, 1.0}, {0.01, 0.01});
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

TEST_F(LandmarkNoise, IsLearntByTheSolver) {
  See({0.2, 2.0, 0.2}, {0.2, 0.2}, {0.0, 0.0});
  WindowData without = window_;
  BundleAdjustmentOptions options;
  options.landmark_noise = options_;
  ASSERT_TRUE(LocalBundleAdjustment(options, &window_).usable);
  EXPECT_LT(window_.points[0].noise, 0.6);
  EXPECT_GT(window_.points[1].noise, 1.2);
  // Its second solve knows already: the point that is seen badly no longer pulls at the cameras.
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

TEST(LandmarkNoiseOptions, BadOnesAreRefused) {
  std::string error;
  LandmarkNoiseOptions options;
  EXPECT_TRUE(options.IsValid(&error));
  options.prior = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("prior"));
  options = {};
  options.depth_offset_sigma = -1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("depth_offset_sigma"));
}

}  // namespace
}  // namespace msc_vo
