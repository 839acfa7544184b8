// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/window/synthetic_window.h"

#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

const Rigid3& PoseOf(const WindowData& data, int64_t keyframe) {
  return data.keyframes.at(keyframe).cam_from_world;
}

SyntheticWindowOptions Exact() {
  SyntheticWindowOptions options;
  options.noise = false;
  options.start_rotation_sigma = options.start_translation_sigma = 0.0;
  options.start_point_sigma = options.start_line_sigma = 0.0;
  return options;
}

class SyntheticWindowTest : public ::testing::TestWithParam<SceneKind> {};

TEST_P(SyntheticWindowTest, ObservationsAreExactAtTheTruth) {
  SyntheticWindowOptions options = Exact();
  options.scene = GetParam();
  const SyntheticWindow window = MakeSyntheticWindow(options);
  const WindowData& data = window.data;
  for (const WindowData::PointObservation& o : data.point_observations) {
    const Eigen::Vector3d x = PoseOf(data, o.keyframe) * data.points.at(o.point).position;
    EXPECT_LT((data.camera.Project(x) - o.pixel).norm(), 1e-9);
    EXPECT_NEAR(o.inverse_depth, 1.0 / x.z(), 1e-12);
  }
  for (const WindowData::LineObservation& o : data.line_observations) {
    const LineSegment3 line = PoseOf(data, o.keyframe) * data.lines.at(o.line).segment;
    const Eigen::Vector3d image_line = ImageLine(o.segment);
    for (const Eigen::Vector3d& end : {Eigen::Vector3d(line.start), Eigen::Vector3d(line.end)}) {
      const Eigen::Vector2d pixel = data.camera.Project(end);
      EXPECT_NEAR(image_line.head<2>().dot(pixel) + image_line.z(), 0.0, 1e-7);
      EXPECT_NEAR(o.depth.At(o.segment.Parameter(pixel)), 1.0 / end.z(), 1e-9);
    }
    EXPECT_GE(o.segment.Length(), 30.0);
  }
}

TEST_P(SyntheticWindowTest, LandmarksHaveTwoViewsAndIdsAreValid) {
  SyntheticWindowOptions options;
  options.scene = GetParam();
  const SyntheticWindow window = MakeSyntheticWindow(options);
  const WindowData& data = window.data;
  ASSERT_EQ(data.keyframes.size(), 8u);
  EXPECT_EQ(data.points.size(), 300u);
  EXPECT_GT(data.lines.size(), 20u);
  EXPECT_LE(data.lines.size(), 60u);
  EXPECT_EQ(window.point_outliers.size(), data.point_observations.size());
  EXPECT_EQ(window.line_outliers.size(), data.line_observations.size());
  std::vector<std::set<int64_t>> point_views(data.points.size()), line_views(data.lines.size());
  for (const WindowData::PointObservation& o : data.point_observations) {
    EXPECT_EQ(data.keyframes.at(o.keyframe).id, o.keyframe);
    EXPECT_EQ(data.points.at(o.point).id, o.point);
    EXPECT_TRUE(point_views[o.point].insert(o.keyframe).second) << "observed twice in one keyframe";
  }
  for (const WindowData::LineObservation& o : data.line_observations) {
    EXPECT_EQ(data.keyframes.at(o.keyframe).id, o.keyframe);
    EXPECT_EQ(data.lines.at(o.line).id, o.line);
    EXPECT_TRUE(line_views[o.line].insert(o.keyframe).second) << "observed twice in one keyframe";
  }
  for (const auto& views : point_views) EXPECT_GE(views.size(), 2u);
  for (const auto& views : line_views) EXPECT_GE(views.size(), 2u);
}

