// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/alignment_check.h"

#include <random>

#include "tests/evaluation/curved_path.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ContainsRegex;
using testing::IsEmpty;
using Poses = std::vector<Rigid3>;

Poses Path(int num_poses = 100) {
  Poses poses;
  for (const TimedPose& pose : CurvedPath(num_poses, 30.0)) poses.push_back(pose.world_from_cam);
  return poses;
}

Poses WithNoise(Poses poses, double metres, double radians, int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    return Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  for (Rigid3& pose : poses) {
    pose = Rigid3(pose.rotation() * ExpSO3(radians * vector()),
                  pose.translation() + metres * vector());
  }
  return poses;
}

Poses Scaled(Poses poses, double scale) {
  for (Rigid3& pose : poses) pose.translation() *= scale;
  return poses;
}

// All poses at one position.
Poses Still(Poses poses) {
  for (Rigid3& pose : poses) pose.translation() = Eigen::Vector3d(1, 2, 3);
  return poses;
}

Poses Straight(int num_poses = 100) {
  Poses poses = Path(num_poses);
  for (int i = 0; i < num_poses; ++i) {
    poses[i].translation() = 0.02 * i * Eigen::Vector3d(1, 2, -1);
  }
  return poses;
}

TEST(DescribeUndetermined, AcceptsCurvedPaths) {
  for (const bool with_scale : {false, true}) {
    EXPECT_THAT(DescribeUndetermined(Path(), Path(), with_scale), IsEmpty());
    EXPECT_THAT(DescribeUndetermined(Path(), WithNoise(Path(), 0.01, 0.0, 1), with_scale),
                IsEmpty());
  }
}

TEST(DescribeUndetermined, NamesPositionsThatAreTheSame) {
  EXPECT_THAT(DescribeUndetermined(Still(Path()), Path(), false), Names("reference"));
  EXPECT_THAT(DescribeUndetermined(Path(), Still(Path()), false), Names("estimate"));
  EXPECT_TRUE(IsStatic(Still(Path())));
  EXPECT_FALSE(IsStatic(Path()));
  // A tripod, measured with noise.
  const Poses tripod = WithNoise(Still(Path()), 1e-3, 0.0, 1);
  for (const bool with_scale : {false, true}) {
    EXPECT_THAT(DescribeUndetermined(tripod, Path(), with_scale), Names("error", "motion"));
    EXPECT_THAT(DescribeUndetermined(tripod, WithNoise(Still(Path()), 1e-3, 0.0, 2), with_scale),
                Names("error", "motion"));
  }
}

TEST(DescribeUndetermined, NamesPositionsWhoseSquaresOverflow) {
  const Poses far = Scaled(Path(), 1e200);
  for (const bool with_scale : {false, true}) {
    EXPECT_THAT(DescribeUndetermined(far, far, with_scale), Names("error", "motion"));
  }
  EXPECT_THAT(DescribeScaleContradiction(far, far), IsEmpty());
}

TEST(DescribeUndetermined, NamesStraightLines) {
  EXPECT_THAT(DescribeUndetermined(Straight(), Straight(), false),
              Names("straight line", "rotation"));
  EXPECT_THAT(DescribeUndetermined(Straight(), Scaled(Straight(), 0.5), true),
              Names("straight line", "rotation"));
  for (int seed = 0; seed < 20; ++seed) {
    const Poses noisy = WithNoise(Straight(), 1e-3, 0.0, seed);
    EXPECT_THAT(DescribeUndetermined(Straight(), noisy, false), Names("straight line", "rotation"));
    EXPECT_THAT(DescribeUndetermined(noisy, WithNoise(Straight(), 1e-3, 0.0, 77), false),
                Names("straight line", "rotation"));
  }
}

TEST(DescribeScaleContradiction, NamesTheFactorOfWrongUnits) {
  EXPECT_THAT(DescribeScaleContradiction(Scaled(Path(), 5.0), Path()),
              Names("reference path", "5.0", "depth_scale"));
  EXPECT_THAT(DescribeScaleContradiction(Path(), Scaled(Path(), 5.0)),
              Names("estimated path", "5.0", "depth_scale"));
  EXPECT_THAT(DescribeScaleContradiction(Scaled(Path(), 1000.0), Path()),
              Names("reference path", "1000", "depth_scale"));
  for (int seed = 0; seed < 20; ++seed) {
    EXPECT_THAT(DescribeScaleContradiction(Path(), WithNoise(Scaled(Path(), 0.25), 2e-3, 0, seed)),
                Names("reference path", "depth_scale"));
  }
}

