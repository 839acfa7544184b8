// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/support/lenses.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A colour camera with another focal length, another size and a lens.
PinholeCamera Color() { return {260.0, 262.0, 161.0, 118.0, 320, 240}; }

LensDistortion Lens() { return {{0.26, -0.95, -0.005, 0.003, 1.16}}; }

DepthCamera Rig() {
  DepthCamera rig;
  rig.camera = {292.0, 290.0, 158.0, 121.0, 320, 240};
  rig.depth_from_color = {ExpSO3({0.01, -0.015, 0.02}), {-0.025, 0.004, 0.003}};
  return rig;
}

// Inverse depth of plane normal . x = 1 (colour frame) at a raw colour pixel.
double InverseDepthAt(const Vector3d& normal, const LensDistortion& lens, int x, int y) {
  return normal.dot(Color().Ray(lens.Undistort(Color(), {x, y})));
}

// Depth image of the nearest of some planes normal . x = 1 of the colour frame; each ends at the
// column of the depth image where its mask says so.
struct MaskedPlane {
  Vector3d normal;
  std::function<bool(const Vector3d& x_in_color)> contains = [](const Vector3d&) { return true; };
};

cv::Mat Measure(const DepthCamera& rig, const std::vector<MaskedPlane>& planes) {
  cv::Mat depth(rig.camera.height, rig.camera.width, CV_32FC1, cv::Scalar(0.0f));
  const Rigid3 color_from_depth = rig.depth_from_color.Inverse();
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const Vector3d ray = rig.camera.Ray(Vector2d(x, y));
      double nearest = std::numeric_limits<double>::infinity();
      for (const MaskedPlane& plane : planes) {
        // normal . (R z ray + t) = 1.
        const double z = (1.0 - plane.normal.dot(color_from_depth.translation())) /
                         plane.normal.dot(color_from_depth.rotation() * ray);
        if (z > 0.0 && z < nearest && plane.contains(color_from_depth * (z * ray))) nearest = z;
      }
      if (std::isfinite(nearest)) depth.at<float>(y, x) = static_cast<float>(nearest);
    }
  }
  return depth;
}

// Largest error of the inverse depth of a plane, and the ratio of the pixels that have depth.
double LargestError(const cv::Mat& registered, const Vector3d& normal, const LensDistortion& lens,
                    double* coverage) {
  double largest = 0.0;
  int count = 0;
  for (int y = 0; y < registered.rows; ++y) {
    for (int x = 0; x < registered.cols; ++x) {
      const double depth = registered.at<float>(y, x);
      if (depth == 0.0) continue;
      ++count;
      largest = std::max(largest, std::abs(1.0 / depth - InverseDepthAt(normal, lens, x, y)));
    }
  }
  *coverage = static_cast<double>(count) / registered.total();
  return largest;
}

const Vector3d kPlanes[] = {{0.0, 0.0, 0.5}, {0.1, -0.08, 0.4}, {-0.6, 0.2, 0.9}};

constexpr double kRounding = 2e-6;  // 1/metres, of single precision

TEST(DepthRegistration, IsExactOnPlanes) {
  for (const Vector3d& normal : kPlanes) {
    for (const LensDistortion& lens : {LensDistortion(), Lens()}) {
      const cv::Mat registered =
          DepthRegistration(Rig(), Color(), lens).Register(Measure(Rig(), {{normal}}));
      double coverage = 0.0;
      EXPECT_LT(LargestError(registered, normal, lens, &coverage), kRounding);
      EXPECT_GT(coverage, 0.75);  // the depth camera sees less
      // The plane has no hole.
      EXPECT_EQ(cv::countNonZero(registered(cv::Rect(60, 45, 200, 150)) == 0.0f), 0);
    }
  }
}

