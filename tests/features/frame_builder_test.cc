// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/frame_builder.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <stdexcept>

#include "tests/features/depth_images.h"
#include "tests/features/distortion.h"
#include "tests/features/drawing.h"
#include "tests/support/lenses.h"
#include <gtest/gtest.h>

#include "msc_vo/camera/undistorted_camera.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

PinholeCamera Camera() { return {480.0, -480.0, 319.5, 239.5, 640, 480}; }

// Inverse depth of a slanted wall, 1.6 to 2.6 m away.
double Wall(const Vector2d& x) { return 0.5 + 0.0003 * (x.x() - 320.0) + 0.0001 * (x.y() - 240.0); }

// A poster of quadrilaterals on the wall.
RgbdImage Poster(const PinholeCamera& camera) {
  RgbdImage image;
  image.id = 17;
  image.timestamp = 4.25;
  image.gray = testing::DrawQuadrilaterals(camera.width, camera.height, {0.0, 0.0}, 0.0, 2.0);
  image.depth = testing::DrawDepth(camera, Wall);
  return image;
}

void ExpectSame(const Frame& a, const Frame& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].pixel, b.points[i].pixel);
    EXPECT_EQ(a.points[i].inverse_depth, b.points[i].inverse_depth);
    EXPECT_EQ(a.points[i].descriptor, b.points[i].descriptor);
  }
  for (size_t i = 0; i < a.lines.size(); ++i) {
    EXPECT_EQ(a.lines[i].segment.start, b.lines[i].segment.start);
    EXPECT_EQ(a.lines[i].segment.end, b.lines[i].segment.end);
    EXPECT_EQ(a.lines[i].descriptor, b.lines[i].descriptor);
    ASSERT_EQ(a.lines[i].depth.has_value(), b.lines[i].depth.has_value());
    if (!a.lines[i].depth) continue;
    EXPECT_EQ(a.lines[i].depth->start, b.lines[i].depth->start);
    EXPECT_EQ(a.lines[i].depth->covariance, b.lines[i].depth->covariance);
  }
}

TEST(FrameBuilder, BuildsFrameWithPointsLinesAndDepth) {
  FrameBuilder builder(FrameBuilderOptions(), Camera(), LensDistortion());
  const Frame frame = builder.Build(Poster(Camera()));
  EXPECT_EQ(frame.id, 17);
  EXPECT_EQ(frame.timestamp, 4.25);
  EXPECT_EQ(frame.camera.fy, -480.0);
  EXPECT_GT(frame.points.size(), 500u);
  EXPECT_GT(frame.lines.size(), 50u);
  for (const PointFeature& point : frame.points) {
    ASSERT_TRUE(point.HasDepth());
    EXPECT_NEAR(point.inverse_depth, Wall(point.pixel), 3e-4);
    EXPECT_NEAR(point.sigma, SensorNoiseOptions().point_sigma * std::pow(1.2, point.level), 1e-9);
    EXPECT_GT(point.inverse_depth_sigma, 1e-3);
  }
  for (const LineFeature& line : frame.lines) {
    ASSERT_TRUE(line.depth);
    EXPECT_NEAR(line.depth->start, Wall(line.segment.start), 1e-3);
    EXPECT_NEAR(line.depth->end, Wall(line.segment.end), 1e-3);
  }
  const Eigen::Vector2d center = DepthRanges::CellCenter(frame.camera, 10, 5);
  EXPECT_LE(frame.depth_ranges.At(10, 5).min_inverse_depth, Wall(center));
  EXPECT_GE(frame.depth_ranges.At(10, 5).max_inverse_depth, Wall(center));
  EXPECT_NEAR(frame.depth_ranges.At(10, 5).min_inverse_depth, Wall(center), 0.02);
  // The grid indexes the points.
  const std::vector<int> near = frame.grid.Near(frame.points, frame.points[5].pixel, 1.0);
  EXPECT_NE(std::find(near.begin(), near.end(), 5), near.end());
  EXPECT_GT(builder.times().points, 0.0);
  EXPECT_GT(builder.times().lines, 0.0);
  EXPECT_GT(builder.times().depth, 0.0);
}