TEST(DescribeScaleContradiction, IsSilentWithoutClearEvidence) {
  // The scale error of a sensor, and noise that makes each path longer.
  EXPECT_THAT(DescribeScaleContradiction(Path(), Scaled(Path(), 1.05)), IsEmpty());
  for (int seed = 0; seed < 50; ++seed) {
    for (const double sigma : {0.003, 0.03, 0.3, 3.0}) {
      EXPECT_THAT(DescribeScaleContradiction(WithNoise(Path(), sigma, 0.0, seed), Path()),
                  IsEmpty());
      EXPECT_THAT(DescribeScaleContradiction(Path(), WithNoise(Path(), sigma, 0.0, seed)),
                  IsEmpty());
      EXPECT_THAT(DescribeScaleContradiction(WithNoise(Still(Path()), sigma, 0.0, seed),
                                             WithNoise(Still(Path()), 0.1 * sigma, 0.0, seed + 50)),
                  IsEmpty());
    }
  }
  EXPECT_THAT(DescribeScaleContradiction(Scaled(Path(10), 5.0), Path(10)), IsEmpty());
  EXPECT_THAT(DescribeScaleContradiction(Still(Path()), Path()), IsEmpty());
}

TEST(DescribeScaleContradiction, IsSilentAboutLostTrajectories) {
  for (const size_t lost : {20, 50, 80}) {
    Poses frozen = Path(), drifting = Path();
    for (size_t i = lost; i < frozen.size(); ++i) {
      frozen[i] = frozen[lost - 1];
      drifting[i].translation() = frozen[lost - 1].translation() +
                                  0.1 * static_cast<double>(i - lost) * Eigen::Vector3d(1, 0, 0);
    }
    EXPECT_THAT(DescribeScaleContradiction(Path(), frozen), IsEmpty()) << lost;
    EXPECT_THAT(DescribeScaleContradiction(Path(), drifting), IsEmpty()) << lost;
  }
}

// As if the quaternions of a file had been read with the scalar at the wrong end.
Poses Misread(Poses poses, bool scalar_is_first) {
  for (Rigid3& pose : poses) {
    const Eigen::Vector4d c = Eigen::Quaterniond(pose.rotation()).coeffs();
    const Eigen::Quaterniond read = scalar_is_first ? Eigen::Quaterniond(c(2), c(3), c(0), c(1))
                                                    : Eigen::Quaterniond(c(0), c(1), c(2), c(3));
    pose = Rigid3(read, pose.translation());
  }
  return poses;
}

TEST(DescribeQuaternionOrder, NamesTheTrajectoryAndItsOrder) {
  const Poses estimate = WithNoise(Path(), 0.01, 0.01, 1);
  EXPECT_THAT(DescribeQuaternionOrder(Misread(Path(), true), estimate),
              ContainsRegex("reference[^,]*qw qx qy qz"));
  EXPECT_THAT(DescribeQuaternionOrder(Path(), Misread(estimate, true)),
              ContainsRegex("estimate[^,]*qw qx qy qz"));
  EXPECT_THAT(DescribeQuaternionOrder(Path(), Misread(estimate, false)),
              ContainsRegex("estimate[^,]*qx qy qz qw"));
}

TEST(DescribeQuaternionOrder, IsSilentIfTheOrderMakesNoDifference) {
  EXPECT_THAT(DescribeQuaternionOrder(Path(), Path()), IsEmpty());
  for (int seed = 0; seed < 50; ++seed) {
    for (const double sigma : {0.01, 0.1, 1.0}) {
      EXPECT_THAT(DescribeQuaternionOrder(Path(), WithNoise(Path(), 0.0, sigma, seed)), IsEmpty());
      const Poses fixed(100, Path()[0]);
      EXPECT_THAT(DescribeQuaternionOrder(fixed, WithNoise(fixed, 0.0, sigma, seed)), IsEmpty());
    }
  }
}

}  // namespace
}  // namespace msc_vo
