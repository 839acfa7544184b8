// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/alignment_check.h"

#include <random>

#include "tests/evaluation/curved_path.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
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

// A path that bends by a fifth of its length.
Poses Bent() {
  Poses poses = Straight();
  for (size_t i = 0; i < poses.size(); ++i) {
    poses[i].translation().x() += 1.3 * std::sin(0.03 * static_cast<double>(i));
  }
  return poses;
}

TEST(DescribeUndetermined, DoesNotCountAWrongScaleAsAnErrorOfPositions) {
  for (const double scale : {0.001, 0.5, 0.7, 1.3, 3.0, 1000.0}) {
    EXPECT_THAT(DescribeUndetermined(Bent(), Scaled(Bent(), scale), false), IsEmpty()) << scale;
    EXPECT_THAT(DescribeUndetermined(Straight(), Scaled(Straight(), scale), false),
                Names("straight line", "rotation"));
  }
}

// The path is not related to the reference, and a hundred times as long.
TEST(DescribeUndetermined, StatesTheErrorOfTheAlignment) {
  const Poses lost = WithNoise(Still(Path()), 20.0, 0.0, 1);
  double squares = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Rigid3& pose : lost) mean += pose.translation() / static_cast<double>(lost.size());
  for (const Rigid3& pose : lost) squares += (pose.translation() - mean).squaredNorm();
  const double spread = 1e3 * std::sqrt(squares / static_cast<double>(lost.size()));
  const auto error = [&](bool with_scale) {
    const std::string text = DescribeUndetermined(Path(), lost, with_scale);
    EXPECT_THAT(text, Not(HasSubstr("e+")));  // 26000 mm rather than 2.6e+04 mm
    const size_t begin = text.find('(');
    return begin == std::string::npos ? 0.0 : std::stod(text.substr(begin + 1));
  };
  EXPECT_NEAR(error(false) / spread, 1.0, 0.1);
  EXPECT_LT(error(true), 0.1 * spread);
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

// With camera axes that differ by a constant rotation.
Poses Turned(Poses poses, const Eigen::Vector3d& axis, double degrees) {
  const Eigen::Quaterniond turn = ExpSO3(DegreesToRadians(degrees) * axis.normalized());
  for (Rigid3& pose : poses) pose = Rigid3(pose.rotation() * turn, pose.translation());
  return poses;
}

// The same path with a fraction of its rotations.
Poses WithLittleRotation(Poses poses, double ratio) {
  for (Rigid3& pose : poses) {
    pose = Rigid3(ExpSO3(ratio * LogSO3(Eigen::Quaterniond(pose.rotation()))), pose.translation());
  }
  return poses;
}

// In another world.
Poses Moved(Poses poses) {
  const Rigid3 world(ExpSO3({0.4, -1.1, 2.0}), Eigen::Vector3d(3, -2, 1));
  for (Rigid3& pose : poses) pose = world * pose;
  return poses;
}

std::string Contradiction(const Poses& reference, const Poses& estimate, bool is_own = false) {
  return DescribeOrientationContradiction(reference, estimate, is_own);
}

TEST(DescribeTurn, NamesAngleAndAxis) {
  const auto describe = [](const Eigen::Vector3d& axis, double degrees) {
    return DescribeTurn(ExpSO3(DegreesToRadians(degrees) * axis.normalized()).toRotationMatrix());
  };
  EXPECT_EQ(describe({1, 0, 0}, 180), "180 degree turn about x");
  EXPECT_EQ(describe({0, -1, 0}, 180), "180 degree turn about y");
  EXPECT_EQ(describe({0, 0, 1}, -90), "90 degree turn about -z");
  EXPECT_EQ(describe({1, -1, 1}, 120), "120 degree turn about (0.58, -0.58, 0.58)");
}

TEST(DescribeOrientationContradiction, NamesTheTurnBetweenCameraAxes) {
  for (const double ratio : {0.1, 0.3, 1.0}) {
    const Poses path = WithLittleRotation(Path(), ratio);
    const Poses estimate = WithNoise(Moved(path), 1e-3, 1e-3, 1);
    for (const bool is_own : {false, true}) {
      const auto describe = [&](const Eigen::Vector3d& axis, double degrees) {
        return Contradiction(Turned(path, axis, degrees), estimate, is_own);
      };
      EXPECT_THAT(describe({1, 0, 0}, 180), ContainsRegex("1[78][0-9.]+ degree turn about x:"));
      EXPECT_THAT(describe({0, 1, 0}, 180), ContainsRegex("1[78][0-9.]+ degree turn about y:"));
      EXPECT_THAT(describe({0, 0, 1}, 180), ContainsRegex("1[78][0-9.]+ degree turn about z:"));
      EXPECT_THAT(describe({0, 0, 1}, 90), ContainsRegex("(89|90)[0-9.]* degree turn about z:"));
      EXPECT_THAT(describe({1, -1, 1}, 120), HasSubstr("degree turn about (0.5"));
      EXPECT_THAT(describe({1, 2, 3}, 150), HasSubstr("degree turn about (0.2"));
    }
    const Poses opengl = Turned(path, {1, 0, 0}, 180);
    EXPECT_THAT(Contradiction(opengl, estimate, true), Names("reference", "camera"));
    EXPECT_THAT(Contradiction(opengl, estimate, true), Not(HasSubstr("estimate")));
    EXPECT_THAT(Contradiction(opengl, estimate, true), Not(HasSubstr("quaternion")));
    EXPECT_THAT(Contradiction(opengl, estimate, false), Names("reference", "estimated"));
    EXPECT_THAT(Contradiction(path, Turned(estimate, {1, 0, 0}, 180)), HasSubstr("about x:"));
  }
}