TEST(FrameBuilder, AppliesOptions) {
  FrameBuilderOptions options;
  options.points.num_points = 100;
  options.lines.max_lines = 10;
  options.noise.point_sigma = 0.5;
  options.noise.line_sigma = 0.25;
  options.max_depth = 2.0;
  options.line_depth = LineDepthMethod::kEndPoints;
  FrameBuilder builder(options, Camera(), LensDistortion());
  const Frame frame = builder.Build(Poster(Camera()));
  EXPECT_LE(frame.points.size(), 100u);
  EXPECT_GT(frame.points.size(), 70u);
  ASSERT_EQ(frame.lines.size(), 10u);
  bool without_depth = false;
  for (const PointFeature& point : frame.points) {
    EXPECT_NEAR(point.sigma, 0.5 * std::pow(1.2, point.level), 1e-9);
    without_depth |= !point.HasDepth();
    if (point.HasDepth()) {
      EXPECT_GT(point.inverse_depth, 0.49);
    }
  }
  EXPECT_TRUE(without_depth);
  for (const LineFeature& line : frame.lines) {
    EXPECT_EQ(line.sigma, 0.25);
    if (line.depth) {
      EXPECT_EQ(line.depth->num_inliers, 2);
    }
  }
}

TEST(FrameBuilder, CropsWideImages) {
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  CropToFieldOfView(90.0, &lens, &camera);
  const RgbdImage ideal = Poster(camera);
  RgbdImage raw = ideal;
  raw.gray = testing::DistortImage(camera, lens, ideal.gray);
  raw.depth = testing::DrawDepth(
      *lens.recorded, [&](const Vector2d& pixel) { return Wall(lens.Undistort(camera, pixel)); });
  const Frame frame = FrameBuilder(FrameBuilderOptions(), camera, lens).Build(raw);
  EXPECT_EQ(frame.camera.fx, camera.fx);
  ASSERT_TRUE(frame.lens.has_value());
  EXPECT_GT(frame.points.size(), 400u);
  EXPECT_GT(frame.lines.size(), 40u);
  double smallest = 1e9, largest = 0.0;
  for (const PointFeature& point : frame.points) {
    EXPECT_TRUE(camera.IsInside(point.pixel));
    if (point.HasDepth()) {
      EXPECT_NEAR(point.inverse_depth, Wall(point.pixel), 1e-3);
    }
    const double sigma = point.sigma / std::pow(1.2, point.level);
    smallest = std::min(smallest, sigma);
    largest = std::max(largest, sigma);
  }
  // A recorded pixel covers more of the undistorted image at its borders than in the middle.
  const double middle = SensorNoiseOptions().point_sigma * camera.fx / lens.recorded->fx;
  EXPECT_NEAR(smallest, middle, 0.05 * middle);
  EXPECT_GT(largest, 1.5 * smallest);
  // The edges of the poster are straight.
  const Frame expected = FrameBuilder(FrameBuilderOptions(), camera, LensDistortion()).Build(ideal);
  const auto has_line = [&](const LineFeature& line) {
    return std::any_of(expected.lines.begin(), expected.lines.end(), [&](const LineFeature& other) {
      return other.segment.DistanceToLine(line.segment.start) < 0.5 &&
             other.segment.DistanceToLine(line.segment.end) < 0.5 &&
             (line.segment.Midpoint() - other.segment.Midpoint()).norm() < 20.0;
    });
  };
  EXPECT_GT(std::count_if(frame.lines.begin(), frame.lines.end(), has_line),
            static_cast<int>(frame.lines.size()) * 6 / 10);
}

TEST(FrameBuilder, UndistortsPointsLinesAndTheirDepth) {
  PinholeCamera camera = testing::Freiburg1Camera();
  const LensDistortion distortion = testing::Freiburg1Distortion();
  const RgbdImage ideal = Poster(camera);
  RgbdImage raw = ideal;
  raw.gray = testing::DistortImage(camera, distortion, ideal.gray);
  raw.depth = testing::DistortImage(camera, distortion, ideal.depth, cv::INTER_LINEAR);
  const Frame expected = FrameBuilder(FrameBuilderOptions(), camera, LensDistortion()).Build(ideal);
  const Frame frame = FrameBuilder(FrameBuilderOptions(), camera, distortion).Build(raw);
  // Most points and lines are also detected in the undistorted image, at the same positions.
  const auto has_point = [&](const PointFeature& point) {
    for (const int i : expected.grid.Near(expected.points, point.pixel, 0.7 * point.sigma)) {
      if (HammingDistance(expected.points[i].descriptor, point.descriptor) < 64) return true;
    }
    return false;
  };
  EXPECT_GT(std::count_if(frame.points.begin(), frame.points.end(), has_point),
            static_cast<int>(frame.points.size()) * 6 / 10);
  const auto has_line = [&](const LineFeature& line) {
    return std::any_of(expected.lines.begin(), expected.lines.end(), [&](const LineFeature& other) {
      return (line.segment.start - other.segment.start).norm() < 3.0 &&
             (line.segment.end - other.segment.end).norm() < 3.0 &&
             other.segment.DistanceToLine(line.segment.Midpoint()) < 0.3;
    });
  };
  EXPECT_GT(std::count_if(frame.lines.begin(), frame.lines.end(), has_line),
            static_cast<int>(frame.lines.size()) * 6 / 10);
  for (const PointFeature& point : frame.points) {
    if (point.HasDepth()) {
      EXPECT_NEAR(point.inverse_depth, Wall(point.pixel), 1e-3);
    }
  }
  for (const LineFeature& line : frame.lines) {
    if (line.depth) {
      EXPECT_NEAR(line.depth->start, Wall(line.segment.start), 2e-3);
    }
  }
}

