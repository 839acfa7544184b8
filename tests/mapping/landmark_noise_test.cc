// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_noise.h"

#include <memory>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "msc_vo/map/window.h"

namespace msc_vo {
namespace {

constexpr int kKeyframes = 12;
constexpr double kPixelSigma = 0.5;
constexpr double kInverseDepthSigma = 1e-3;

// Keyframes along a sideways walk that see the same points and lines at their true places.
// `errors` are multiples of the sigmas, of one landmark each: the features' random errors.
class LandmarkNoise : public ::testing::Test {
 protected:
  const std::vector<Eigen::Vector3d> points_{{0, 0, 2}, {0.3, -0.2, 3}, {-0.4, 0.2, 2.5}};
  const std::vector<LineSegment3> lines_{{{-0.3, -0.5, 2}, {-0.3, 0.5, 2}},
                                         {{0.4, -0.5, 3}, {0.4, 0.5, 2.8}}};

  // depth_offset: metres, by which the depths of lines are measured too far.
  void See(const std::vector<double>& point_errors, const std::vector<double>& line_errors,
           const std::vector<double>& depth_offsets) {
    for (int k = 0; k < kKeyframes; ++k) {
      const Rigid3 cam_from_world(Eigen::Quaterniond::Identity(), {0.05 * k, 0, 0});
      auto frame = std::make_shared<Frame>();
      for (size_t i = 0; i < points_.size(); ++i) {
        frame->points.push_back(Point(*frame, cam_from_world * points_[i], point_errors[i]));
      }
      for (size_t i = 0; i < lines_.size(); ++i) {
        frame->lines.push_back(
            Line(*frame, cam_from_world * lines_[i], line_errors[i], depth_offsets[i]));
      }
      Observe(map_.AddKeyframe(frame, cam_from_world));
    }
    window_ = SelectWindow(WindowSelectionOptions(), map_, kKeyframes - 1);
    ASSERT_EQ(window_.points.size(), points_.size());
    ASSERT_EQ(window_.lines.size(), lines_.size());
  }

  void Learn() { LearnLandmarkNoise(options_, WindowOptions(), WindowResiduals(window_), &map_); }
  double PointNoise(int i) const { return map_.FindPoint(point_ids_[i])->noise; }
  const LineLandmark& LineOf(int i) const { return *map_.FindLine(line_ids_[i]); }

  Map map_;
  WindowData window_;
  LandmarkNoiseOptions options_;

 private:
  double Error(double factor, double sigma) {
    return factor * sigma * std::normal_distribution<double>()(random_);
  }
  PointFeature Point(const Frame& frame, const Eigen::Vector3d& in_cam, double errors) {
    PointFeature feature;
    feature.pixel = frame.camera.Project(in_cam) +
                    Eigen::Vector2d(Error(errors, kPixelSigma), Error(errors, kPixelSigma));
    feature.sigma = kPixelSigma;
    feature.inverse_depth = 1.0 / in_cam.z() + Error(errors, kInverseDepthSigma);
    feature.inverse_depth_sigma = kInverseDepthSigma;
    return feature;
  }
  LineFeature Line(const Frame& frame, const LineSegment3& in_cam, double errors, double offset) {
    LineFeature feature;
    const auto end = [&](const Eigen::Vector3d& x) {
      return Eigen::Vector2d(frame.camera.Project(x) +
                             Eigen::Vector2d(Error(errors, kPixelSigma), 0.0));
    };
    feature.segment.start = end(in_cam.start);
    feature.segment.end = end(in_cam.end);
    feature.sigma = kPixelSigma;
    feature.depth = LineDepth();
    feature.depth->start = 1.0 / (in_cam.start.z() + offset);
    feature.depth->end = 1.0 / (in_cam.end.z() + offset);
    feature.depth->covariance.diagonal().setConstant(kInverseDepthSigma * kInverseDepthSigma);
    return feature;
  }
  void Observe(KeyframeId keyframe) {
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      if (keyframe == 0) point_ids_.push_back(map_.AddPoint(keyframe, i, points_[i]));
      map_.ObservePoint(point_ids_[i], keyframe, i);
    }
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i) {
      if (keyframe == 0) line_ids_.push_back(map_.AddLine(keyframe, i, lines_[i]));
      map_.ObserveLine(line_ids_[i], keyframe, i);
    }
  }

  std::mt19937 random_{1};
  std::vector<LandmarkId> point_ids_, line_ids_;
};

TEST_F(LandmarkNoise, IsThatOfTheLandmarksOwnErrors) {
  See({1.0, 0.2, 1.7}, {1.0, 0.2}, {0.0, 0.0});
  Learn();
  // With 33 degrees of freedom each is known to 12 %; bounds are twice that. Toward 1 they are
  // drawn by the prior: sqrt((2 + 33 * 0.04) / 35) = 0.31, and 1.67.
  EXPECT_NEAR(PointNoise(0), 1.0, 0.24);
  EXPECT_NEAR(PointNoise(1), 0.31, 0.07);
  EXPECT_NEAR(PointNoise(2), 1.67, 0.4);
  // Lines have no errors of depth here.
  EXPECT_NEAR(LineOf(0).noise, 0.85, 0.25);
  EXPECT_LT(LineOf(1).noise, 0.4);
}

TEST_F(LandmarkNoise, IsOneWithoutEvidence) {
  See({0.0, 0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0});
  for (auto& o : window_.point_observations) o.rejected = true;
  for (auto& o : window_.line_observations) o.rejected = true;
  Learn();
  EXPECT_EQ(PointNoise(0), 1.0);
  EXPECT_EQ(LineOf(0).noise, 1.0);
  EXPECT_EQ(LineOf(0).depth_offset, 0.0);
}

TEST_F(LandmarkNoise, StaysWhenTheSigmasHaveIt) {
  See({1.0, 0.2, 1.7}, {1.0, 0.2}, {0.0, 0.0});
  Learn();
  const double first = PointNoise(1);
  ApplyLandmarkNoise(map_, &window_);
  EXPECT_DOUBLE_EQ(window_.point_observations.front().sigma, PointNoise(0) * kPixelSigma);
  EXPECT_DOUBLE_EQ(window_.point_observations.front().inverse_depth_sigma,
                   PointNoise(0) * kInverseDepthSigma);
  Learn();
  EXPECT_NEAR(PointNoise(1), first, 1e-9);
}

TEST_F(LandmarkNoise, DepthOffsetsOfLinesAreFoundAndTakenOff) {
  See({1.0, 1.0, 1.0}, {0.1, 0.1}, {0.008, -0.004});
  // Each time the prior holds back a part of what the depths say.
  Learn();
  const double once = LineOf(0).depth_offset;
  EXPECT_GT(once, 0.004);
  EXPECT_LT(once, 0.008);
  EXPECT_LT(LineOf(1).depth_offset, -0.001);
  const double before = window_.line_observations.front().depth.At(0.5);
  ApplyLandmarkNoise(map_, &window_);
  EXPECT_NEAR(1.0 / before - 1.0 / window_.line_observations.front().depth.At(0.5), once, 1e-12);
  // The same again: what was taken off is not forgotten.
  Learn();
  EXPECT_NEAR(LineOf(0).depth_offset, once, 0.002);
}

TEST_F(LandmarkNoise, IsLeftAloneWhenSwitchedOff) {
  See({0.2, 0.2, 0.2}, {0.2, 0.2}, {0.01, 0.01});
  options_.enabled = false;
  Learn();
  EXPECT_EQ(PointNoise(0), 1.0);
  EXPECT_EQ(LineOf(0).depth_offset, 0.0);
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
