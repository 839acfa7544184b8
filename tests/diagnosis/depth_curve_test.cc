// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_curve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "msc_vo/diagnosis/sequence_findings.h"

namespace msc_vo {
namespace {

using testing::Not;
using testing::StartsWith;

// Of raw values, per metre.
constexpr double kScale = 1000.0;
constexpr int kNumFrames = 4;
const PinholeCamera kCamera{130.0, 130.0, 79.5, 59.5, 160, 120};

// What an image holds instead of a depth (metres) along the viewing ray through a point of the
// plane z = 1, in raw units.
using Encoding = std::function<double(double depth, const Eigen::Vector2d& ray)>;

double Depth(double depth, const Eigen::Vector2d&) { return kScale * depth; }
double RayLength(double depth, const Eigen::Vector2d& ray) {
  return kScale * depth * ray.homogeneous().norm();
}

// The distance to a surface from the middle of the room along a direction.
using Surface = std::function<double(const Eigen::Vector3d& direction)>;

// A room with flat walls.
double Box(const Eigen::Vector3d& direction) {
  const Eigen::Array3d half_size(3.0, 1.4, 2.2);
  return (half_size / direction.array().abs()).minCoeff();
}
// The inside of a bag of balls: surfaces that bend in all ways.
double Bumps(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = direction.normalized();
  return (2.0 + 0.15 * std::sin(9.0 * d.x()) * std::cos(11.0 * d.y() + 1.0) +
          0.1 * std::sin(14.0 * d.z() + 2.0 * d.x())) /
         direction.norm();
}

struct DepthScene {
  Surface surface = Box;
  LensDistortion lens = {};
  double inverse_depth_noise = 0.0;  // standard deviation, 1/metres
};

// What the images are said to be of, if that is not the truth.
struct Description {
  PinholeCamera camera = kCamera;
  std::optional<LensDistortion> lens;
};

// Depth images from the middle of the room, whose values are encoded, with rounding to raw units.
DepthCurveTest Observe(const DepthScene& scene, const Encoding& encode,
                       const Description& given = {}) {
  DepthCurveTest test(given.camera, given.lens.value_or(scene.lens), kScale);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, scene.inverse_depth_noise);
  for (int i = 0; i < kNumFrames; ++i) {
    const Eigen::Matrix3d rotation =
        (Eigen::AngleAxisd(0.9 * i + 0.3, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.35 * std::sin(2.0 * i + 0.5), Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    cv::Mat depth(kCamera.height, kCamera.width, CV_32FC1);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        const Eigen::Vector2d ray =
            scene.lens.UndistortNormalized(kCamera.Ray({x, y}).head<2>(), 1e-9);
        // The direction has z = 1 in the camera, so that the distance along it is the depth.
        const double z = scene.surface(rotation * ray.homogeneous());
        const double value = std::round(encode(1.0 / (1.0 / z + noise(random)), ray));
        depth.at<float>(y, x) = static_cast<float>(std::clamp(value, 0.0, 65535.0) / kScale);
      }
    }
    test.Add(depth);
  }
  return test;
}

std::string Verdict(const DepthCurveTest& test) {
  Findings findings;
  AddDepthCurveFindings(test, &findings);
  return Text(findings);
}

TEST(DepthCurve, IsDepth) {
  for (const double noise : {0.0, 0.002}) {
    const DepthCurveTest test = Observe({Box, {}, noise}, Depth);
    EXPECT_TRUE(test.OfInverse().ProveDepth()) << noise;
    EXPECT_FALSE(test.Best().ProveCurve()) << noise;
    EXPECT_THAT(Verdict(test), Names("ok", "disparity"));
  }
}

struct Case {
  DepthCurve curve;
  NamesMatcher names;
  Encoding encode;
};

std::vector<Case> Cases() {
  const double log_scale = 60000.0 / std::log(200.0);
  return {
      {DepthCurve::kInverse, Names("focal length", "baseline", "disparity"),
       [](double z, auto&) { return 20000.0 / z; }},
      {DepthCurve::kInverse, Names("inverse"), [](double z, auto&) { return 4000.0 + 9000.0 / z; }},
      {DepthCurve::kInverse, Names("depth buffer"),
       [](double z, auto&) { return 60000.0 - 9000.0 / z; }},
      {DepthCurve::kInverted, Names("raw units"),
       [](double z, auto&) { return 65535.0 - 9000.0 * z; }},
      {DepthCurve::kInverted, Names("distance 0"),
       [](double z, auto&) { return 8000.0 - 1000.0 * z; }},
      {DepthCurve::kCompressed, Names("square root"),
       [](double z, auto&) { return 9000.0 * std::sqrt(z); }},
      {DepthCurve::kCompressed, Names("logarithm"),
       [log_scale](double z, auto&) { return log_scale * std::log(z / 0.1); }},
      {DepthCurve::kStretched, Names("square"), [](double z, auto&) { return 900.0 * z * z; }},
      {DepthCurve::kRayLength, Names("sqrt"), RayLength},
  };
}

LensDistortion Lens(double k1, double k2 = 0.0) {
  LensDistortion lens;
  lens.k = {k1, k2};
  return lens;
}

TEST(DepthCurve, IsNamed) {
  for (const Case& c : Cases()) {
    for (const double noise : {0.0, 0.001}) {
      const DepthCurveTest test = Observe({Box, {}, noise}, c.encode);
      const std::string verdict = Verdict(test);
      EXPECT_EQ(test.Best().curve, c.curve) << noise << verdict;
      EXPECT_TRUE(test.IsDecided()) << noise << verdict;
      EXPECT_THAT(verdict, c.names);
      // Noise leaves few surfaces, which a lens may explain by chance.
      const bool is_error = verdict.find("error ") != std::string::npos;
      EXPECT_TRUE(is_error || noise > 0.0) << verdict;
    }
  }
}

// An undescribed lens bends planes, too, which is no error of the depth images.
TEST(DepthCurve, IsNoErrorBehindAnUndescribedLens) {
  for (const LensDistortion& lens :
       {Lens(-0.4, 0.1), Lens(-0.28, 0.08), Lens(-0.2), Lens(-0.1), Lens(0.1), Lens(0.2, -0.1)}) {
    for (const double noise : {0.0, 0.002}) {
      const DepthCurveTest test = Observe({Box, lens, noise}, Depth, {kCamera, Lens(0.0)});
      EXPECT_EQ(Verdict(test).find("error"), std::string::npos) << lens.k[0] << Verdict(test);
    }
  }
}

TEST(DepthCurve, IsNoErrorBehindAnUndescribedFisheyeLens) {
  LensDistortion lens;
  lens.model = LensModel::kFisheye;
  const DepthCurveTest test = Observe({Box, lens}, Depth, {kCamera, Lens(0.0)});
  EXPECT_EQ(Verdict(test).find("error"), std::string::npos) << Verdict(test);
}

// Both at once: the curve is at least a warning.
TEST(DepthCurve, IsNamedBehindAnUndescribedLens) {
  for (const Case& c : Cases()) {
    const DepthCurveTest test = Observe({Box, Lens(-0.1)}, c.encode, {kCamera, Lens(0.0)});
    EXPECT_TRUE(test.Best().ProveCurve()) << Verdict(test);
    EXPECT_THAT(Verdict(test), Not(StartsWith("ok")));
  }
}

// Of a camera that is described wrongly, and of one that is described by a lens.
TEST(DepthCurve, IsIndependentOfTheCamera) {
  const LensDistortion lens = Lens(-0.3, 0.08);
  for (const double ratio : {0.8, 1.0, 1.25}) {
    Description given;
    given.camera.fx *= ratio;
    given.camera.fy *= ratio;
    given.camera.cx += 10.0;
    for (const DepthScene& scene : {DepthScene(), DepthScene{Box, lens}}) {
      EXPECT_TRUE(Observe(scene, Depth, given).OfInverse().ProveDepth()) << ratio;
      EXPECT_FALSE(Observe(scene, Depth, given).Best().ProveCurve()) << ratio;
    }
    EXPECT_EQ(Observe({}, RayLength, given).Best().curve, DepthCurve::kRayLength) << ratio;
  }
}

TEST(DepthCurve, IsNotToldByCurvedSurfaces) {
  const DepthCurveTest test = Observe({Bumps}, Depth);
  EXPECT_FALSE(test.Best().ProveCurve()) << Verdict(test);
}

// Images of a wall with an area of inverted depth, which images of other sequences may show by
// chance.
TEST(DepthCurve, IsNotProvenByASingleSurfaceThatAllImagesRepeat) {
  DepthCurveTest test(kCamera, {}, kScale);
  cv::Mat depth(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(2));
  for (int y = 50; y < 70; ++y) {
    for (int x = 70; x < 90; ++x) depth.at<float>(y, x) = 6.0f - 1.0f / (0.5f - 0.012f * (x - 70));
  }
  for (int i = 0; i < 30; ++i) test.Add(depth);
  EXPECT_GT(test.Best().num_curve, 20);
  EXPECT_FALSE(test.Best().ProveCurve()) << Verdict(test);
}

// Matchers with large windows make slopes of the steps between two walls, at other places in each
// image.
TEST(DepthCurve, IsNotProvenBySmoothedDepthEdges) {
  DepthCurveTest test(kCamera, {}, kScale);
  for (int i = 0; i < 30; ++i) {
    cv::Mat depth(kCamera.height, kCamera.width, CV_32FC1);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        const double from_edge = (x + 0.2 * y - 30.0 - 3.0 * i) / 8.0;
        const double step = std::exp(-std::pow(std::max(0.0, 2.0 - from_edge), 2.0));
        depth.at<float>(y, x) =
            static_cast<float>(std::round(kScale * (1.0 + 3.0 * step)) / kScale);
      }
    }
    test.Add(depth);
  }
  EXPECT_FALSE(test.Best().ProveCurve()) << Verdict(test);
}

TEST(DepthCurve, IsNotToldByEmptyOrConstantImages) {
  for (const float value : {0.0f, 2.0f, 65.535f}) {
    DepthCurveTest test(kCamera, {}, kScale);
    EXPECT_FALSE(test.IsDecided());
    for (int i = 0; i < kNumFrames; ++i) test.Add(cv::Mat(120, 160, CV_32FC1, cv::Scalar(value)));
    EXPECT_FALSE(test.IsDecided() && test.Best().ProveCurve()) << value;
    EXPECT_NE(Verdict(test).find("not tested"), std::string::npos) << value << Verdict(test);
  }
}

}  // namespace
}  // namespace msc_vo
