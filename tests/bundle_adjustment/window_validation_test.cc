// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_validation.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "tests/support/message_matchers.h"
#include "tests/support/test_window.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class WindowValidationTest : public ::testing::Test {
 protected:
  WindowValidationTest() {
    TestWindowOptions scene;
    scene.num_points = 20;
    scene.num_lines = 5;
    data_ = MakeTestWindow(scene).data;
  }
  // Message of the exception for the current data.
  std::string Message() const {
    try {
      ValidateWindow(options_, data_);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no exception";
  }

  const double nan_ = std::numeric_limits<double>::quiet_NaN();
  const double infinity_ = std::numeric_limits<double>::infinity();
  BundleAdjustmentOptions options_;
  WindowData data_;
};

TEST_F(WindowValidationTest, ResolvesIds) {
  const WindowIndex index = ValidateWindow(options_, data_);
  ASSERT_EQ(index.points.size(), data_.point_observations.size());
  ASSERT_EQ(index.lines.size(), data_.line_observations.size());
  for (size_t i = 0; i < index.points.size(); ++i) {
    EXPECT_EQ(data_.keyframes[index.points[i].keyframe].id, data_.point_observations[i].keyframe);
    EXPECT_EQ(data_.points[index.points[i].landmark].id, data_.point_observations[i].point);
  }
  for (size_t i = 0; i < index.lines.size(); ++i) {
    EXPECT_EQ(data_.keyframes[index.lines[i].keyframe].id, data_.line_observations[i].keyframe);
    EXPECT_EQ(data_.lines[index.lines[i].landmark].id, data_.line_observations[i].line);
  }
}

TEST_F(WindowValidationTest, RejectsUnknownIds) {
  data_.point_observations[3].keyframe = 9999;
  EXPECT_THAT(Message(), Names("keyframe 9999", "observed", "window"));
  data_.point_observations[3].keyframe = data_.keyframes[0].id;
  data_.point_observations[3].point = -5;
  EXPECT_THAT(Message(), Names("point -5", "observed", "window"));
  data_.point_observations[3].point = data_.points[0].id;
  data_.line_observations[0].line = 77777;
  EXPECT_THAT(Message(), Names("line 77777", "observed", "window"));
}

TEST_F(WindowValidationTest, RejectsRepeatedIds) {
  data_.keyframes[4].id = data_.keyframes[2].id;
  EXPECT_THAT(Message(), Names("keyframe 106", "twice"));
  data_.keyframes[4].id = 555;
  data_.points[7].id = data_.points[2].id;
  EXPECT_THAT(Message(), Names("point 1014", "twice"));
  data_.points[7].id = 555;  // keyframes and points have separate ids
  data_.lines[4].id = data_.lines[3].id;
  EXPECT_THAT(Message(), Names("line 56", "twice"));
}

TEST_F(WindowValidationTest, RejectsAnEmptyWindow) {
  data_ = WindowData();
  EXPECT_THAT(Message(), Names("window", "empty"));
}

TEST_F(WindowValidationTest, RejectsAFreeGauge) {
  for (auto& k : data_.keyframes) k.fixed = false;
  EXPECT_THAT(Message(), Names("fixed", "prior"));
  data_.pose_priors.push_back({data_.keyframes[2].id, data_.keyframes[2].cam_from_world});
  EXPECT_EQ(Message(), "no exception");
}

TEST_F(WindowValidationTest, RejectsInvalidPriors) {
  const WindowData::PosePrior good{data_.keyframes[2].id, data_.keyframes[2].cam_from_world};
  data_.pose_priors = {good};
  EXPECT_EQ(Message(), "no exception");
  WindowData::PosePrior& prior = data_.pose_priors[0];
  prior.keyframe = 9999;
  EXPECT_THAT(Message(), Names("keyframe 9999", "prior", "window"));
  prior = good;
  prior.cam_from_world.params[3] += 1.0;
  EXPECT_THAT(Message(), Names("prior", "keyframe 106", "quaternion"));
  prior = good;
  prior.covariance(2, 4) = 0.1;
  EXPECT_THAT(Message(), Names("prior", "keyframe 106", "covariance"));
  prior = good;
  prior.covariance(2, 2) = 0.0;
  EXPECT_THAT(Message(), Names("prior", "keyframe 106", "covariance"));
  prior = good;
  prior.covariance(5, 5) = nan_;
  EXPECT_THAT(Message(), Names("prior", "keyframe 106", "covariance"));
}

TEST_F(WindowValidationTest, RejectsInvalidKeyframesAndLandmarks) {
  const WindowData good = data_;
  data_.keyframes[1].cam_from_world.params[5] = nan_;
  EXPECT_THAT(Message(), Names("keyframe 103", "pose", "finite"));
  data_ = good;
  data_.keyframes[1].cam_from_world.params.head<4>() *= 2.0;
  EXPECT_THAT(Message(), Names("keyframe 103", "quaternion"));
  data_ = good;
  data_.points[2].position.y() = nan_;
  EXPECT_THAT(Message(), Names("point 1014", "position", "finite"));
  data_ = good;
  data_.lines[3].segment.end.y() = nan_;
  EXPECT_THAT(Message(), Names("line 56", "segment", "finite"));
  data_ = good;
  data_.lines[3].segment.end = data_.lines[3].segment.start;
  EXPECT_THAT(Message(), Names("line 56", "segment", "zero"));
  for (const double noise : {0.0, -1.0, nan_, infinity_}) {
    data_ = good;
    data_.points[2].noise = noise;
    EXPECT_THAT(Message(), Names("point 1014", "noise"));
    data_ = good;
    data_.lines[3].noise = noise;
    EXPECT_THAT(Message(), Names("line 56", "noise"));
  }
  data_ = good;
  data_.lines[3].depth_offset = nan_;
  EXPECT_THAT(Message(), Names("line 56", "depth_offset"));
}

