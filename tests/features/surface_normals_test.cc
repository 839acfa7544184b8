// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/features/depth_images.h"
#include "tests/support/lenses.h"
#include <gtest/gtest.h>

#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::AddInverseDepthNoise;
using testing::DrawDepth;

// The plane normal . x = -distance; the camera at the origin is on its positive side.
struct VisiblePlane {
  Vector3d normal = -Vector3d::UnitZ();  // unit, towards the camera
  double distance = 2.0;                 // metres, to the camera
};

double InverseDepth(const PinholeCamera& camera, const VisiblePlane& plane, const Vector2d& pixel) {
  return std::max(0.0, -plane.normal.dot(camera.Ray(pixel)) / plane.distance);
}

cv::Mat Draw(const PinholeCamera& camera, const VisiblePlane& plane) {
  return DrawDepth(camera,
                   [&](const Vector2d& pixel) { return InverseDepth(camera, plane, pixel); });
}

std::vector<SurfaceNormal> Estimate(const PinholeCamera& camera, const cv::Mat& depth) {
  return SurfaceNormalEstimator({}, camera, {}).Estimate(depth);
}

double ErrorInDegrees(const SurfaceNormal& normal, const Vector3d& truth) {
  return RadiansToDegrees(
      std::atan2(normal.direction.cross(truth).norm(), normal.direction.dot(truth)));
}

const VisiblePlane kTilted = {Vector3d(0.5, -0.4, -1.0).normalized(), 1.5};

TEST(SurfaceNormals, AreExactThroughAWideLens) {
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  CropToFieldOfView(100.0, &lens, &camera);
  const cv::Mat depth = DrawDepth(*lens.recorded, [&](const Vector2d& pixel) {
    return InverseDepth(camera, kTilted, lens.Undistort(camera, pixel));
  });
  const auto normals = SurfaceNormalEstimator({}, camera, lens).Estimate(depth);
  EXPECT_GT(normals.size(), 700u);
  for (const SurfaceNormal& normal : normals) {
    EXPECT_LT(ErrorInDegrees(normal, kTilted.normal), 0.1);
    EXPECT_TRUE(camera.IsInside(camera.Project(normal.position), -8.0));
  }
}

class PlaneNormalsTest : public ::testing::TestWithParam<double> {};

