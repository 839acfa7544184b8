// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/plane_extractor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/features/depth_images.h"
#include "tests/support/lenses.h"
#include "tests/support/polygon_area.h"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "msc_vo/camera/undistorted_camera.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::AddInverseDepthNoise;
using testing::DrawDepth;

// The inverse depths of planes: 1 / z = q . (x / z, y / z, 1).
const Vector3d kWall(0.1, -0.05, 0.4), kFloor(0.0, 0.5, 0.2);

// What is nearer hides the other.
double Corner(const PinholeCamera& camera, const Vector2d& pixel) {
  return std::max(kWall.dot(camera.Ray(pixel)), kFloor.dot(camera.Ray(pixel)));
}

std::vector<PlaneFeature> Extract(const PinholeCamera& camera, const cv::Mat& depth) {
  return PlaneExtractor({}, camera, {}).Extract(depth);
}

TEST(PlaneExtractor, FindsWallAndFloor) {
  const PinholeCamera camera;
  const auto planes = Extract(
      camera, DrawDepth(camera, [&](const Vector2d& pixel) { return Corner(camera, pixel); }));
  ASSERT_EQ(planes.size(), 2u);
  // Cells on the edge between them are flat enough to belong to either.
  EXPECT_LT((planes[0].inverse_depth - kWall).norm(), 1e-3);
  EXPECT_LT((planes[1].inverse_depth - kFloor).norm(), 1e-3);
  EXPECT_GE(planes[0].num_pixels, planes[1].num_pixels);
  EXPECT_NEAR(planes[0].Distance(), 1.0 / kWall.norm(), 1e-3);
  EXPECT_LT(planes[0].Normal().z(), 0.0) << "towards the camera";
}

struct WideView {
  PinholeCamera camera;  // undistorted
  std::vector<PlaneFeature> planes;
};

WideView WallThroughAWideLens() {
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  CropToFieldOfView(100.0, &lens, &camera);
  const cv::Mat depth = DrawDepth(*lens.recorded, [&](const Vector2d& pixel) {
    return std::max(0.0, kWall.dot(camera.Ray(lens.Undistort(camera, pixel))));
  });
  return {camera, PlaneExtractor({}, camera, lens).Extract(depth)};
}

TEST(PlaneExtractor, IsExactThroughAWideLens) {
  const auto [camera, planes] = WallThroughAWideLens();
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_LT((planes[0].inverse_depth - kWall).norm(), 1e-4);
}

// Without errors in common, the normalised squared error is chi-square with three degrees of
// freedom by a part of the covariance: four cells count as one, which here have errors of their
// own, and the three parameters of the plane of each cell as up to three errors.
TEST(PlaneExtractor, HasTheCovarianceOfItsErrors) {
  const PinholeCamera camera;
  PlaneExtractorOptions options;
  PlaneExtractor extractor(options, camera, {});
  const cv::Mat exact =
      DrawDepth(camera, [&](const Vector2d& pixel) { return kWall.dot(camera.Ray(pixel)); });
  const double kCommonSigma = 0.5 * options.inverse_depth_noise;
  double sum = 0.0;
  constexpr int kRuns = 40;
  for (int seed = 0; seed < kRuns; ++seed) {
    cv::Mat depth = exact.clone();
    // Errors that 25 pixels share: 4 pi blur^2.
    AddInverseDepthNoise(options.inverse_depth_noise, 1.41, seed, &depth);
    const auto planes = extractor.Extract(depth);
    ASSERT_EQ(planes.size(), 1u);
    const Vector3d error = planes[0].inverse_depth - kWall;
    Eigen::Matrix3d covariance = planes[0].covariance;
    covariance.diagonal().array() -= std::pow(kCommonSigma, 2);
    sum += error.dot(covariance.inverse() * error);
  }
  EXPECT_GT(sum / kRuns / 3.0, 1.0 / 12.0);  // measured: 0.122
  EXPECT_LT(sum / kRuns / 3.0, 1.0 / 4.0);
}

// Squares of inverse depths are large there, in which single precision would lose the residuals.
TEST(PlaneExtractor, IsExactForNearSurfaces) {
  const PinholeCamera camera;
  for (const double distance : {0.25, 0.5, 1.0}) {
    const Vector3d wall = kWall / (distance * kWall.norm());
    const auto planes = Extract(camera, DrawDepth(camera, [&](const Vector2d& pixel) {
                                  return wall.dot(camera.Ray(pixel));
                                }));
    ASSERT_EQ(planes.size(), 1u) << distance;
    EXPECT_LT((planes[0].inverse_depth - wall).norm(), 1e-5 / distance);
    EXPECT_GT(planes[0].num_pixels, 0.9 * camera.width * camera.height);
  }
}