TEST(DepthRegistration, IsExactForOtherLenses) {
  // Colour by a fisheye lens, depth by a rational one.
  PinholeCamera color{150.0, 151.0, 161.0, 118.0, 320, 240};
  LensDistortion lens = WideLens();
  CropToFieldOfView(80.0, &lens, &color);
  DepthCamera rig = Rig();
  rig.distortion = AzureKinectLens();
  for (const Vector3d& normal : kPlanes) {
    cv::Mat depth(240, 320, CV_32FC1);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        const Vector3d ray = rig.camera.Ray(rig.distortion.Undistort(rig.camera, {x, y}));
        const Rigid3 color_from_depth = rig.depth_from_color.Inverse();
        const double z = (1.0 - normal.dot(color_from_depth.translation())) /
                         normal.dot(color_from_depth.rotation() * ray);
        depth.at<float>(y, x) = z > 0.0 ? static_cast<float>(z) : 0.0f;
      }
    }
    const cv::Mat registered = DepthRegistration(rig, color, lens).Register(depth);
    double largest = 0.0;
    int holes = 0;
    for (int y = 0; y < registered.rows; ++y) {
      for (int x = 0; x < registered.cols; ++x) {
        const Vector2d ideal = lens.Undistort(color, {x, y});
        const double z = registered.at<float>(y, x);
        if (z > 0.0) largest = std::max(largest, std::abs(1.0 / z - normal.dot(color.Ray(ideal))));
        holes += z == 0.0 && std::abs(x - 160) < 60 && std::abs(y - 120) < 45;
      }
    }
    // Steps to neighbours are differences in a distorted image, not derivatives.
    EXPECT_LT(largest, 1e-4);
    EXPECT_EQ(holes, 0);
  }
}

TEST(DepthRegistration, IsExactForOtherSizes) {
  for (const int factor : {1, 2, 3}) {
    DepthCamera rig = Rig();
    PinholeCamera& camera = rig.camera;
    const double scale = factor == 1 ? 2.0 : 1.0 / factor;
    camera = {scale * camera.fx,
              scale * camera.fy,
              scale * (camera.cx + 0.5) - 0.5,
              scale * (camera.cy + 0.5) - 0.5,
              static_cast<int>(scale * camera.width),
              static_cast<int>(scale * camera.height)};
    const cv::Mat registered =
        DepthRegistration(rig, Color(), Lens()).Register(Measure(rig, {{kPlanes[1]}}));
    ASSERT_EQ(registered.size(), cv::Size(320, 240));
    double coverage = 0.0;
    EXPECT_LT(LargestError(registered, kPlanes[1], Lens(), &coverage), kRounding);
    EXPECT_GT(coverage, 0.7);
    EXPECT_EQ(cv::countNonZero(registered(cv::Rect(60, 45, 200, 150)) == 0.0f), 0);
  }
}

TEST(DepthRegistration, IsExactWhereColorPixelsAreSmall) {
  // The depth pixels are 1.8 and 3.2 colour pixels large; odd sizes.
  for (const double scale : {2.0, 3.6}) {
    PinholeCamera color = Color();
    color = {scale * color.fx,
             scale * color.fy,
             scale * color.cx,
             scale * color.cy,
             static_cast<int>(scale * 320.0) | 1,
             static_cast<int>(scale * 240.0) | 1};
    for (const Vector3d& normal : kPlanes) {
      for (const LensDistortion& lens : {LensDistortion(), Lens()}) {
        const cv::Mat registered =
            DepthRegistration(Rig(), color, lens).Register(Measure(Rig(), {{normal}}));
        double largest = 0.0;
        int holes = 0;
        for (int y = 0; y < registered.rows; ++y) {
          for (int x = 0; x < registered.cols; ++x) {
            const double z = registered.at<float>(y, x);
            const double w = normal.dot(color.Ray(lens.Undistort(color, {x, y})));
            if (z > 0.0) largest = std::max(largest, std::abs(1.0 / z - w));
            holes += z == 0.0 && std::abs(x - color.cx) < 100.0 * scale &&
                     std::abs(y - color.cy) < 70.0 * scale;
          }
        }
        // A lens bends the rows and columns along which inverse depth is interpolated.
        EXPECT_LT(largest, lens.IsZero() ? kRounding : 2.0 * kRounding) << scale;
        EXPECT_EQ(holes, 0) << scale;
      }
    }
  }
}