TEST_P(PlaneNormalsTest, AreExact) {
  PinholeCamera camera;
  camera.fy = GetParam();
  const auto normals = Estimate(camera, Draw(camera, kTilted));
  EXPECT_EQ(normals.size(), 1200u);
  for (const SurfaceNormal& normal : normals) {
    EXPECT_LT(ErrorInDegrees(normal, kTilted.normal), 0.05);
    EXPECT_NEAR(kTilted.normal.dot(normal.position), -kTilted.distance, 1e-4);
    EXPECT_LT(normal.direction.dot(normal.position), 0.0) << "points away from the camera";
    EXPECT_NEAR(normal.direction.norm(), 1.0, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Fy, PlaneNormalsTest, ::testing::Values(525.0, -525.0));

TEST(SurfaceNormals, SigmaIsConsistentWithNoise) {
  const PinholeCamera camera;
  for (const double distance : {1.0, 2.0, 4.0}) {
    const VisiblePlane plane = {kTilted.normal, distance};
    cv::Mat depth = Draw(camera, plane);
    AddInverseDepthNoise(SurfaceNormalEstimator::kInverseDepthSigma, 1.5, 7, &depth);
    const auto normals = Estimate(camera, depth);
    ASSERT_GT(normals.size(), 900u) << distance;
    int num_within = 0;
    for (const SurfaceNormal& normal : normals) {
      // Two components: 99 % within three sigmas.
      const double error = DegreesToRadians(ErrorInDegrees(normal, plane.normal));
      if (error < 3.035 * normal.sigma) ++num_within;
    }
    EXPECT_GT(num_within, 0.97 * normals.size()) << distance;
  }
}

TEST(SurfaceNormals, WindowsGrowWithDepthToMeetTargetSigma) {
  const PinholeCamera camera;
  for (const double distance : {0.5, 1.0, 3.0, 6.0}) {
    const VisiblePlane frontal = {-Vector3d::UnitZ(), distance};
    const auto normals = Estimate(camera, Draw(camera, frontal));
    ASSERT_FALSE(normals.empty());
    constexpr double kTarget = SurfaceNormalEstimator::kTargetSigma;
    for (const SurfaceNormal& normal : normals) {
      EXPECT_LE(normal.sigma, 1.01 * kTarget) << distance;
      // Below the target only because the radius is rounded up.
      EXPECT_GT(normal.sigma, 0.7 * kTarget) << distance;
    }
  }
}

// The camera with images of `width` pixels.
PinholeCamera Resized(int width) {
  const double scale = width / 640.0;
  return {525.0 * scale,       525.0 * scale, 320.0 * scale - 0.5,
          240.0 * scale - 0.5, width,         width * 480 / 640};
}

// A wall with a box before it: windows end at the same angle from its edges.
TEST(SurfaceNormals, DoNotDependOnTheSizeOfTheImage) {
  std::vector<size_t> numbers;
  std::vector<double> sigmas;
  for (const int width : {320, 640, 1280, 1920}) {
    const PinholeCamera camera = Resized(width);
    const auto normals =
        Estimate(camera, DrawDepth(camera, [&](const Vector2d& pixel) {
                   const Vector3d ray = camera.Ray(pixel);
                   return std::abs(ray.x()) < 0.2 && std::abs(ray.y()) < 0.2 ? 0.8 : 1.0 / 3.0;
                 }));
    double sum = 0.0;
    for (const SurfaceNormal& normal : normals) {
      sum += normal.sigma;
      EXPECT_LT(ErrorInDegrees(normal, -Vector3d::UnitZ()), 0.1);
    }
    numbers.push_back(normals.size());
    sigmas.push_back(sum / static_cast<double>(normals.size()));
  }
  for (size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(numbers[i]) / static_cast<double>(numbers[1]), 1.0, 0.05) << i;
    EXPECT_NEAR(sigmas[i] / sigmas[1], 1.0, 0.15) << i;
  }
}

// The mean of any points of a plane lies on it.
TEST(SurfaceNormals, AreUnbiasedWithMissingDepth) {
  const PinholeCamera camera;
  cv::Mat depth = Draw(camera, kTilted);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if ((x * 7 + y * 13) % 17 < 6) depth.at<float>(y, x) = 0.0f;
    }
  }
  depth(cv::Rect(100, 100, 80, 60)) = std::numeric_limits<float>::quiet_NaN();
  const auto normals = Estimate(camera, depth);
  EXPECT_GT(normals.size(), 500u);
  for (const SurfaceNormal& normal : normals) {
    EXPECT_LT(ErrorInDegrees(normal, kTilted.normal), 0.1);
  }
}

TEST(SurfaceNormals, AreOmittedWithTooLittleDepth) {
  const PinholeCamera camera;
  cv::Mat depth = Draw(camera, kTilted);
  for (int y = 0; y < depth.rows; ++y) {
    if (y % 8 >= 3) depth.row(y) = 0.0f;
  }
  EXPECT_TRUE(Estimate(camera, depth).empty());
}

// A box half a metre in front of a wall: no window may contain both.
TEST(SurfaceNormals, WindowsDoNotCrossDepthEdges) {
  const PinholeCamera camera;
  const VisiblePlane box = {Vector3d(-0.3, 0.0, -1.0).normalized(), 1.2};
  const cv::Mat depth = DrawDepth(camera, [&](const Vector2d& pixel) {
    const bool on_box = pixel.x() > 200 && pixel.x() < 400 && pixel.y() > 150 && pixel.y() < 300;
    return InverseDepth(camera, on_box ? box : kTilted, pixel);
  });
  int num_on_box = 0;
  for (const SurfaceNormal& normal : Estimate(camera, depth)) {
    const double on_box = ErrorInDegrees(normal, box.normal);
    EXPECT_LT(std::min(on_box, ErrorInDegrees(normal, kTilted.normal)), 0.1);
    if (on_box < 0.1) ++num_on_box;
  }
  EXPECT_GT(num_on_box, 60);
}

