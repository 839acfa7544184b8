// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/benchmarks/loop_world.h"

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

class LoopWorldTest : public ::testing::Test {
 protected:
  static LoopWorldOptions Options(bool returns) {
    LoopWorldOptions options;
    options.scene = SceneKind::kDesks;
    options.seed = 2;
    options.returns = returns;
    return options;
  }

  Rigid3 TrueRelativePose(int64_t older, int64_t newer) const {
    const auto pose = [this](int64_t i) {
      return world_.sequence().PoseAt(static_cast<int>(i)).world_from_cam;
    };
    return pose(older).Inverse() * pose(newer);
  }

  LoopWorld world_{Options(true)};
  int last_ = world_.num_images() - 1;
};

TEST_F(LoopWorldTest, CountsReturnsWithoutClaims) {
  const LoopScore score = ScoreClaims(world_, {});
  EXPECT_EQ(score.num_claims, 0);
  EXPECT_EQ(score.num_false, 0);
  EXPECT_EQ(score.num_found, 0);
  EXPECT_EQ(score.num_returns, 1);
  EXPECT_EQ(ScoreClaims(LoopWorld(Options(false)), {}).num_returns, 0);
}

TEST_F(LoopWorldTest, FindsTheReturnByATrueClaim) {
  // The last image shows the desk of the first ones.
  for (const auto& pose : {std::optional<Rigid3>(), std::optional(TrueRelativePose(3, last_))}) {
    const LoopScore score = ScoreClaims(world_, {{3, last_, pose}});
    EXPECT_EQ(score.num_claims, 1);
    EXPECT_EQ(score.num_false, 0);
    EXPECT_EQ(score.num_found, 1);
  }
}

TEST_F(LoopWorldTest, TrueClaimOfAnotherTimeFindsNoReturn) {
  const LoopScore score = ScoreClaims(world_, {{3, 8, {}}});
  EXPECT_EQ(score.num_false, 0);
  EXPECT_EQ(score.num_found, 0);
}

TEST_F(LoopWorldTest, CountsClaimsOfOtherPlacesAndWrongPoses) {
  // Half way through, the camera looks at the other row.
  const int other_row = world_.num_images() * 5 / 9;
  const Rigid3 truth = TrueRelativePose(3, last_);
  const Rigid3 shifted = truth * Rigid3({1, 0, 0, 0}, {0.6, 0, 0});
  const Rigid3 turned =
      truth * Rigid3(ExpSO3(DegreesToRadians(20.0) * Eigen::Vector3d::UnitY()), {0, 0, 0});
  for (const ClaimedPlace& claim : {ClaimedPlace{3, other_row, {}}, ClaimedPlace{3, last_, shifted},
                                    ClaimedPlace{3, last_, turned}}) {
    const LoopScore score = ScoreClaims(world_, {claim});
    EXPECT_EQ(score.num_false, 1);
    EXPECT_EQ(score.num_found, 0);
  }
}

TEST_F(LoopWorldTest, RendersAtMostFourHundredSmallImages) {
  EXPECT_LE(world_.num_images(), 400);
  const RgbdImage image = world_.Render(0);
  EXPECT_EQ(image.gray.cols, 320);
  EXPECT_EQ(image.depth.rows, 240);
}

}  // namespace
}  // namespace msc_vo