TEST(DepthRegistration, KeepsThinObjectsInFrontOfAWall) {
  // A wire of 1.2 depth pixels at one metre, at several positions relative to the pixel grids.
  DepthCamera rig = Rig();
  rig.depth_from_color = {Eigen::Quaterniond::Identity(), {-0.025, 0.0, 0.0}};
  const double radius = 0.6 / rig.camera.fx;
  for (const double scale : {1.0, 2.0}) {
    PinholeCamera color{260.0 * scale,
                        260.0 * scale,
                        160.0 * scale,
                        120.0 * scale,
                        static_cast<int>(320 * scale),
                        static_cast<int>(240 * scale)};
    for (int i = 0; i < 10; ++i) {
      const double center = 0.1 + 0.37 * i / rig.camera.fx;
      const std::vector<MaskedPlane> planes = {
          {{0.0, 0.0, 1.0}, [&](const Vector3d& x) { return std::abs(x.x() - center) < radius; }},
          {{0.0, 0.0, 1.0 / 3.0}}};
      const cv::Mat registered = DepthRegistration(rig, color, {}).Register(Measure(rig, planes));
      const int x = static_cast<int>(std::lround(color.cx + color.fx * center));
      const cv::Mat around = registered(cv::Rect(x - 2, 30, 5, color.height - 60));
      for (int y = 0; y < around.rows; ++y) {
        const float* const row = around.ptr<float>(y);
        EXPECT_TRUE(std::any_of(row, row + 5, [](float z) { return std::abs(z - 1.0f) < 1e-5f; }))
            << scale << " " << i << " " << y;
      }
    }
  }
}

TEST(DepthRegistration, IsExactForTurnedAndMirroredCameras) {
  DepthCamera rig = Rig();
  rig.depth_from_color = {ExpSO3({0.0, 0.0, 0.7}), {0.05, -0.02, -0.01}};
  double coverage = 0.0;
  cv::Mat registered = DepthRegistration(rig, Color(), {}).Register(Measure(rig, {{kPlanes[1]}}));
  EXPECT_LT(LargestError(registered, kPlanes[1], {}, &coverage), kRounding);
  EXPECT_EQ(cv::countNonZero(registered(cv::Rect(110, 70, 100, 100)) == 0.0f), 0);
  rig = Rig();
  rig.camera.fy = -rig.camera.fy;
  registered = DepthRegistration(rig, Color(), {}).Register(Measure(rig, {{kPlanes[1]}}));
  EXPECT_LT(LargestError(registered, kPlanes[1], {}, &coverage), kRounding);
  EXPECT_GT(coverage, 0.8);
}

TEST(DepthRegistration, IsEmptyForCamerasThatLookPastEachOther) {
  DepthCamera rig = Rig();
  for (const double angle : {1.2, 1.4, 1.5}) {
    for (const Vector3d& axis : {Vector3d::UnitX().eval(), Vector3d::UnitY().eval()}) {
      rig.depth_from_color = {ExpSO3(angle * axis), {-0.025, 0.004, 0.003}};
      const cv::Mat depth(rig.camera.height, rig.camera.width, CV_32FC1, cv::Scalar(2.0f));
      for (const LensDistortion& lens : {LensDistortion(), Lens()}) {
        EXPECT_EQ(cv::countNonZero(DepthRegistration(rig, Color(), lens).Register(depth)), 0)
            << angle;
      }
    }
  }
}