TEST(SurfaceNormals, OfSpherePointAwayFromCentre) {
  const PinholeCamera camera;
  const Vector3d center(0.1, -0.1, 2.0);
  const double radius = 0.5;
  const cv::Mat depth = DrawDepth(camera, [&](const Vector2d& pixel) {
    // The nearer z with |z ray - center| = radius.
    const Vector3d ray = camera.Ray(pixel);
    const double a = ray.squaredNorm();
    const double b = ray.dot(center);
    const double root = b * b - a * (center.squaredNorm() - radius * radius);
    return root > 0.0 ? a / (b - std::sqrt(root)) : 0.0;
  });
  const auto normals = Estimate(camera, depth);
  EXPECT_GT(normals.size(), 100u);
  for (const SurfaceNormal& normal : normals) {
    // A window at the rim contains only the visible half of the spherical cap.
    const Vector3d truth = (normal.position - center).normalized();
    const bool is_rim = -truth.dot(normal.position.normalized()) < std::cos(1.0);
    EXPECT_LT(ErrorInDegrees(normal, truth), is_rim ? 10.0 : 1.5);
  }
}

TEST(SurfaceNormals, CompensateLensDistortion) {
  const PinholeCamera camera;
  LensDistortion lens;
  lens.k = {0.262, -0.953, -0.005, 0.003, 1.163};
  const cv::Mat depth = DrawDepth(camera, [&](const Vector2d& raw) {
    return InverseDepth(camera, kTilted, lens.Undistort(camera, raw));
  });
  const auto normals = SurfaceNormalEstimator({}, camera, lens).Estimate(depth);
  EXPECT_EQ(normals.size(), 1200u);
  for (const SurfaceNormal& normal : normals) {
    EXPECT_LT(ErrorInDegrees(normal, kTilted.normal), 0.1);
  }
}

TEST(SurfaceNormals, AreSortedByRowAndDeterministic) {
  const PinholeCamera camera;
  cv::Mat depth = Draw(camera, kTilted);
  AddInverseDepthNoise(1e-3, 1.0, 3, &depth);
  SurfaceNormalEstimator estimator({}, camera, {});
  const auto first = estimator.Estimate(depth);
  estimator.Estimate(Draw(camera, VisiblePlane()));
  const auto again = estimator.Estimate(depth);
  ASSERT_EQ(first.size(), again.size());
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].direction, again[i].direction);
    EXPECT_EQ(first[i].position, again[i].position);
  }
  const auto row_of = [&](const SurfaceNormal& normal) {
    return std::lround((camera.Project(normal.position).y() - 8.0) / 16.0);
  };
  EXPECT_TRUE(std::is_sorted(
      first.begin() + 80, first.end() - 80,
      [&](const SurfaceNormal& a, const SurfaceNormal& b) { return row_of(a) < row_of(b); }));
}

TEST(SurfaceNormals, AreOmittedWithoutDepth) {
  const PinholeCamera camera;
  EXPECT_TRUE(Estimate(camera, cv::Mat::zeros(camera.height, camera.width, CV_32FC1)).empty());
}

TEST(SurfaceNormals, ThrowOnInvalidImageOrOptions) {
  const PinholeCamera camera;
  SurfaceNormalEstimator estimator({}, camera, {});
  EXPECT_THROW(estimator.Estimate(cv::Mat::zeros(480, 640, CV_16UC1)), std::invalid_argument);
  EXPECT_THROW(estimator.Estimate(cv::Mat::zeros(240, 320, CV_32FC1)), std::invalid_argument);
  SurfaceNormalOptions options;
  options.max_depth = 30.0;  // sums over a window overflow
  std::string error;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_NE(error.find("max_depth"), std::string::npos);
  EXPECT_THROW(SurfaceNormalEstimator(options, camera, {}), std::invalid_argument);
  EXPECT_TRUE(SurfaceNormalOptions().IsValid(&error));
}

}  // namespace
}  // namespace msc_vo
