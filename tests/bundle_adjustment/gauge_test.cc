// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What may hold the gauge: a keyframe that is fixed, two of them, or priors.

#include "tests/support/factor_checks.h"
#include "tests/support/synthetic_window.h"

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {
namespace {

class WindowGaugeTest : public ::testing::Test {
 protected:
  WindowGaugeTest() { scene_.num_fixed = 1; }

  void Make() {
    window_ = MakeSyntheticWindow(scene_);
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

  SyntheticWindowOptions scene_;
  SyntheticWindow window_;
  BundleAdjustmentOptions options_;
  WindowData data_;
  BundleAdjustmentSummary summary_;
};

TEST_F(WindowGaugeTest, APriorHoldsItWhereItIsAndChangesNothingElse) {
  // Anchors, too, say where the world is.
  options_.line_endpoint_prior_sigma = 10.0;
  Make();
  Solve();
  const WindowData fixed = data_;
  const double cost = summary_.final_cost;
  // The same start as seen from another world, held by a prior on another keyframe.
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

TEST_F(WindowGaugeTest, APriorThatContradictsPullsAsFarAsItIsSure) {
  Make();
  Solve();
  const Rigid3 without = Pose(5);
  const Rigid3 wrong = Moved(without, {0.0, 0.0, 0.0}, {0.05, 0.0, 0.0});
  const auto pulled = [&](double sigma) {
    data_ = window_.data;
    AddPrior(5, wrong, sigma);
    Solve();
    return Distance(Pose(5), without);
  };
  EXPECT_LT(pulled(1.0), 1e-3);
  EXPECT_GT(pulled(1e-4), 0.03);
  EXPECT_GT(summary_.pose_prior.final_cost, 0.0);
}

TEST_F(WindowGaugeTest, APriorOnAFixedKeyframeSaysNothing) {
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

TEST_F(WindowGaugeTest, AKeyframeThatSeesNothingGoesWhereItsPriorSays) {
  Make();
  const int64_t blind = data_.keyframes[7].id;
  const auto is_its = [blind](const auto& o) { return o.keyframe == blind; };
  auto& points = data_.point_observations;
  auto& lines = data_.line_observations;
  points.erase(std::remove_if(points.begin(), points.end(), is_its), points.end());
  lines.erase(std::remove_if(lines.begin(), lines.end(), is_its), lines.end());
  const Rigid3 there = Moved(Pose(7), {0.1, 0.2, 0.3}, {0.5, 0.5, 0.5});
  AddPrior(7, there, 0.1);
  Solve();
  EXPECT_LT(Distance(Pose(7), there), 1e-5);
}

// Without depth, one fixed keyframe leaves the scale free; two hold it.
TEST_F(WindowGaugeTest, TwoKeyframesHoldTheScaleWithoutDepth) {
  scene_.has_depth = false;
  scene_.noise = 0.0;
  scene_.perturbation = 0.3;
  for (const int num_fixed : {1, 2}) {
    scene_.num_fixed = num_fixed;
    Make();
    if (num_fixed == 2) {  // as far from each other as there are
      data_.keyframes[1].fixed = false;
      data_.keyframes.back().fixed = true;
      data_.keyframes.back().cam_from_world = window_.truth.keyframes.back().cam_from_world;
    }
    // A start of another scale.
    for (auto& k : data_.keyframes) {
      if (!k.fixed) k.cam_from_world.translation() *= 1.1;
    }
    for (auto& p : data_.points) p.position *= 1.1;
    for (auto& l : data_.lines) l.segment = {1.1 * l.segment.start, 1.1 * l.segment.end};
    options_.reject_chi2_2 = 1e12;  // wrong scale, no wrong match
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
