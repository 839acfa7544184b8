// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <memory>
#include <vector>

#include <gmock/gmock.h>

#include "msc_vo/mapping/window_factors.h"

namespace msc_vo {
namespace {

std::vector<int64_t> FixedKeyframes(const WindowData& window) {
  std::vector<int64_t> fixed;
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    if (keyframe.fixed) fixed.push_back(keyframe.id);
  }
  return fixed;
}

std::vector<int64_t> KeyframesWithPrior(const WindowData& window) {
  std::vector<int64_t> with_prior;
  for (const auto& prior : window.pose_priors) with_prior.push_back(prior.keyframe);
  return with_prior;
}

// The steps of all keyframes are known, except that of keyframe 4.
Map MapWithSteps(int num_keyframes) {
  Map map;
  for (int id = 0; id < num_keyframes; ++id) {
    map.AddKeyframe(std::make_shared<Frame>(), Rigid3());
    if (id != 4) map.SetStepCovariance(id, IsotropicCovariance(0.01, 0.02));
  }
  return map;
}

TEST(FixGaugeOfUnlinkedKeyframes, ConstrainsTheOldestOfEveryGroup) {
  WindowData window;
  for (int id = 0; id < 8; ++id) window.keyframes.push_back({10 + id, Rigid3(), id == 1});
  const auto observe_point = [&](int64_t keyframe, int64_t point) {
    window.point_observations.emplace_back();
    window.point_observations.back().keyframe = keyframe;
    window.point_observations.back().point = point;
  };
  observe_point(10, 1);
  observe_point(11, 1);  // 10 and 11 (fixed)
  observe_point(13, 2);
  observe_point(15, 2);  // 13 and 15
  for (const int64_t keyframe : {12, 16}) {
    window.line_observations.emplace_back();
    window.line_observations.back().keyframe = keyframe;
    window.line_observations.back().line = 2;  // 12 and 16
  }
  window.custom_factors = {
      {"a", nullptr, nullptr, {BlockId::Pose(16), BlockId::Extra(0), BlockId::Pose(10)}},
      {"b", nullptr, nullptr, {BlockId::Extra(0), BlockId::Pose(15)}},
      {"c", nullptr, nullptr, {BlockId::Pose(14)}}};
  FixGaugeOfUnlinkedKeyframes(MapWithSteps(18), &window);
  EXPECT_THAT(FixedKeyframes(window), testing::ElementsAre(11, 17));
  EXPECT_THAT(KeyframesWithPrior(window), testing::ElementsAre(13, 14));
  EXPECT_DOUBLE_EQ(window.pose_priors[0].covariance(0, 0), 0.01 * 0.01);
}

// A factor links keyframes through the landmarks that it is about as well.
TEST(FixGaugeOfUnlinkedKeyframes, FollowsFactorsOnLandmarks) {
  WindowData window;
  for (int id = 0; id < 8; ++id) window.keyframes.push_back({id, Rigid3(), id == 0});
  const auto observe = [&](int64_t keyframe, int64_t point) {
    window.point_observations.emplace_back();
    window.point_observations.back().keyframe = keyframe;
    window.point_observations.back().point = point;
  };
  for (int id = 0; id < 6; ++id) observe(id, 100 + id);
  window.line_observations.emplace_back();
  window.line_observations.back().keyframe = 6;
  window.line_observations.back().line = 102;  // the id of a point too
  window.custom_factors = {
      {"pose and point", nullptr, nullptr, {BlockId::Pose(1), BlockId::Point(100)}},
      {"points", nullptr, nullptr, {BlockId::Point(102), BlockId::Point(101)}},
      {"plane", nullptr, nullptr, {BlockId::Point(103), BlockId::Extra(0)}},
      {"plane", nullptr, nullptr, {BlockId::Point(104), BlockId::Extra(0)}},
      {"line", nullptr, nullptr, {BlockId::Line(102), BlockId::Axes(), BlockId::Pose(5)}}};
  FixGaugeOfUnlinkedKeyframes(MapWithSteps(8), &window);
  EXPECT_THAT(FixedKeyframes(window), testing::ElementsAre(0, 4, 7));
  EXPECT_THAT(KeyframesWithPrior(window), testing::ElementsAre(3, 5));
}

}  // namespace
}  // namespace msc_vo