TEST(DescribeOrientationContradiction, NamesTheTurnOfACameraThatOnlyPans) {
  Poses path = Path();
  for (size_t i = 0; i < path.size(); ++i) {
    const double angle = 0.6 * std::sin(0.05 * static_cast<double>(i));
    path[i] = Rigid3(ExpSO3({0.0, angle, 0.0}), path[i].translation());
  }
  const Poses estimate = WithNoise(path, 1e-3, 1e-3, 1);
  EXPECT_THAT(Contradiction(Turned(path, {1, 0, 0}, 180), estimate),
              HasSubstr("180 degree turn about x"));
  // Quaternions of the estimate in the other order would be those of such a turn about z.
  for (const char* const name : {"x", "z"}) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(*name - 'x');
    EXPECT_THAT(Contradiction(Moved(Turned(path, axis, 180)), estimate, true),
                HasSubstr(std::string("180 degree turn about ") + name));
  }
}

TEST(DescribeOrientationContradiction, NamesTheTurnIfPositionsAreWrong) {
  const Poses opengl = Turned(Path(), {1, 0, 0}, 180);
  for (const Poses& estimate : {Still(Path()), Straight(), Scaled(Path(), -1.0)}) {
    EXPECT_THAT(Contradiction(opengl, estimate), HasSubstr("180 degree turn about x"));
  }
}

TEST(DescribeOrientationContradiction, NamesInversePoses) {
  Poses inverse;
  for (const Rigid3& pose : Path()) inverse.push_back(pose.Inverse());
  const Poses estimate = WithNoise(Moved(Path()), 1e-3, 1e-3, 1);
  EXPECT_THAT(Contradiction(inverse, estimate, true), Names("reference", "inverse"));
  EXPECT_THAT(Contradiction(estimate, inverse), Names("estimate", "inverse"));
  EXPECT_THAT(Contradiction(estimate, inverse, true), Not(HasSubstr("inverse")));
}

TEST(DescribeOrientationContradiction, NamesMirroredImages) {
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs(axis) = -1.0;
    Poses mirrored;
    for (const Rigid3& pose : Path()) {
      const Eigen::Matrix3d rotation =
          signs.asDiagonal() * pose.rotation().toRotationMatrix() * signs.asDiagonal();
      mirrored.push_back(
          Rigid3(Eigen::Quaterniond(rotation), signs.asDiagonal() * pose.translation()));
    }
    EXPECT_THAT(Contradiction(Path(), mirrored), Names("180 degree turn", "mirrored"));
  }
  const Poses opengl = Turned(Path(), {1, 0, 0}, 180);
  EXPECT_THAT(Contradiction(opengl, Path()), Not(HasSubstr("mirrored")));
}

TEST(DescribeOrientationContradiction, NamesTheTrajectoryAndItsOrder) {
  const Poses estimate = WithNoise(Path(), 0.01, 0.01, 1);
  EXPECT_THAT(Contradiction(Misread(Path(), true), estimate),
              ContainsRegex("reference[^,]*qw qx qy qz"));
  EXPECT_THAT(Contradiction(Path(), Misread(estimate, true)),
              ContainsRegex("estimate[^,]*qw qx qy qz"));
  EXPECT_THAT(Contradiction(Path(), Misread(estimate, false)),
              ContainsRegex("estimate[^,]*qx qy qz qw"));
}

TEST(DescribeOrientationContradiction, BlamesNoOwnEstimate) {
  const Poses estimate = WithNoise(Path(), 0.01, 0.01, 1);
  for (const bool scalar_is_first : {true, false}) {
    const std::string text = Contradiction(Misread(Path(), scalar_is_first), estimate, true);
    EXPECT_THAT(text, HasSubstr("quaternions of the reference"));
    EXPECT_THAT(text, Not(HasSubstr("estimate")));
  }
}

TEST(DescribeOrientationContradiction, IsSilentIfNothingExplainsTheDifference) {
  EXPECT_THAT(Contradiction(Path(), Path()), IsEmpty());
  EXPECT_THAT(Contradiction(Turned(Path(), {1, 2, 3}, 3.0), Path()), IsEmpty());
  for (int seed = 0; seed < 50; ++seed) {
    for (const double sigma : {0.01, 0.1, 1.0}) {
      for (const size_t num_poses : {3, 8, 100}) {
        const Poses path = Path(static_cast<int>(num_poses));
        EXPECT_THAT(Contradiction(path, WithNoise(path, 0.0, sigma, seed)), IsEmpty());
        const Poses fixed(num_poses, path[0]);
        EXPECT_THAT(Contradiction(fixed, WithNoise(fixed, 0.0, sigma, seed)), IsEmpty());
        const Poses turned = Turned(path, {1, 0, 0}, 180);
        if (sigma < 1.0) continue;
        EXPECT_THAT(Contradiction(turned, WithNoise(path, 0.0, sigma, seed)), IsEmpty());
      }
    }
  }
  const Poses far = Scaled(Path(), 1e200);
  EXPECT_THAT(Contradiction(far, WithNoise(far, 0.0, 0.1, 1)), IsEmpty());
}

}  // namespace
}  // namespace msc_vo