TEST_P(SyntheticWindowTest, PointsLieOnSurfacesAndAreNotOccluded) {
  SyntheticWindowOptions options = Exact();
  options.scene = GetParam();
  const Scene scene = MakeScene(options.scene, options.seed);
  const WindowData data = MakeSyntheticWindow(options).truth;
  for (const WindowData::Point& point : data.points) {
    EXPECT_LT(scene.Clearance(point.position), 1e-9);
  }
  for (const WindowData::PointObservation& o : data.point_observations) {
    const Eigen::Vector3d center = PoseOf(data, o.keyframe).OriginInSource();
    const Eigen::Vector3d ray = data.points.at(o.point).position - center;
    const auto hit = scene.CastRay(center, ray);
    EXPECT_GT(hit.value_or(1.0) * ray.norm(), ray.norm() - 0.005);
  }
}

TEST_P(SyntheticWindowTest, BundleAdjustmentRecoversTheTruth) {
  SyntheticWindowOptions options;
  options.scene = GetParam();
  SyntheticWindow window = MakeSyntheticWindow(options);
  const BundleAdjustmentSummary summary =
      LocalBundleAdjustment(BundleAdjustmentOptions(), &window.data);
  ASSERT_TRUE(summary.usable) << summary.message;
  for (size_t i = 0; i < window.data.keyframes.size(); ++i) {
    const Rigid3 error = window.data.keyframes[i].cam_from_world *
                         window.truth.keyframes[i].cam_from_world.Inverse();
    EXPECT_LT(error.translation().norm(), 0.015) << i;
    EXPECT_LT(LogSO3(error.rotation()).norm(), DegreesToRadians(0.3)) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SyntheticWindowTest,
                         ::testing::Values(SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kBare,
                                           SceneKind::kSlanted));

TEST(SyntheticWindow, LinesOfTheRoomAreManhattan) {
  const WindowData data = MakeSyntheticWindow(Exact()).truth;
  std::array<int, 3> per_axis{};
  for (const WindowData::Line& line : data.lines) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
      if (UndirectedAngle(Eigen::Vector3d(line.segment.Direction()), direction) < 1e-6) {
        ++per_axis[axis];
      }
    }
  }
  EXPECT_EQ(per_axis[0] + per_axis[1] + per_axis[2], static_cast<int>(data.lines.size()));
  for (const int count : per_axis) EXPECT_GT(count, 3);
}

TEST(SyntheticWindow, NoiseMatchesTheSigmas) {
  SyntheticWindowOptions options;
  options.num_points = 600;
  options.num_lines = 150;
  options.point_sigma = 0.7;
  options.line_sigma = 1.5;
  const SyntheticWindow window = MakeSyntheticWindow(options);
  double pixel = 0.0, depth = 0.0, line = 0.0, line_depth = 0.0;
  const size_t num_points = window.data.point_observations.size();
  const size_t num_lines = window.data.line_observations.size();
  ASSERT_GT(num_lines, 500u);
  for (size_t i = 0; i < num_points; ++i) {
    const auto &o = window.data.point_observations[i], &t = window.truth.point_observations[i];
    pixel += (o.pixel - t.pixel).squaredNorm() / (o.sigma * o.sigma);
    depth += std::pow((o.inverse_depth - t.inverse_depth) / o.inverse_depth_sigma, 2);
  }
  for (size_t i = 0; i < num_lines; ++i) {
    const auto &o = window.data.line_observations[i], &t = window.truth.line_observations[i];
    line += std::pow(t.segment.DistanceToLine(o.segment.start) / o.sigma, 2) +
            std::pow(t.segment.DistanceToLine(o.segment.end) / o.sigma, 2);
    const Eigen::Vector2d e(o.depth.start - t.depth.start, o.depth.end - t.depth.end);
    line_depth += e.dot(o.depth.covariance.inverse() * e);
  }
  // Mean square of n standard normal variables: 1 +- 4 sqrt(2 / n).
  EXPECT_NEAR(pixel / (2.0 * num_points), 1.0, 4.0 / std::sqrt(num_points));
  EXPECT_NEAR(depth / num_points, 1.0, 4.0 * std::sqrt(2.0 / num_points));
  EXPECT_NEAR(line / (2.0 * num_lines), 1.0, 4.0 / std::sqrt(num_lines));
  EXPECT_NEAR(line_depth / (2.0 * num_lines), 1.0, 4.0 / std::sqrt(num_lines));
}

