// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_alignment.h"

#include <algorithm>
#include <cmath>

#include "tests/support/lenses.h"
#include <gtest/gtest.h>

#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Eigen::Vector3d;

PinholeCamera Camera() {
  PinholeCamera camera;
  camera.fx = 260.0;
  camera.fy = 262.0;
  camera.cx = 161.0;
  camera.cy = 118.0;
  camera.width = 320;
  camera.height = 240;
  return camera;
}

// Depth image of the plane normal . x = 1 in the camera frame.
cv::Mat DepthOf(const PinholeCamera& camera, const Vector3d& normal) {
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0);
      depth.at<float>(y, x) = static_cast<float>(1.0 / normal.dot(ray));
    }
  }
  return depth;
}

// Largest difference of inverse depths over the pixels where `aligned` has a depth.
double LargestDifference(const cv::Mat& aligned, const cv::Mat& expected, int* num_missing) {
  double largest = 0.0;
  *num_missing = 0;
  for (int y = 0; y < expected.rows; ++y) {
    for (int x = 0; x < expected.cols; ++x) {
      const double depth = aligned.at<float>(y, x);
      if (depth == 0.0) {
        ++*num_missing;
      } else {
        largest = std::max(largest, std::abs(1.0 / depth - 1.0 / expected.at<float>(y, x)));
      }
    }
  }
  return largest;
}

TEST(DepthAlignment, WarpsPlaneToTimeOfColourImage) {
  const PinholeCamera camera = Camera();
  const Vector3d normal(0.1, -0.08, 0.4);
  const cv::Mat expected = DepthOf(camera, normal);
  for (const Rigid3& motion : {Rigid3(ExpSO3({0.03, 0.0, 0.0}), {0.0, 0.0, 0.0}),
                               Rigid3(ExpSO3({0.0, -0.03, 0.05}), {0.0, 0.0, 0.0}),
                               Rigid3(ExpSO3({0.0, 0.0, 0.0}), {0.02, -0.01, 0.03}),
                               Rigid3(ExpSO3({0.02, 0.02, -0.03}), {-0.01, 0.02, -0.03})}) {
    // normal . x = 1 becomes (R normal) . x' = 1 + (R normal) . t.
    const Vector3d turned = motion.rotation() * normal;
    const Vector3d there = turned / (1.0 + turned.dot(motion.translation()));
    int num_missing = 0;
    const double largest = LargestDifference(AlignDepth(camera, DepthOf(camera, there), motion),
                                             expected, &num_missing);
    // Half a pixel of rounding in x and in y, where inverse depth is there . ray; 10 % for the
    // squared ratio of both depths and for the initial value of the parallax.
    const double rounding = std::abs(there.x()) / camera.fx + std::abs(there.y()) / camera.fy;
    EXPECT_LT(largest, 1.1 * 0.5 * rounding);
    EXPECT_LT(num_missing, 320 * 240 / 8);  // outside the depth image
  }
}

TEST(DepthAlignment, ShiftsDepthEdges) {
  const PinholeCamera camera = Camera();
  cv::Mat depth(240, 320, CV_32FC1, cv::Scalar(2.0f));
  depth.colRange(165, 320).setTo(1.0f);
  // The camera rotates to the right by 5 px after the colour image: the image moves to the left.
  const Rigid3 turn(ExpSO3({0.0, -5.0 / camera.fx, 0.0}), {0.0, 0.0, 0.0});
  const cv::Mat aligned = AlignDepth(camera, depth, turn);
  EXPECT_NEAR(aligned.at<float>(118, 168), 2.0, 0.05);
  EXPECT_NEAR(aligned.at<float>(118, 172), 1.0, 0.05);
  // The camera moves to the right, which shifts the near half by 6 px and the far half by 3 px.
  const Rigid3 step(Eigen::Quaterniond::Identity(), {-6.0 / camera.fx, 0.0, 0.0});
  const cv::Mat stepped = AlignDepth(camera, depth, step);
  EXPECT_EQ(stepped.at<float>(118, 166), 2.0f);
  EXPECT_EQ(stepped.at<float>(118, 173), 1.0f);
}

TEST(DepthAlignment, ReturnsInputForSmallMotion) {
  const cv::Mat depth(240, 320, CV_32FC1, cv::Scalar(2.0f));
  const auto is_unchanged = [&](const Vector3d& turn, const Vector3d& translation) {
    return AlignDepth(Camera(), depth, Rigid3(ExpSO3(turn), translation)).data == depth.data;
  };
  EXPECT_TRUE(is_unchanged({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
  EXPECT_TRUE(is_unchanged({0.0, 0.3 / 262.0, 0.0}, {0.0, 0.1 / 262.0, 0.0}));
  EXPECT_FALSE(is_unchanged({0.0, 1.0 / 262.0, 0.0}, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(is_unchanged({0.0, 0.0, 0.0}, {0.0, 1.0 / 262.0, 0.0}));
}

TEST(DepthAlignment, PreservesMissingDepth) {
  cv::Mat depth(240, 320, CV_32FC1, cv::Scalar(2.0f));
  depth(cv::Rect(100, 100, 20, 20)).setTo(0.0f);
  const Rigid3 roll(ExpSO3({0.0, 0.0, 0.02}), {0.0, 0.0, 0.0});
  const cv::Mat aligned = AlignDepth(Camera(), depth, roll);
  EXPECT_EQ(aligned.at<float>(110, 110), 0.0f);
  EXPECT_GT(aligned.at<float>(150, 150), 0.0f);
}

TEST(DepthAlignment, WarpsPlaneThroughAWideLens) {
  PinholeCamera camera{150.0, 151.0, 161.0, 118.0, 320, 240};
  LensDistortion lens = WideLens();
  CropToFieldOfView(90.0, &lens, &camera);
  const Vector3d normal(0.1, -0.08, 0.4);
  const auto depth_of = [&](const Vector3d& plane) {
    cv::Mat depth(camera.height, camera.width, CV_32FC1);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        const double w = plane.dot(camera.Ray(lens.Undistort(camera, Eigen::Vector2d(x, y))));
        depth.at<float>(y, x) = w > 0.0 ? static_cast<float>(1.0 / w) : 0.0f;
      }
    }
    return depth;
  };
  const Rigid3 motion(ExpSO3({0.02, 0.04, -0.03}), {-0.01, 0.02, -0.03});
  const Vector3d turned = motion.rotation() * normal;
  const cv::Mat there = depth_of(turned / (1.0 + turned.dot(motion.translation())));
  const cv::Mat expected = depth_of(normal);
  const cv::Mat aligned = DepthAligner(camera, lens).Align(there, motion);
  double largest = 0.0;
  int count = 0;
  for (int y = 0; y < aligned.rows; ++y) {
    for (int x = 0; x < aligned.cols; ++x) {
      const double depth = aligned.at<float>(y, x);
      if (depth == 0.0) continue;
      ++count;
      largest = std::max(largest, std::abs(1.0 / depth - 1.0 / expected.at<float>(y, x)));
    }
  }
  // Half a pixel of the steepest slope at the border of the image.
  EXPECT_LT(largest, 2.5e-3);
  EXPECT_GT(count, static_cast<int>(aligned.total() / 2));
}

}  // namespace
}  // namespace msc_vo
