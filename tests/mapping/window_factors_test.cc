// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/window_factors.h"

#include <cmath>
#include <stdexcept>

#include "tests/support/custom_window_factors.h"
#include "tests/support/message_matchers.h"
#include "tests/support/synthetic_keyframes.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/factors/pose_prior.h"

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

Rigid3 Truth(double timestamp) {
  return SyntheticFrames::CamFromWorld(static_cast<int>(std::lround(30.0 * timestamp))) *
         SyntheticFrames::CamFromWorld(0).Inverse();
}

// The true motion between consecutive keyframes, with translations divided by `scale`.
std::vector<CustomFactor> WheelSteps(const WindowContext& context, double scale) {
  std::vector<CustomFactor> factors;
  for (size_t i = 1; i < context.keyframes.size(); ++i) {
    const WindowContext::Keyframe& a = context.keyframes[i - 1];
    const WindowContext::Keyframe& b = context.keyframes[i];
    const Rigid3 step = Truth(b.timestamp) * Truth(a.timestamp).Inverse();
    factors.push_back(
        WheelStep(a.id, b.id, {step.rotation(), step.translation() / scale}, 0.002, 0.002));
  }
  return factors;
}

// x coordinates of points, metres, against that of a plane; sigma 1 mm.
template <int Points>
struct OnPlaneFactor : CostFunctor<OnPlaneFactor<Points>, Points, 3 * Points> {
  explicit OnPlaneFactor(double x_in) : x(x_in) {}

  template <typename T>
  bool operator()(const T* points, T* residuals) const {
    for (int k = 0; k < Points; ++k) residuals[k] = (points[3 * k] - x) / 0.001;
    return true;
  }

  double x;
};

class WindowFactorsTest : public ::testing::Test {
 protected:
  MappingSummary Process(int index) { return ProcessKeyframe(&world_, index, &random_, &mapper_); }

  SyntheticFrames world_{SyntheticFrames::Options()};
  std::mt19937 random_{1};
  Mapper mapper_{MapperOptions()};
};

TEST_F(WindowFactorsTest, ContextDescribesTheWindow) {
  std::vector<WindowContext> contexts;
  std::vector<WindowData> windows;
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    contexts.push_back(context);
    return WindowFactors();
  });
  mapper_.SetWindowObserver([&](KeyframeId, const BundleAdjustmentOptions&,
                                const WindowData& window) { windows.push_back(window); });
  for (int index = 0; index <= 200; index += 10) Process(index);
  ASSERT_EQ(contexts.size(), 20u);  // one keyframe makes no window
  ASSERT_EQ(windows.size(), 20u);
  for (size_t i = 0; i < contexts.size(); ++i) {
    ASSERT_EQ(contexts[i].keyframes.size(), windows[i].keyframes.size());
    for (size_t k = 1; k < contexts[i].keyframes.size(); ++k) {
      EXPECT_LT(contexts[i].keyframes[k - 1].timestamp, contexts[i].keyframes[k].timestamp);
      EXPECT_LT(contexts[i].keyframes[k - 1].id, contexts[i].keyframes[k].id);
    }
    EXPECT_NEAR(contexts[i].keyframes.back().timestamp, (i + 1) / 3.0, 1e-9);
    EXPECT_FALSE(contexts[i].keyframes.back().fixed);
    EXPECT_EQ(contexts[i].world_from_axes.has_value(), windows[i].axes.has_value());
    EXPECT_TRUE(windows[i].extra_blocks.empty());
  }
  const Keyframe& newest = mapper_.map().keyframes().back().second;
  EXPECT_EQ(contexts.back().keyframes.back().id, newest.id);
  ASSERT_TRUE(contexts.back().world_from_axes.has_value());  // the box
  EXPECT_TRUE(windows.back().axes->fixed);
}