TEST(SyntheticWindow, OutliersAreMarkedAndLarge) {
  SyntheticWindowOptions options;
  options.outlier_ratio = 0.2;
  const SyntheticWindow window = MakeSyntheticWindow(options);
  size_t outliers = 0;
  for (size_t i = 0; i < window.point_outliers.size(); ++i) {
    const double error =
        (window.data.point_observations[i].pixel - window.truth.point_observations[i].pixel).norm();
    outliers += window.point_outliers[i] ? 1 : 0;
    EXPECT_EQ(window.point_outliers[i], error > 10.0);
  }
  EXPECT_NEAR(outliers / static_cast<double>(window.point_outliers.size()), 0.2, 0.04);
  for (size_t i = 0; i < window.line_outliers.size(); ++i) {
    const LineSegment2& truth = window.truth.line_observations[i].segment;
    const LineSegment2& noisy = window.data.line_observations[i].segment;
    EXPECT_EQ(window.line_outliers[i], truth.DistanceToLine(noisy.start) > 10.0);
  }
}

TEST(SyntheticWindow, InitialErrorExcludesFixedKeyframes) {
  SyntheticWindowOptions options;
  options.num_fixed = 2;
  const SyntheticWindow window = MakeSyntheticWindow(options);
  for (size_t i = 0; i < window.data.keyframes.size(); ++i) {
    const auto &start = window.data.keyframes[i], &truth = window.truth.keyframes[i];
    EXPECT_EQ(start.fixed, i < 2);
    EXPECT_EQ(start.cam_from_world.params == truth.cam_from_world.params, i < 2);
  }
}

TEST(SyntheticWindow, NoiseDoesNotChangeVisibility) {
  SyntheticWindowOptions options;
  const SyntheticWindow noisy = MakeSyntheticWindow(options), again = MakeSyntheticWindow(options);
  options.noise = false;
  const SyntheticWindow exact = MakeSyntheticWindow(options);
  ASSERT_EQ(noisy.data.point_observations.size(), exact.data.point_observations.size());
  for (size_t i = 0; i < noisy.data.point_observations.size(); ++i) {
    EXPECT_EQ(noisy.data.point_observations[i].pixel, again.data.point_observations[i].pixel);
    EXPECT_EQ(noisy.truth.point_observations[i].pixel, exact.data.point_observations[i].pixel);
  }
  options.seed = 2;
  EXPECT_NE(MakeSyntheticWindow(options).truth.points[0].position, exact.truth.points[0].position);
}

TEST(SyntheticWindow, OmitsDepthIfDisabled) {
  SyntheticWindowOptions options;
  options.depth = false;
  const SyntheticWindow window = MakeSyntheticWindow(options);
  for (const auto& o : window.data.point_observations) EXPECT_EQ(o.inverse_depth, 0.0);
  for (const auto& o : window.data.line_observations) EXPECT_FALSE(o.has_depth);
}

TEST(SyntheticWindow, SupportsMirroredCameras) {
  SyntheticWindowOptions options;
  options.camera.fy = -480.0;
  SyntheticWindow window = MakeSyntheticWindow(options);
  EXPECT_EQ(window.data.points.size(), 300u);
  EXPECT_TRUE(LocalBundleAdjustment(BundleAdjustmentOptions(), &window.data).usable);
  const Rigid3 error = window.data.keyframes.back().cam_from_world *
                       window.truth.keyframes.back().cam_from_world.Inverse();
  EXPECT_LT(error.translation().norm(), 0.015);
}

TEST(SyntheticWindow, RejectsInvalidOptions) {
  SyntheticWindowOptions options;
  options.num_keyframes = 1;
  EXPECT_THROW(MakeSyntheticWindow(options), std::invalid_argument);
  options = {};
  options.point_sigma = 0.0;
  EXPECT_THROW(MakeSyntheticWindow(options), std::invalid_argument);
  options = {};
  options.outlier_ratio = 1.5;
  EXPECT_THROW(MakeSyntheticWindow(options), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