TEST(FrameBuilder, IsDeterministicAtAnyThreadCount) {
  const RgbdImage image = Poster(Camera());
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  FrameBuilder builder({}, Camera(), LensDistortion());
  const Frame a = builder.Build(image);
  const Frame b = builder.Build(image);
  cv::setNumThreads(2);
  const Frame c = FrameBuilder({}, Camera(), LensDistortion()).Build(image);
  cv::setNumThreads(threads);
  ExpectSame(a, b);
  ExpectSame(a, c);
}

TEST(FrameBuilder, IsIndependentOfTaskOrder) {
  FrameBuilder builder({}, Camera(), LensDistortion());
  const Frame sequential = builder.Build(Poster(Camera()));
  ExpectSame(sequential, builder.Build(Poster(Camera()), [](const Tasks& tasks) {
    for (auto task = tasks.rbegin(); task != tasks.rend(); ++task) (*task)();
  }));
  ExpectSame(sequential, builder.Build(Poster(Camera()), [](const Tasks& tasks) {
    std::vector<std::future<void>> running;
    for (const auto& task : tasks) running.push_back(std::async(std::launch::async, task));
  }));
}

TEST(FrameBuilder, AcceptsImagesWithoutDepthOrContrast) {
  FrameBuilder builder({}, Camera(), LensDistortion());
  RgbdImage image = Poster(Camera());
  for (const float invalid : {0.0f, std::numeric_limits<float>::quiet_NaN(), 100.0f}) {
    image.depth.setTo(invalid);
    const Frame frame = builder.Build(image);
    EXPECT_GT(frame.points.size(), 500u);
    for (const PointFeature& point : frame.points) EXPECT_FALSE(point.HasDepth());
    for (const LineFeature& line : frame.lines) EXPECT_FALSE(line.depth);
  }
  for (const int gray : {0, 128}) {
    image.gray.setTo(gray);
    const Frame frame = builder.Build(image);
    EXPECT_TRUE(frame.points.empty());
    EXPECT_TRUE(frame.lines.empty());
    EXPECT_TRUE(frame.grid.Near(frame.points, Vector2d(100, 100), 50.0).empty());
  }
}

TEST(FrameBuilder, ExtractsFeaturesFromSmallImages) {
  const PinholeCamera camera{120.0, 120.0, 79.5, 59.5, 160, 120};
  FrameBuilder builder({}, camera, testing::Freiburg1Distortion());
  const Frame frame = builder.Build(Poster(camera));
  EXPECT_GT(frame.points.size(), 20u);
  EXPECT_GT(frame.lines.size(), 5u);
}

TEST(FrameBuilder, ThrowsOnMismatchedImage) {
  FrameBuilder builder({}, Camera(), LensDistortion());
  RgbdImage image = Poster(Camera());
  image.depth.convertTo(image.depth, CV_16UC1, 1000.0);
  EXPECT_THROW(builder.Build(image), std::invalid_argument);
  image = Poster(Camera());
  image.gray = image.gray.rowRange(0, 400);
  EXPECT_THROW(builder.Build(image), std::invalid_argument);
  image = Poster(Camera());
  image.depth = cv::Mat();
  EXPECT_THROW(builder.Build(image), std::invalid_argument);
}

TEST(FrameBuilder, ThrowsOnInvalidCamera) {
  PinholeCamera camera = Camera();
  camera.fx = 0.0;
  EXPECT_THROW(FrameBuilder({}, camera, LensDistortion()), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