// What the solver gets, apart from what the callback adds.
TEST_F(WindowFactorsTest, ContextContainsTheLandmarksOfTheWindow) {
  std::vector<WindowData> seen, solved;
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    seen.push_back(*context.data);
    for (const WindowData::Point& point : context.data->points) {
      EXPECT_EQ(context.FindPoint(point.id), &point);
      EXPECT_EQ(mapper_.map().Find<PointLandmark>(point.id)->position, point.position);
    }
    for (const WindowData::Line& line : context.data->lines) {
      EXPECT_EQ(context.FindLine(line.id), &line);
    }
    EXPECT_EQ(context.FindPoint(1000000), nullptr);
    EXPECT_EQ(context.FindLine(-1), nullptr);
    return WindowFactors();
  });
  mapper_.SetWindowObserver([&](KeyframeId, const BundleAdjustmentOptions&,
                                const WindowData& window) { solved.push_back(window); });
  for (int index = 0; index <= 60; index += 10) Process(index);
  ASSERT_EQ(seen.size(), 6u);
  ASSERT_EQ(solved.size(), seen.size());
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_GT(seen[i].points.size(), 20u);
    ASSERT_EQ(seen[i].points.size(), solved[i].points.size());
    ASSERT_EQ(seen[i].lines.size(), solved[i].lines.size());
    EXPECT_EQ(seen[i].point_observations.size(), solved[i].point_observations.size());
    EXPECT_EQ(seen[i].line_observations.size(), solved[i].line_observations.size());
    EXPECT_TRUE(seen[i].custom_factors.empty());
  }
  EXPECT_EQ(WindowContext().FindPoint(0), nullptr);
}

// Pulls all landmarks of a window onto the plane at `x`.
WindowFactors OnPlane(const WindowContext& context, double x) {
  WindowFactors custom;
  for (const WindowData::Point& point : context.data->points) {
    custom.factors.push_back(
        {"point on plane", OnPlaneFactor<1>::CreateShared(x), nullptr, {BlockId::Point(point.id)}});
  }
  for (const WindowData::Line& line : context.data->lines) {
    custom.factors.push_back(
        {"line on plane", OnPlaneFactor<2>::CreateShared(x), nullptr, {BlockId::Line(line.id)}});
  }
  return custom;
}

// The wrong plane, so that only the factors can have moved the landmarks.
TEST_F(WindowFactorsTest, LandmarkFactorsActInEveryWindow) {
  int num_windows = 0;
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    ++num_windows;
    return OnPlane(context, 0.3);
  });
  mapper_.SetWindowObserver(
      [&](KeyframeId, const BundleAdjustmentOptions&, const WindowData& window) {
        EXPECT_EQ(window.custom_factors.size(), window.points.size() + window.lines.size());
      });
  for (int index = 0; index <= 60; index += 10) {
    const MappingSummary summary = Process(index);
    if (index == 0) continue;
    ASSERT_TRUE(summary.window && summary.window->usable) << index;
    EXPECT_LT(summary.window->custom.final_cost, 0.1 * summary.window->custom.initial_cost);
  }
  EXPECT_EQ(num_windows, 6);
}

TEST_F(WindowFactorsTest, AnAbsentLandmarkIsNamed) {
  mapper_.SetWindowFactors([](const WindowContext&) {
    return WindowFactors{{},
                         {{"corner of the marker",
                           OnPlaneFactor<1>::CreateShared(0.0),
                           nullptr,
                           {BlockId::Point(4711)}}}};
  });
  Process(0);
  try {
    Process(10);
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), Names("'corner of the marker'", "point 4711"));
  }
}

TEST_F(WindowFactorsTest, ACallbackWithoutFactorsChangesNothing) {
  std::mt19937 random(1);
  SyntheticFrames world{SyntheticFrames::Options()};
  Mapper plain{MapperOptions()};
  mapper_.SetWindowFactors([](const WindowContext&) { return WindowFactors(); });
  for (int index = 0; index <= 60; index += 10) {
    Process(index);
    ProcessKeyframe(&world, index, &random, &plain);
  }
  for (const auto& [id, keyframe] : plain.map().keyframes()) {
    EXPECT_EQ(keyframe.cam_from_world.params, mapper_.map().CamFromWorld(id).params) << id;
  }
}

