// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <set>
#include <stdexcept>

#include "tests/support/custom_pose_factors.h"
#include "tests/support/custom_window_factors.h"
#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::HasSubstr;

// Images with simulated wheels.
class CustomFactorsTest : public RoomTest {
 protected:
  static constexpr double kScale = 1.07;  // metres per metre that the wheels measure

  // The true motion between two frames.
  static Rigid3 Step(double from, double to) {
    const auto pose_at = [](double timestamp) {
      for (const TimedPose& pose : *truth_) {
        if (std::abs(pose.timestamp - timestamp) < 1e-6) return pose.world_from_cam;
      }
      throw std::runtime_error("no image at this time");
    };
    return pose_at(to).Inverse() * pose_at(from);
  }
  // Wheels that measure `ratio` of the true path.
  static PoseFactorCallback Wheels(double ratio) {
    return [ratio](const FrameContext& context) {
      Rigid3 step = Step(context.last_timestamp, context.timestamp);
      step = Rigid3(step.rotation(), ratio * step.translation());
      const double path = step.translation().norm();
      return std::vector<PoseFactor>{
          PriorFactor("wheel", step * context.last_cam_from_world, 0.01, 0.002 + 0.05 * path)};
    };
  }
  static WindowFactors WindowWheels(const WindowContext& context) {
    WindowFactors custom;
    custom.extra_blocks = {Scalar(0, 1.0)};
    for (size_t i = 1; i < context.keyframes.size(); ++i) {
      const WindowContext::Keyframe& a = context.keyframes[i - 1];
      const WindowContext::Keyframe& b = context.keyframes[i];
      const Rigid3 step = Step(a.timestamp, b.timestamp);
      custom.factors.push_back(
          WheelStep(a.id, b.id, {step.rotation(), step.translation() / kScale}, 0.002, 0.001));
    }
    return custom;
  }

  static OdometryResult Run(const std::vector<RgbdImage>& images,
                            const PoseFactorCallback& pose_factors,
                            const WindowFactorCallback& window_factors, int threads = 2) {
    OdometryOptions options;
    options.threads = threads;
    Odometry odometry(options, camera_, LensDistortion());
    if (pose_factors) odometry.SetPoseFactors(pose_factors);
    if (window_factors) odometry.SetWindowFactors(window_factors);
    for (const RgbdImage& image : images) odometry.Process(image);
    return odometry.Finish();
  }
  static std::vector<RgbdImage> CoveredSecond() {
    std::vector<RgbdImage> images = *images_;
    for (int i = 20; i < 50; ++i) Cover(&images[i]);
    return images;
  }
};

TEST_F(CustomFactorsTest, WheelsBridgeACoveredSecond) {
  const std::vector<RgbdImage> images = CoveredSecond();
  const OdometryResult without = Run(images, nullptr, nullptr);
  const OdometryResult with = Run(images, Wheels(0.98), nullptr);
  for (int i = 20; i < 50; ++i) {
    EXPECT_EQ(with.frames[i].status, TrackingStatus::kPredicted) << i;
    EXPECT_TRUE(with.frames[i].by_pose_factors) << i;
    ASSERT_TRUE(with.frames[i].covariance.has_value()) << i;
    EXPECT_GT((*with.frames[i].covariance)(5, 5), 0.0) << i;
    EXPECT_FALSE(without.frames[i].by_pose_factors) << i;
  }
  EXPECT_TRUE(IsEstimated(with.frames[50].status));
  EXPECT_FALSE(with.frames[50].by_pose_factors);
  EXPECT_LT(ApeRmse(with), 0.5 * ApeRmse(without));  // measured: 1.8 mm and 4.8 mm
  EXPECT_LT(ApeRmse(with), 0.005);
}

TEST_F(CustomFactorsTest, WindowFactorsRecoverTheScaleOfTheWheels) {
  const OdometryResult result = Run(*images_, nullptr, WindowWheels);
  ASSERT_EQ(result.extra_blocks.size(), 1u);
  EXPECT_EQ(result.extra_blocks[0].id, 0);
  EXPECT_NEAR(result.extra_blocks[0].value[0], kScale, 0.02);  // measured: 1.072
  EXPECT_LT(ApeRmse(result), 0.006);
  EXPECT_TRUE(Run(*images_, nullptr, nullptr).extra_blocks.empty());
}