TEST_F(WindowValidationTest, RejectsInvalidPointObservations) {
  const WindowData good = data_;
  WindowData::PointObservation& o = data_.point_observations[0];
  const std::string point = "point " + std::to_string(o.point);
  const std::string keyframe = "keyframe " + std::to_string(o.keyframe);
  o.pixel.x() = nan_;
  EXPECT_THAT(Message(), Names("observation", point, keyframe, "pixel"));
  data_ = good;
  data_.point_observations[0].sigma = 0.0;
  EXPECT_THAT(Message(), Names("observation", point, keyframe, "sigma"));
  data_ = good;
  data_.point_observations[0].inverse_depth_sigma = -1.0;
  EXPECT_THAT(Message(), Names("observation", point, keyframe, "inverse_depth_sigma"));
  data_ = good;
  data_.point_observations[0].inverse_depth = nan_;
  EXPECT_THAT(Message(), Names("observation", point, keyframe, "inverse_depth", "1e9"));
}

TEST_F(WindowValidationTest, RejectsInvalidLineObservations) {
  const WindowData good = data_;
  WindowData::LineObservation& o = data_.line_observations[0];
  const std::string line = "line " + std::to_string(o.line);
  const std::string keyframe = "keyframe " + std::to_string(o.keyframe);
  o.segment.end = o.segment.start;
  EXPECT_THAT(Message(), Names("observation", line, keyframe, "segment", "zero"));
  data_ = good;
  data_.line_observations[0].sigma = nan_;
  EXPECT_THAT(Message(), Names("observation", line, keyframe, "sigma"));
  data_ = good;
  data_.line_observations[0].depth.start = nan_;
  EXPECT_THAT(Message(), Names("observation", line, keyframe, "depth", "finite"));
  data_ = good;
  data_.line_observations[0].depth.covariance << 1.0, 2.0, 2.0, 1.0;
  EXPECT_THAT(Message(), Names("observation", line, keyframe, "depth", "covariance"));
  data_.line_observations[0].depth.covariance << -1.0, 0.0, 0.0, -1.0;
  EXPECT_THAT(Message(), Names("observation", line, keyframe, "depth", "covariance"));
  data_.line_observations[0].depth.covariance << 1.0, 0.3, 0.1, 1.0;  // not symmetric
  EXPECT_THAT(Message(), Names("observation", line, keyframe, "depth", "covariance"));
  data_.line_observations[0].has_depth = false;  // then it is not used
  EXPECT_EQ(Message(), "no exception");
}

TEST_F(WindowValidationTest, RejectsInfiniteAndHugeNumbers) {
  const WindowData good = data_;
  const auto expect = [&](const NamesMatcher& names) {
    EXPECT_THAT(Message(), names);
    data_ = good;
  };
  for (const double huge : {infinity_, -infinity_, 1e200, -1e10}) {
    SCOPED_TRACE(huge);
    data_.keyframes[1].cam_from_world.translation().z() = huge;
    expect(Names("keyframe 103", "pose", "1e9"));
    data_.points[2].position.x() = huge;
    expect(Names("point 1014", "position", "1e9"));
    data_.lines[3].segment.start.z() = huge;
    expect(Names("line 56", "segment", "1e9"));
    data_.point_observations[5].pixel.y() = huge;
    expect(Names("observation", "point", "pixel", "1e9"));
    data_.line_observations[5].segment.start.y() = huge;
    expect(Names("observation", "line", "segment", "1e9"));
    data_.point_observations[5].inverse_depth = huge;
    expect(Names("observation", "inverse_depth", "1e9"));
    data_.line_observations[5].depth.end = huge;
    expect(Names("observation", "line", "depth", "1e9"));
  }
  data_.point_observations[5].sigma = infinity_;
  expect(Names("observation", "sigma"));
  data_.point_observations[5].inverse_depth_sigma = infinity_;
  expect(Names("observation", "inverse_depth_sigma"));
  data_.line_observations[5].depth.covariance.setConstant(infinity_);
  expect(Names("depth", "covariance"));
}

TEST_F(WindowValidationTest, RejectsInvalidOptions) {
  options_.line_endpoint_prior_sigma = 0.0;
  EXPECT_THAT(Message(), Names("line_endpoint_prior_sigma"));
  options_ = BundleAdjustmentOptions();
  options_.second_iterations = 0;
  EXPECT_THAT(Message(), Names("second_iterations"));
  options_ = BundleAdjustmentOptions();
  options_.reject_chi2_3 = -1.0;
  EXPECT_THAT(Message(), Names("reject_chi2_3"));
  options_ = BundleAdjustmentOptions();
  options_.point_depth.huber = nan_;
  EXPECT_THAT(Message(), Names("huber"));
  options_ = BundleAdjustmentOptions();
  data_.camera.fy = 0.0;
  EXPECT_THAT(Message(), Names("fy"));
}

}  // namespace
}  // namespace msc_vo