TEST_F(WindowFactorsTest, RecoverTheScaleOfTheWheels) {
  std::vector<double> scales;  // before each window
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    if (!context.extra_blocks.empty()) scales.push_back(context.extra_blocks[0].value[0]);
    return WindowFactors{{Scalar(0, 1.0)}, WheelSteps(context, 1.07)};
  });
  for (int index = 0; index <= 100; index += 10) Process(index);
  // The path is 0.9 m long, and the windows know their keyframes to about a millimetre.
  ASSERT_EQ(scales.size(), 9u);  // each window starts from the estimate of the one before
  EXPECT_NEAR(scales.back(), 1.07, 0.01);
  const std::vector<ExtraBlock> blocks = mapper_.extra_blocks();
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].id, 0);
  EXPECT_NEAR(blocks[0].value[0], 1.07, 0.01);
}

TEST_F(WindowFactorsTest, ExtraBlocksPersistById) {
  int window = 0;
  std::vector<std::vector<double>> known;
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    known.emplace_back();
    for (const ExtraBlock& block : context.extra_blocks) known.back().push_back(block.value[0]);
    WindowFactors custom;
    custom.extra_blocks = {Scalar(7, 100.0 + window)};
    custom.extra_blocks[0].fixed = true;
    if (window != 1) custom.extra_blocks.insert(custom.extra_blocks.begin(), Scalar(0, 1.0));
    if (window != 1) custom.factors = WheelSteps(context, 1.07);
    ++window;
    return custom;
  });
  for (int index = 0; index <= 30; index += 10) Process(index);
  ASSERT_EQ(known.size(), 3u);
  EXPECT_TRUE(known[0].empty());
  ASSERT_EQ(known[1].size(), 2u);
  EXPECT_EQ(known[1][1], 100.0);
  EXPECT_NE(known[1][0], 1.0);
  EXPECT_EQ(known[2], known[1]);  // the second window did not use the scale; a value is kept
  EXPECT_EQ(mapper_.extra_blocks()[1].value[0], 100.0);
}