// A board in front of a wall is no part of it if the depth image is good enough to tell.
TEST(PlaneExtractor, TellsSurfacesApartByTheNoiseOfTheImage) {
  const PinholeCamera camera;
  const cv::Rect board(200, 100, 160, 160);
  cv::Mat depth(camera.height, camera.width, CV_32FC1, cv::Scalar(3.0));
  depth(board) = 2.97f;  // 3.4e-3 1/m nearer
  const auto exact = PlaneExtractor({}, camera, {}).Extract(depth);
  ASSERT_EQ(exact.size(), 2u);
  EXPECT_NEAR(exact[0].Distance(), 3.0, 1e-4);
  EXPECT_NEAR(exact[1].Distance(), 2.97, 1e-4);
  AddInverseDepthNoise(PlaneExtractorOptions().inverse_depth_noise, 1.41, 1, &depth);
  EXPECT_EQ(PlaneExtractor({}, camera, {}).Extract(depth).size(), 1u);
}

TEST(PlaneExtractor, MissingDepthDoesNotMatter) {
  const PinholeCamera camera;
  cv::Mat depth =
      DrawDepth(camera, [&](const Vector2d& pixel) { return kWall.dot(camera.Ray(pixel)); });
  depth(cv::Rect(200, 100, 150, 200)) = 0.0f;
  const auto planes = Extract(camera, depth);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_LT((planes[0].inverse_depth - kWall).norm(), 1e-4);
}

// The wall of Corner() shows where its inverse depth is the larger one.
TEST(PlaneExtractor, HasTheHullOfItsPixels) {
  const PinholeCamera camera;
  const auto planes = Extract(
      camera, DrawDepth(camera, [&](const Vector2d& pixel) { return Corner(camera, pixel); }));
  ASSERT_EQ(planes.size(), 2u);
  constexpr double kCell = 16.0;  // pixels
  double area = 0.0;
  for (const PlaneFeature& plane : planes) {
    EXPECT_GE(plane.hull.size(), 3u);
    EXPECT_LE(plane.hull.size(), PlaneFeature::kMaxHullVertices);
    // The cells along the edge between the planes form steps.
    EXPECT_NEAR(Area(plane.hull) * camera.fx * camera.fy, plane.num_pixels,
                0.5 * kCell * camera.width);
    area += Area(plane.hull);
  }
  EXPECT_NEAR(area * camera.fx * camera.fy, camera.width * camera.height,
              0.05 * camera.width * camera.height);
  for (const Vector2d& vertex : planes[0].hull) {
    EXPECT_GT((kWall - kFloor).dot(vertex.homogeneous()), -kCell / camera.fx) << "on the floor";
  }
}

TEST(PlaneExtractor, HasTheHullOfItsPixelsThroughAWideLens) {
  const auto [camera, planes] = WallThroughAWideLens();
  ASSERT_EQ(planes.size(), 1u);
  ASSERT_GE(planes[0].hull.size(), 4u);
  for (const Vector2d& vertex : planes[0].hull) {
    EXPECT_TRUE(camera.IsInside(camera.Project(vertex.homogeneous())));
  }
  EXPECT_GT(Area(planes[0].hull) * camera.fx * camera.fy, 0.7 * camera.width * camera.height);
}

TEST(PlaneExtractor, FindsNoneOnABall) {
  const PinholeCamera camera;
  constexpr double kRadius = 0.5;  // metres
  const Vector3d center(0.0, 0.0, 1.2);
  const auto planes = Extract(camera, DrawDepth(camera, [&](const Vector2d& pixel) {
                                const Vector3d ray = camera.Ray(pixel);
                                const double b = ray.dot(center), a = ray.squaredNorm();
                                const double root =
                                    b * b - a * (center.squaredNorm() - kRadius * kRadius);
                                return root < 0.0 ? 0.0 : a / (b - std::sqrt(root));
                              }));
  for (const PlaneFeature& plane : planes) {
    EXPECT_LT(plane.num_pixels, camera.width * camera.height / 20) << "a patch of the ball";
  }
}

TEST(PlaneExtractor, RefusesWrongInput) {
  const PinholeCamera camera;
  PlaneExtractor extractor({}, camera, {});
  EXPECT_THROW(extractor.Extract(cv::Mat(480, 640, CV_16UC1)), std::invalid_argument);
  EXPECT_THROW(extractor.Extract(cv::Mat(240, 320, CV_32FC1)), std::invalid_argument);
  PlaneExtractorOptions options;
  options.min_ratio = 0.0;
  EXPECT_THROW(PlaneExtractor(options, camera, {}), std::invalid_argument);
  options = {};
  options.max_depth = 0.1;
  EXPECT_THROW(PlaneExtractor(options, camera, {}), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