TEST(DepthRegistration, AddsInverseDepthOffset) {
  DepthCamera rig = Rig();
  cv::Mat depth = Measure(rig, {{kPlanes[1]}});
  rig.inverse_depth_offset = 0.02;
  depth.forEach<float>([](float& z, const int*) { z = 1.0f / (1.0f / z - 0.02f); });
  double coverage = 0.0;
  EXPECT_LT(
      LargestError(DepthRegistration(rig, Color(), {}).Register(depth), kPlanes[1], {}, &coverage),
      kRounding);
}

// A post at one metre in front of a wall at three metres.
std::vector<MaskedPlane> PostAndWall() {
  return {{{0.0, 0.0, 1.0}, [](const Vector3d& x) { return std::abs(x.x()) < 0.1; }},
          {{0.0, 0.0, 1.0 / 3.0}}};
}

TEST(DepthRegistration, OccludesAndDoesNotBridge) {
  DepthCamera rig;
  rig.camera = {292.0, 292.0, 160.0, 120.0, 320, 240};
  rig.depth_from_color.translation() = Vector3d(-0.025, 0.0, 0.0);  // to the right of colour
  const PinholeCamera color = {260.0, 260.0, 160.0, 120.0, 320, 240};
  const cv::Mat registered =
      DepthRegistration(rig, color, {}).Register(Measure(rig, PostAndWall()));
  for (int y = 20; y < 220; ++y) {
    for (int x = 40; x < 280; ++x) {
      const double depth = registered.at<float>(y, x);
      // The post is 26 px to both sides of column 160. What is beside it on the left is hidden from
      // the depth camera: 0.025 m * 260 px * (1 - 1/3) / m = 4.3 px.
      const double from_post = std::abs(x - 160.0) - 26.0;
      if (std::abs(from_post) < 1.0) {
        EXPECT_TRUE(depth == 0.0 || std::abs(depth - 1.0) < 1e-5 || std::abs(depth - 3.0) < 1e-5)
            << x << " " << depth;
      } else if (from_post < 0.0) {
        EXPECT_NEAR(depth, 1.0, 1e-5) << x;
      } else if (x < 160 && from_post < 3.4) {
        EXPECT_EQ(depth, 0.0) << x;
      } else if (x > 160 || from_post > 5.4) {
        EXPECT_NEAR(depth, 3.0, 1e-5) << x;
      }
    }
  }
}

TEST(DepthRegistration, DoesNotShowBackgroundThroughHoles) {
  DepthCamera rig;
  rig.camera = {292.0, 292.0, 160.0, 120.0, 320, 240};
  // The depth camera sees the wall beside the right border of the post, which colour does not.
  rig.depth_from_color.translation() = Vector3d(-0.05, 0.0, 0.0);
  const PinholeCamera color = {260.0, 260.0, 160.0, 120.0, 320, 240};
  cv::Mat depth = Measure(rig, PostAndWall());
  const cv::Mat complete = DepthRegistration(rig, color, {}).Register(depth);
  // Points of the wall land on columns 177.3 to 186 of the colour image. A hole of the post there:
  // colour column 180 is x = 0.0769, and depth column 160 + 292 * (0.0769 - 0.05) = 167.9.
  ASSERT_NEAR(complete.at<float>(120, 180), 1.0, 1e-5);
  depth(cv::Rect(167, 119, 2, 3)).setTo(0.0f);
  const cv::Mat registered = DepthRegistration(rig, color, {}).Register(depth);
  int num_missing = 0;
  for (int y = 100; y < 140; ++y) {
    for (int x = 140; x < 185; ++x) {
      if (registered.at<float>(y, x) == 0.0f) ++num_missing;
      EXPECT_TRUE(registered.at<float>(y, x) < 1.1f) << x << " " << y;
    }
  }
  EXPECT_GE(num_missing, 2);
  EXPECT_LE(num_missing, 12);
}