TEST_F(CustomFactorsTest, AreDeterministicAtAnyThreadCount) {
  const std::vector<RgbdImage> images = CoveredSecond();
  const OdometryResult one = Run(images, Wheels(0.98), WindowWheels, 1);
  const OdometryResult two = Run(images, Wheels(0.98), WindowWheels, 2);
  ExpectSameBytes(one, two);
  ASSERT_EQ(one.extra_blocks.size(), 1u);
  EXPECT_EQ(one.extra_blocks[0].value, two.extra_blocks.at(0).value);
}

TEST_F(CustomFactorsTest, WithoutFactorsChangeNothing) {
  const OdometryResult plain = Run(*images_, nullptr, nullptr);
  ExpectSameBytes(plain,
                  Run(
                      *images_, [](const FrameContext&) { return std::vector<PoseFactor>(); },
                      [](const WindowContext&) { return WindowFactors(); }));
}

TEST_F(CustomFactorsTest, ErrorsOfWindowFactorsReachTheCaller) {
  for (const int threads : {1, 2}) {
    OdometryOptions options;
    options.threads = threads;
    Odometry odometry(options, camera_, LensDistortion());
    int window = 0;
    odometry.SetWindowFactors([&](const WindowContext& context) {
      WindowFactors custom;
      ++window;
      if (window == 1) throw std::runtime_error("no wheel data");
      if (window == 2) {
        custom.factors = {{"marker", nullptr, nullptr, {BlockId::Pose(context.keyframes[0].id)}}};
      }
      return custom;
    });
    std::vector<std::string> errors;
    for (const RgbdImage& image : *images_) {
      try {
        odometry.Process(image);
      } catch (const std::exception& error) {
        errors.emplace_back(error.what());
      }
    }
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0], "no wheel data");
    EXPECT_THAT(errors[1], HasSubstr("marker"));
    EXPECT_EQ(odometry.Finish().frames.size(), images_->size());
  }
}

// Wheels whose scale the windows estimate: the extra block is that of the map that a frame is
// tracked in, at any number of threads.
TEST_F(CustomFactorsTest, PoseFactorsSeeTheExtraBlocksOfTheirMap) {
  const std::vector<RgbdImage> images = CoveredSecond();
  const auto run = [&](int threads, double latency, std::vector<double>* scales) {
    OdometryOptions options;
    options.threads = threads;
    options.snapshots.latency = latency;
    Odometry odometry(options, camera_, LensDistortion());
    odometry.SetWindowFactors(WindowWheels);
    odometry.SetPoseFactors([&](const FrameContext& context) {
      scales->push_back(context.extra_blocks.empty() ? 1.0 : context.extra_blocks[0].value[0]);
      const Rigid3 step = Step(context.last_timestamp, context.timestamp);
      const Rigid3 measured(step.rotation(), scales->back() / kScale * step.translation());
      const double path = step.translation().norm();
      return std::vector<PoseFactor>{
          PriorFactor("wheel", measured * context.last_cam_from_world, 0.01, 0.002 + 0.05 * path)};
    });
    std::vector<double> in_map;  // of the same frames
    odometry.SetTrackingObserver([&](const TrackedImage& image) {
      const std::vector<ExtraBlock>& blocks = image.map.extra_blocks;
      if (image.result.id > 0) in_map.push_back(blocks.empty() ? 1.0 : blocks[0].value[0]);
    });
    for (const RgbdImage& image : images) odometry.Process(image);
    EXPECT_EQ(*scales, in_map);
    return odometry.Finish();
  };
  for (const double latency : {0.0, 0.085}) {
    std::vector<double> one, two;
    const OdometryResult result = run(1, latency, &one);
    ExpectSameBytes(run(2, latency, &two), result);
    EXPECT_EQ(one, two);
    EXPECT_EQ(one.front(), 1.0);
    EXPECT_NEAR(one.back(), kScale, 0.05);
    // Before the first window, and after several ones.
    EXPECT_GE(std::set<double>(one.begin(), one.end()).size(), 3u);
    EXPECT_TRUE(result.frames[40].by_pose_factors);
  }
}

}  // namespace
}  // namespace msc_vo