TEST_F(WindowFactorsTest, ErrorsNameTheFactorAndKeepTheEstimates) {
  int window = 0;
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    ++window;
    WindowFactors custom{{Scalar(0, 1.0)}, WheelSteps(context, 1.07)};
    if (window == 2) throw std::runtime_error("no wheel data");
    if (window == 3) custom.factors.push_back({"marker", nullptr, nullptr, {BlockId::Pose(0)}});
    if (window == 4) custom.extra_blocks[0].value = Eigen::VectorXd::Zero(2);
    return custom;
  });
  const auto message = [&](int index) {
    try {
      Process(index);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  EXPECT_EQ(message(0), "nothing was thrown");
  EXPECT_EQ(message(10), "nothing was thrown");
  const double scale = mapper_.extra_blocks().at(0).value[0];
  EXPECT_EQ(message(20), "no wheel data");
  EXPECT_THAT(message(30), Names("'marker'", "null"));
  EXPECT_THAT(message(40), Names("extra block 0", "size", "2", "1"));
  EXPECT_EQ(mapper_.extra_blocks().at(0).value[0], scale);
  EXPECT_EQ(message(50), "nothing was thrown");
}

// Keyframes before and after a gap in which the map was left: two worlds.
class GapTest : public WindowFactorsTest {
 protected:
  GapTest() : other_world_(OtherOptions()) {}
  static SyntheticFrames::Options OtherOptions() {
    SyntheticFrames::Options options;
    options.seed = 5;
    return options;
  }
  MappingSummary ProcessOther(int index) {
    return ProcessKeyframe(&other_world_, index, &random_, &mapper_);
  }
  static double ErrorOf(const Map& map, KeyframeId id) {
    return PositionError(map.CamFromWorld(id), Truth(map.FindKeyframe(id)->frame->timestamp));
  }
  SyntheticFrames other_world_;
};

TEST_F(GapTest, FactorsLinkKeyframesThatShareNoLandmarks) {
  std::vector<int64_t> ids;
  mapper_.SetWindowFactors([&](const WindowContext& context) {
    ids.clear();
    for (const WindowContext::Keyframe& keyframe : context.keyframes) ids.push_back(keyframe.id);
    WindowFactors custom{{Scalar(0, 1.0)}, WheelSteps(context, 1.0)};
    custom.extra_blocks[0].fixed = true;
    return custom;
  });
  for (int index = 0; index <= 40; index += 10) Process(index);
  KeyframePacket packet = Packet(&other_world_, 80, &random_);
  packet.cam_from_reference =
      Rigid3(Eigen::Quaterniond::Identity(), {0.05, 0.02, 0.0}) * Truth(80 / 30.0);
  const MappingSummary after = mapper_.Process(packet);
  ASSERT_TRUE(after.window && after.window->usable);
  EXPECT_EQ(ids.back(), 5);
  EXPECT_EQ(ids[ids.size() - 2], 4);
  EXPECT_LT(ErrorOf(mapper_.map(), 5), 0.015);  // 54 mm without the factor
  // The next windows keep the link.
  ProcessOther(90);
  EXPECT_THAT(std::vector<int64_t>(ids.end() - 3, ids.end()), ElementsAre(4, 5, 6));
  EXPECT_LT(ErrorOf(mapper_.map(), 6), 0.015);
}

// After the gap, a marker says where the keyframes are; nothing links them to those before it.
TEST_F(GapTest, AbsoluteFactorsMoveKeyframesThatAreNotLinked) {
  mapper_.SetWindowFactors([](const WindowContext& context) {
    WindowFactors custom;
    for (const WindowContext::Keyframe& keyframe : context.keyframes) {
      if (keyframe.id < 5) continue;
      custom.factors.push_back(
          {"marker",
           PosePrior::CreateShared(Truth(keyframe.timestamp), DiagonalPoseCovariance(0.001, 0.001)),
           nullptr,
           {BlockId::Pose(keyframe.id)}});
    }
    return custom;
  });
  for (int index = 0; index <= 40; index += 10) Process(index);
  KeyframePacket packet = Packet(&other_world_, 80, &random_);
  packet.cam_from_reference =
      Rigid3(Eigen::Quaterniond::Identity(), {0.05, 0.02, 0.0}) * Truth(80 / 30.0);
  packet.covariance = IsotropicCovariance(0.02, 0.03);
  mapper_.Process(packet);
  EXPECT_LT(ErrorOf(mapper_.map(), 5), 0.002);  // 54 mm before
}

TEST_F(GapTest, HoldsTheGaugeWithoutALink) {
  bool is_newest_fixed = false;
  mapper_.SetWindowFactors([](const WindowContext&) { return WindowFactors(); });
  mapper_.SetWindowObserver(
      [&](KeyframeId keyframe, const BundleAdjustmentOptions&, const WindowData& window) {
        for (const WindowData::Keyframe& k : window.keyframes) {
          if (k.id == keyframe) is_newest_fixed = k.fixed;
        }
      });
  for (int index = 0; index <= 40; index += 10) Process(index);
  EXPECT_FALSE(is_newest_fixed);
  KeyframePacket packet = Packet(&other_world_, 80, &random_);
  const MappingSummary after = mapper_.Process(packet);
  ASSERT_TRUE(after.window && after.window->usable);
  EXPECT_TRUE(is_newest_fixed);
  EXPECT_EQ(mapper_.map().CamFromWorld(5).params, packet.cam_from_reference.params);
}

}  // namespace
}  // namespace msc_vo
