// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/pose_covariance.h"

#include <cmath>

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Rigid3 Plus(const Rigid3& pose, const Vector6& tangent) {
  return {ExpSO3(tangent.head<3>()) * pose.rotation(), pose.translation() + tangent.tail<3>()};
}

Vector6 Minus(const Rigid3& b, const Rigid3& a) {
  Vector6 difference;
  difference << LogSO3(b.rotation() * a.rotation().conjugate()), b.translation() - a.translation();
  return difference;
}

// A covariance with correlations.
PoseCovariance Correlated(double first, double step) {
  PoseCovariance root = PoseCovariance::Zero();
  for (int i = 0; i < 36; ++i) root(i % 6, i / 6) = std::sin(first + step * i);
  return 1e-6 * root * root.transpose();
}

class PoseCovarianceTest : public testing::Test {
 protected:
  // J C J^T with the derivative of `function` at zero by differences.
  template <typename Function>
  static PoseCovariance Propagate(const Function& function, const PoseCovariance& covariance) {
    constexpr double kStep = 1e-6;
    PoseCovariance jacobian;
    for (int i = 0; i < 6; ++i) {
      jacobian.col(i) = (function(kStep * Vector6::Unit(i)) - function(-kStep * Vector6::Unit(i))) /
                        (2.0 * kStep);
    }
    return jacobian * covariance * jacobian.transpose();
  }

  const Rigid3 c_from_b_{ExpSO3({0.3, -0.8, 0.4}), {1.0, 2.0, -3.0}};
  const Rigid3 b_from_a_{ExpSO3({-0.5, 0.2, 1.4}), {-4.0, 0.5, 2.0}};
};

TEST_F(PoseCovarianceTest, ComposesLikeTheDerivatives) {
  const PoseCovariance first = Correlated(0.3, 1.7), second = Correlated(2.0, 0.9);
  const Rigid3 product = c_from_b_ * b_from_a_;
  const PoseCovariance expected =
      Propagate([&](const Vector6& d) { return Minus(Plus(c_from_b_, d) * b_from_a_, product); },
                first) +
      Propagate([&](const Vector6& d) { return Minus(c_from_b_ * Plus(b_from_a_, d), product); },
                second);
  EXPECT_TRUE(ComposeCovariances(c_from_b_, first, b_from_a_, second).isApprox(expected, 1e-6));
}

TEST_F(PoseCovarianceTest, OfTheCameraHasNoLeverArm) {
  const PoseCovariance covariance = Correlated(1.0, 1.1);
  const PoseCovariance expected = Propagate(
      [&](const Vector6& d) {
        const Rigid3 disturbed = Plus(c_from_b_, d);
        Vector6 error;
        error << d.head<3>(),
            -(c_from_b_.rotation() * (disturbed.OriginInSource() - c_from_b_.OriginInSource()));
        return error;
      },
      covariance);
  EXPECT_TRUE(CameraCovariance(c_from_b_, covariance).isApprox(expected, 1e-6));
}

TEST_F(PoseCovarianceTest, OfTheCameraAndOfItsPoseAreInverse) {
  const PoseCovariance covariance = Correlated(0.7, 1.3);
  const PoseCovariance camera = CameraCovariance(c_from_b_, covariance);
  EXPECT_TRUE(CovarianceOfCamera(c_from_b_, camera).isApprox(covariance, 1e-9));
}

// A motion of frame b, seen in frame c.
TEST_F(PoseCovarianceTest, IsTransportedLikeTheMotion) {
  const PoseCovariance covariance = Correlated(0.2, 2.1);
  const PoseCovariance expected = Propagate(
      [&](const Vector6& d) {
        return Minus(c_from_b_ * Plus(Rigid3(), d) * c_from_b_.Inverse(), Rigid3());
      },
      covariance);
  EXPECT_TRUE(TransportCovariance(c_from_b_, covariance).isApprox(expected, 1e-6));
}

}  // namespace
}  // namespace msc_vo