TEST(DepthRegistration, KeepsMissingDepthAndIgnoresInvalid) {
  cv::Mat depth = Measure(Rig(), {{kPlanes[0]}});
  depth(cv::Rect(150, 100, 20, 20)).setTo(0.0f);
  depth(cv::Rect(100, 100, 20, 20)).setTo(std::numeric_limits<float>::quiet_NaN());
  depth(cv::Rect(100, 140, 20, 20)).setTo(-1.0f);
  depth.at<float>(60, 200) = 1e-30f;
  depth.at<float>(60, 210) = std::numeric_limits<float>::infinity();
  const cv::Mat registered = DepthRegistration(Rig(), Color(), {}).Register(depth);
  // 20 pixels of the depth image are 17.9 of the colour image.
  EXPECT_NEAR(cv::countNonZero(registered(cv::Rect(60, 45, 200, 150)) == 0.0f), 3 * 17.9 * 17.9,
              3 * 2 * 17.9);
  double coverage = 0.0;
  EXPECT_LT(LargestError(registered, kPlanes[0], {}, &coverage), kRounding);
}

TEST(DepthRegistration, DoesNotAddNoise) {
  cv::Mat depth = Measure(Rig(), {{kPlanes[1]}});
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0f, 2e-3f);
  for (int i = 0; i < static_cast<int>(depth.total()); ++i) {
    float& z = depth.ptr<float>()[i];
    z = 1.0f / (1.0f / z + noise(random));
  }
  const cv::Mat registered = DepthRegistration(Rig(), Color(), {}).Register(depth);
  EXPECT_EQ(cv::countNonZero(registered(cv::Rect(60, 45, 200, 150)) == 0.0f), 0);
  double sum = 0.0, squares = 0.0;
  for (int y = 45; y < 195; ++y) {
    for (int x = 60; x < 260; ++x) {
      const double error = 1.0 / registered.at<float>(y, x) - InverseDepthAt(kPlanes[1], {}, x, y);
      sum += error;
      squares += error * error;
    }
  }
  const int count = 150 * 200;
  EXPECT_LT(std::sqrt(squares / count), 1.05 * 2e-3);
  EXPECT_LT(std::abs(sum / count), 0.05 * 2e-3);  // no preference for near measurements
}

TEST(DepthRegistration, RejectsWrongSizes) {
  const DepthRegistration registration(Rig(), Color(), {});
  EXPECT_THROW(registration.Register(cv::Mat(239, 320, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(registration.Register(cv::Mat(240, 320, CV_16UC1)), std::invalid_argument);
}

TEST(DepthRegistration, RejectsMillimetres) {
  cv::Mat millimetres(240, 320, CV_32FC1);
  for (int y = 0; y < 240; ++y) millimetres.row(y) = 1500.0 + y;
  const DepthRegistration registration(Rig(), Color(), {});
  EXPECT_THROW(registration.Register(millimetres), std::invalid_argument);
  EXPECT_GT(cv::countNonZero(registration.Register(0.001 * millimetres)), 0);
}

TEST(DepthCamera, ErrorsNameValue) {
  const auto error_of = [](const std::function<void(DepthCamera*)>& change) {
    DepthCamera rig = Rig();
    change(&rig);
    std::string error;
    EXPECT_FALSE(rig.IsValid(&error));
    return error;
  };
  std::string error;
  EXPECT_TRUE(Rig().IsValid(&error)) << error;
  EXPECT_THAT(error_of([](DepthCamera* rig) { rig->camera.fx = -1.0; }), Names("fx", "-1"));
  EXPECT_THAT(error_of([](DepthCamera* rig) { rig->depth_from_color.translation().x() = 25.0; }),
              Names("translation"));
  EXPECT_THAT(error_of([](DepthCamera* rig) { rig->depth_from_color.rotation().w() = 2.0; }),
              Names("rotation"));
  EXPECT_THAT(error_of([](DepthCamera* rig) {
                rig->depth_from_color.rotation() = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
              }),
              Names("rotation", "90"));
  EXPECT_THAT(error_of([](DepthCamera* rig) { rig->inverse_depth_offset = 1.0; }),
              Names("inverse_depth_offset", "1"));
}

}  // namespace
}  // namespace msc_vo
