// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry_options.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/odometry/map_merge.h"

namespace msc_vo {
namespace {

// The error of the default options after `change`; empty: they are valid.
template <typename Change>
std::string ErrorAfter(const Change& change) {
  OdometryOptions options;
  change(&options);
  std::string error;
  return options.IsValid(&error) ? "" : error;
}

TEST(OdometryOptions, RequireRelationsBetweenOptions) {
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->features.max_depth = 0.1; }),
              Names("min_depth", "max_depth"));
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->features.points.fast_threshold = 5; }),
              Names("min_fast_threshold", "fast_threshold"));
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->tracking.keyframes.max_interval = 0.01; }),
              Names("min_interval", "max_interval"));
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->tracking.min_matches = 21; }),
              Names("min_matches", "min_initial_features"));
  EXPECT_EQ(ErrorAfter([](OdometryOptions* o) { o->tracking.min_matches = 20; }), "");
}

TEST(OdometryOptions, AreCheckedBeforeMapsAreMerged) {
  OdometryOptions options;
  options.features.max_depth = options.features.min_depth;
  EXPECT_THROW(MergeMaps(options, {}, {}), std::invalid_argument);
}

TEST(OdometryOptions, CheckOptionsThatAreNotListed) {
  for (const double bad : {-1.0, std::nan("")}) {
    EXPECT_THAT(ErrorAfter([&](OdometryOptions* o) { o->tracking.segments.search_interval = bad; }),
                Names("search_interval"));
    EXPECT_THAT(ErrorAfter([&](OdometryOptions* o) { o->mapping.culling.redundant_ratio = bad; }),
                Names("redundant_ratio"));
    EXPECT_THAT(ErrorAfter([&](OdometryOptions* o) { o->mapping.noise.prior = bad; }),
                Names("prior"));
  }
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->mapping.culling.redundant_ratio = 2.0; }),
              Names("redundant_ratio"));
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->mapping.selection.min_observations = 0; }),
              Names("min_observations"));
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->tracking.pose.max_frame_noise = 0.5; }),
              Names("max_frame_noise"));
  EXPECT_THAT(ErrorAfter([](OdometryOptions* o) { o->mapping.window.reject_chi2_1 = 0.0; }),
              Names("reject_chi2_1"));
}

TEST(EffectiveOptions, DisableWhatTheModeDoesNotInclude) {
  OdometryOptions options;
  options.mode = Mode::kPlVo;
  const OdometryOptions pl_vo = EffectiveOptions(options);
  EXPECT_EQ(pl_vo.features.line_depth, LineDepthMethod::kEndPoints);
  EXPECT_FALSE(pl_vo.mapping.frame_structure);
  EXPECT_FALSE(pl_vo.mapping.axes.enabled);
  options.mode = Mode::kPlVoDepth;
  const OdometryOptions pl_vo_depth = EffectiveOptions(options);
  EXPECT_EQ(pl_vo_depth.features.line_depth, LineDepthMethod::kRobustFit);
  EXPECT_TRUE(pl_vo_depth.mapping.frame_structure);
  EXPECT_FALSE(pl_vo_depth.mapping.pairs.parallel);
  options.mode = Mode::kMscVo;
  EXPECT_TRUE(EffectiveOptions(options).mapping.frame_structure);
  EXPECT_TRUE(EffectiveOptions(options).mapping.axes.enabled);
}

TEST(EffectiveOptions, ShareSettingsBetweenComponents) {
  OdometryOptions options;
  options.tracking.matchers.point_matcher.max_distance = 33;
  options.tracking.matchers.line_matcher.max_angle = 3.0;
  options.mapping.window.line_depth = {false, 1.5};
  options.mapping.window.reject_chi2_2 = 7.0;
  const OdometryOptions effective = EffectiveOptions(options);
  EXPECT_EQ(effective.mapping.fusion.matchers.point_matcher.max_distance, 33);
  EXPECT_EQ(effective.mapping.fusion.matchers.line_matcher.max_angle, 3.0);
  EXPECT_FALSE(effective.tracking.pose.line_depth.enabled);
  EXPECT_EQ(effective.tracking.pose.line_depth.huber, 1.5);
  EXPECT_EQ(effective.tracking.pose.reject_chi2_2, 7.0);
}

TEST(NormalOptions, HaveTheDepthRangeOfTheFeatures) {
  OdometryOptions options;
  options.features.min_depth = 0.5;
  options.features.max_depth = 4.0;
  EXPECT_EQ(NormalOptions(options).min_depth, 0.5);
  EXPECT_EQ(NormalOptions(options).max_depth, 4.0);
}

TEST(NormalOptions, AreValidForEveryValidDepthRange) {
  OdometryOptions options;
  options.features.min_depth = 20.0;
  options.features.max_depth = 1000.0;
  std::string error;
  ASSERT_TRUE(options.IsValid(&error)) << error;
  EXPECT_TRUE(NormalOptions(options).IsValid(&error)) << error;
}

}  // namespace
}  // namespace msc_vo
