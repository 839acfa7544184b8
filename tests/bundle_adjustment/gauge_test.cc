// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Gauge of local bundle adjustment: one fixed keyframe, two fixed keyframes, or pose priors.

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {
namespace {

class GaugeTest : public ::testing::Test {
 protected:
  GaugeTest() { scene_.num_fixed = 1; }

  void Make() {
    window_ = MakeTestWindow(scene_);
    data_ = window_.data;
  }
  void AddPrior(int keyframe, const Rigid3& pose, double sigma) {
    WindowData::PosePrior prior{data_.keyframes[keyframe].id, pose};
    prior.covariance *= sigma * sigma;
    data_.pose_priors.push_back(prior);
  }
  void Solve() {
    options_.first_iterations = options_.second_iterations = 50;
    summary_ = LocalBundleAdjustment(options_, &data_);
    ASSERT_TRUE(summary_.usable) << summary_.BriefReport();
  }
  Rigid3 Pose(int i) const { return data_.keyframes[i].cam_from_world; }

  TestWindowOptions scene_;
  TestWindow window_;
  BundleAdjustmentOptions options_;
  WindowData data_;
  BundleAdjustmentSummary summary_;
};

TEST_F(GaugeTest, APosePriorFixesTheGauge) {
  // Endpoint priors refer to the world too: weaken them.
  options_.line_endpoint_prior_sigma = 10.0;
  Make();
  Solve();
  const WindowData fixed = data_;
  const double cost = summary_.final_cost;
  // The same initial state in another world frame, with a prior on another keyframe.
  const Rigid3 new_from_old(ExpSO3({0.3, -0.2, 0.1}), {1.0, 2.0, -0.5});
  data_ = window_.data;
  for (auto& k : data_.keyframes) {
    k.cam_from_world = k.cam_from_world * new_from_old.Inverse();
    k.fixed = false;
  }
  for (auto& p : data_.points) p.position = new_from_old * p.position;
  for (auto& l : data_.lines) l.segment = new_from_old * l.segment;
  AddPrior(4, fixed.keyframes[4].cam_from_world * new_from_old.Inverse(), 1e-3);
  Solve();
  EXPECT_NEAR(summary_.final_cost, cost, 1e-5 * cost);
  EXPECT_LT(summary_.pose_prior.final_cost, 1e-5 * cost);
  EXPECT_EQ(summary_.pose_prior.num_residual_blocks, 1);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) {
    EXPECT_LT(Distance(Pose(i) * new_from_old, fixed.keyframes[i].cam_from_world), 2e-4) << i;
  }
}

TEST_F(GaugeTest, AWrongPosePriorActsAccordingToItsSigma) {
  Make();
  Solve();
  const Rigid3 without = Pose(5);
  const Rigid3 wrong = Moved(without, {0.0, 0.0, 0.0}, {0.05, 0.0, 0.0});
  const auto displacement = [&](double sigma) {
    data_ = window_.data;
    AddPrior(5, wrong, sigma);
    Solve();
    return Distance(Pose(5), without);
  };
  EXPECT_LT(displacement(1.0), 1e-3);
  EXPECT_GT(displacement(1e-4), 0.03);
  EXPECT_GT(summary_.pose_prior.final_cost, 0.0);
}

TEST_F(GaugeTest, IgnoresAPosePriorOnAFixedKeyframe) {
  Make();
  Solve();
  const WindowData expected = data_;
  data_ = window_.data;
  AddPrior(0, Rigid3(), 1e-3);
  Solve();
  EXPECT_EQ(summary_.pose_prior.num_residual_blocks, 0);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) {
    EXPECT_EQ(Pose(i).params, expected.keyframes[i].cam_from_world.params);
  }
}

TEST_F(GaugeTest, AKeyframeWithoutObservationsMovesToItsPrior) {
  Make();
  const int64_t without_observations = data_.keyframes[7].id;
  const auto is_removed = [=](const auto& o) { return o.keyframe == without_observations; };
  auto& points = data_.point_observations;
  auto& lines = data_.line_observations;
  points.erase(std::remove_if(points.begin(), points.end(), is_removed), points.end());
  lines.erase(std::remove_if(lines.begin(), lines.end(), is_removed), lines.end());
  const Rigid3 prior = Moved(Pose(7), {0.1, 0.2, 0.3}, {0.5, 0.5, 0.5});
  AddPrior(7, prior, 0.1);
  Solve();
  EXPECT_LT(Distance(Pose(7), prior), 1e-5);
}

// Without depth, one fixed keyframe leaves the scale free and two fix it.
TEST_F(GaugeTest, TwoFixedKeyframesFixTheScaleWithoutDepth) {
  scene_.has_depth = false;
  scene_.noise = 0.0;
  scene_.perturbation = 0.3;
  for (const int num_fixed : {1, 2}) {
    scene_.num_fixed = num_fixed;
    Make();
    if (num_fixed == 2) {  // with the longest baseline
      data_.keyframes[1].fixed = false;
      data_.keyframes.back().fixed = true;
      data_.keyframes.back().cam_from_world = window_.truth.keyframes.back().cam_from_world;
    }
    // An initial state of another scale.
    for (auto& k : data_.keyframes) {
      if (!k.fixed) k.cam_from_world.translation() *= 1.1;
    }
    for (auto& p : data_.points) p.position *= 1.1;
    for (auto& l : data_.lines) l.segment = {1.1 * l.segment.start, 1.1 * l.segment.end};
    options_.reject_chi2_2 = 1e12;  // residuals of the wrong scale are not outliers
    options_.line_endpoint_prior_sigma = 100.0;
    Solve();
    double worst = 0.0;
    for (size_t i = 0; i < data_.keyframes.size(); ++i) {
      worst = std::max(worst, Distance(Pose(i), window_.truth.keyframes[i].cam_from_world));
    }
    if (num_fixed == 1) {
      EXPECT_GT(worst, 0.01);
    } else {
      EXPECT_LT(worst, 1e-3);
    }
  }
}

}  // namespace
}  // namespace msc_vo
