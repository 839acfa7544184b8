// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Registered depth against the depth that a renderer gives for the colour camera.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/sensor/depth_registration.h"
#include "msc_vo/synthetic/scene/lens_warp.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

// Ratios of the colour pixels whose surface point is in view of the depth camera.
struct Accuracy {
  double accurate = 0.0;  // within 1 % of the true depth
  double wrong = 0.0;     // off by more than 5 %
  double missing = 0.0;
};

DepthCamera SimulatedRig() {
  DepthCamera rig;
  rig.camera = {290.0, 291.0, 159.0, 120.5, 320, 240};
  rig.depth_from_color = {
      Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d(0.3, 0.5, 0.8).normalized())),
      {0.025, 0.004, 0.002}};
  return rig;
}

cv::Mat DepthOf(const RenderedImage& image) {
  return cv::Mat(image.height, image.width, CV_32FC1, const_cast<float*>(image.depth.data()))
      .clone();
}

// Distances of the pixels to the depth edges of an image, pixels.
cv::Mat EdgeDistances(const cv::Mat& depth) {
  cv::Mat is_flat(depth.size(), CV_8UC1, cv::Scalar(255));
  for (int y = 0; y + 1 < depth.rows; ++y) {
    for (int x = 0; x + 1 < depth.cols; ++x) {
      const double w = 1.0 / depth.at<float>(y, x);
      for (const cv::Point& other : {cv::Point(x + 1, y), cv::Point(x, y + 1)}) {
        const double v = 1.0 / depth.at<float>(other);
        if (std::abs(v - w) <= 0.04 * std::max(v, w)) continue;
        is_flat.at<uint8_t>(y, x) = is_flat.at<uint8_t>(other) = 0;
      }
    }
  }
  cv::Mat distances;
  cv::distanceTransform(is_flat, distances, cv::DIST_L2, 5);
  return distances;
}

// Tests whether the depth camera sees the point of a colour pixel, if nothing hides it.
bool IsInView(const DepthCamera& rig, const Eigen::Vector3d& x_in_color) {
  return rig.camera.IsInside(rig.camera.Project(rig.depth_from_color * x_in_color), 3.0);
}

// Accuracy at the edges (up to two depth pixels from one), and elsewhere.
struct Accuracies {
  Accuracy edges, surfaces;
};

Accuracies Measure(SceneKind scene, bool is_noisy, const PinholeCamera& color, double k1) {
  SyntheticSequenceOptions options;
  options.scene = scene;
  const SyntheticSequence sequence(options);
  LensDistortion lens;
  lens.k[0] = k1;
  const LensWarp warp(color, lens);
  const DepthCamera rig = SimulatedRig();
  const Renderer color_renderer(sequence.scene(), lens.IsZero() ? color : warp.source());
  const Renderer depth_renderer(sequence.scene(), rig.camera);
  const DepthRegistration registration(rig, color, lens);
  int counts[2][4] = {};
  for (const int index : {17, 40, 63}) {
    const Rigid3 pose = sequence.PoseAt(index).world_from_cam.Inverse();
    const RenderedImage rendered = color_renderer.Render(pose);
    const cv::Mat truth = DepthOf(lens.IsZero() ? rendered : warp.Warp(rendered));
    RenderedImage measured = depth_renderer.Render(rig.depth_from_color * pose);
    if (is_noisy) AddKinectNoise({}, rig.camera, /*seed=*/1, index, &measured.depth);
    const cv::Mat registered = registration.Register(DepthOf(measured));
    const cv::Mat distances = EdgeDistances(truth);
    for (int y = 0; y < truth.rows; ++y) {
      for (int x = 0; x < truth.cols; ++x) {
        const double z = truth.at<float>(y, x), depth = registered.at<float>(y, x);
        const Eigen::Vector2d pixel = lens.Undistort(color, Eigen::Vector2d(x, y));
        if (z == 0.0 || !IsInView(rig, color.BackProject(pixel, z))) continue;
        const double edge = distances.at<float>(y, x) * rig.camera.fx / color.fx;
        int* const count = counts[edge <= 2.0 ? 0 : 1];
        ++count[0];
        count[1] += depth > 0.0 && std::abs(depth / z - 1.0) < 0.01;
        count[2] += depth > 0.0 && std::abs(depth / z - 1.0) > 0.05;
        count[3] += depth == 0.0;
      }
    }
  }
  const auto ratios = [](const int(&count)[4]) -> Accuracy {
    const double all = count[0];
    return {count[1] / all, count[2] / all, count[3] / all};
  };
  return {ratios(counts[0]), ratios(counts[1])};
}

// The bounds are the ratios that drawing every depth pixel as a parallelogram reaches, with a tenth
// more wrong and missing pixels, and 15 % more pixels that are not accurate.
struct Case {
  std::string name;
  SceneKind scene;
  bool is_noisy;
  PinholeCamera color;
  double k1;
  Accuracy edges, surfaces;  // bounds
};

// Colour images of the size of the depth images, of twice and of half the size.
const PinholeCamera kSame{300.0, 300.0, 159.5, 119.5, 320, 240};
const PinholeCamera kLarge{455.0, 455.0, 319.5, 179.5, 640, 360};
const PinholeCamera kSmall{150.0, 150.0, 79.5, 59.5, 160, 120};

class RegistrationAccuracy : public ::testing::TestWithParam<Case> {};

TEST_P(RegistrationAccuracy, SeesSurfacesOfRenderedScenes) {
  const Case& c = GetParam();
  const Accuracies measured = Measure(c.scene, c.is_noisy, c.color, c.k1);
  const auto check = [](const Accuracy& accuracy, const Accuracy& bound) {
    EXPECT_GE(accuracy.accurate, bound.accurate);
    EXPECT_LE(accuracy.wrong, bound.wrong);
    EXPECT_LE(accuracy.missing, bound.missing);
  };
  {
    SCOPED_TRACE("edges");
    check(measured.edges, c.edges);
  }
  SCOPED_TRACE("surfaces");
  check(measured.surfaces, c.surfaces);
}

constexpr SceneKind kRoom = SceneKind::kRoom, kHouse = SceneKind::kHouse;

INSTANTIATE_TEST_SUITE_P(
    Scenes, RegistrationAccuracy,
    ::testing::Values(
        Case{
            "RoomSame", kRoom, false, kSame, 0.0, {0.929, 0.0297, 0.0008}, {0.997, 0.0001, 0.0001}},
        Case{
            "RoomLens", kRoom, false, kSame, 0.1, {0.908, 0.0416, 0.0009}, {0.996, 0.0001, 0.0001}},
        Case{"RoomLarge",
             kRoom,
             false,
             kLarge,
             0.0,
             {0.937, 0.0350, 0.0008},
             {0.996, 0.0001, 0.0001}},
        Case{"RoomLargeLens",
             kRoom,
             true,
             kLarge,
             0.1,
             {0.585, 0.0086, 0.3203},
             {0.948, 0.0001, 0.0090}},
        Case{"HouseSmall",
             kHouse,
             false,
             kSmall,
             0.0,
             {0.946, 0.0332, 0.0062},
             {0.999, 0.0001, 0.0001}},
        Case{"HouseSame",
             kHouse,
             true,
             kSame,
             0.0,
             {0.435, 0.0469, 0.4270},
             {0.762, 0.0001, 0.1857}},
        Case{"HouseLarge",
             kHouse,
             true,
             kLarge,
             0.0,
             {0.411, 0.0481, 0.4481},
             {0.763, 0.0001, 0.1831}}),
    [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace msc_vo
