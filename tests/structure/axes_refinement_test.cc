// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/axes_refinement.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "tests/support/factor_checks.h"
#include "tests/support/message_matchers.h"
#include <Eigen/LU>
#include <gmock/gmock.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

// Directions along the axes of `truth` with angular noise `noise` and sigmas `sigma`, radians.
ManhattanAxesData Observe(const Eigen::Quaterniond& truth, int count, double sigma, double noise,
                          RandomGeometry* random) {
  ManhattanAxesData data;
  data.world_from_manhattan = truth;
  for (int i = 0; i < count; ++i) {
    ManhattanAxesData::Observation o;
    o.axis = i % 3;
    o.sigma = sigma;
    o.direction = ExpSO3(noise * random->Normal3()) * truth * Eigen::Vector3d::Unit(o.axis);
    if (i % 2 == 0) o.direction = -o.direction;
    o.normal = o.direction.unitOrthogonal();
    o.normal_sigma = sigma;
    data.observations.push_back(o);
  }
  return data;
}

Eigen::Vector3d Error(const ManhattanAxesData& data, const Eigen::Quaterniond& truth) {
  return LogSO3(data.world_from_manhattan * truth.conjugate());
}

class ManhattanAxesTest : public ::testing::Test {
 protected:
  ManhattanAxesTest() : truth_(random_.Pose().rotation()) {}
  // Rotates the initial estimate by `degrees` about a random axis.
  void Disturb(ManhattanAxesData* data, double degrees) {
    const Eigen::Vector3d axis = random_.Normal3().normalized();
    data->world_from_manhattan =
        (ExpSO3(DegreesToRadians(degrees) * axis) * data->world_from_manhattan).normalized();
  }
  RandomGeometry random_{1};
  Eigen::Quaterniond truth_;
};

TEST_F(ManhattanAxesTest, RecoversTheRotationFromExactDirections) {
  ManhattanAxesData data = Observe(truth_, 30, 0.01, 0.0, &random_);
  Disturb(&data, 5.0);
  const ManhattanAxesSummary summary = RefineManhattanAxes(&data);
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(Error(data, truth_).norm(), 1e-6);
  EXPECT_EQ(summary.num_inliers, 30);
  EXPECT_NEAR(data.world_from_manhattan.norm(), 1.0, 1e-12);
}

TEST_F(ManhattanAxesTest, ToleratesNoiseAndWrongAssociations) {
  const double sigma = DegreesToRadians(0.7);
  ManhattanAxesData data = Observe(truth_, 300, sigma, sigma, &random_);
  for (int i = 0; i < 300; i += 6) {
    ManhattanAxesData::Observation& o = data.observations[i];
    o.direction = ExpSO3(0.3 * random_.Normal3()) * o.direction;
    o.normal = o.direction.unitOrthogonal();
  }
  Disturb(&data, 5.0);
  const ManhattanAxesSummary summary = RefineManhattanAxes(&data);
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(RadiansToDegrees(Error(data, truth_).norm()), 0.2);
  int inliers = 0, wrong_inliers = 0;
  for (int i = 0; i < 300; ++i) {
    inliers += data.observations[i].inlier;
    wrong_inliers += i % 6 == 0 && data.observations[i].inlier;
  }
  EXPECT_EQ(inliers, summary.num_inliers);
  EXPECT_GT(inliers, 240);
  EXPECT_LT(wrong_inliers, 5);  // those that remained close by chance
}

TEST_F(ManhattanAxesTest, HasAConsistentCovariance) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double normalized = 0.0;
  const int count = 300;
  for (int k = 0; k < count; ++k) {
    ManhattanAxesData data = Observe(truth_, 30, 0.01, 0.01, &random_);
    const ManhattanAxesSummary summary = RefineManhattanAxes(&data);
    ASSERT_TRUE(summary.usable);
    const Eigen::Vector3d error = Error(data, truth_);
    sum += error * error.transpose() / count;
    normalized += error.dot(summary.covariance.inverse() * error) / count;
  }
  EXPECT_GT(normalized, 2.2);  // 3 up to inflation by chance
  EXPECT_LT(normalized, 3.5);
  // 20 of 30 directions constrain each component.
  EXPECT_THAT(1e4 * sum, IsNear((0.05 * 1e4 * 1e-4 * Eigen::Matrix3d::Identity()).eval(), 0.015));
}

TEST_F(ManhattanAxesTest, InflatesTheCovarianceWithTheResiduals) {
  ManhattanAxesData data = Observe(truth_, 300, 0.01, 0.012, &random_);
  const ManhattanAxesSummary noisy = RefineManhattanAxes(&data);
  data = Observe(truth_, 300, 0.01, 0.005, &random_);
  const ManhattanAxesSummary quiet = RefineManhattanAxes(&data);
  ASSERT_TRUE(noisy.usable && quiet.usable);
  // Without outliers: 1.2^2. The test at 9.21, the 99 % quantile, leaves exp(-9.21 / 2 / 1.2^2) =
  // 4 % out, and with them 14 % of the mean square.
  EXPECT_NEAR(noisy.covariance.trace() / quiet.covariance.trace(), 1.24 / 0.96, 0.2);
  EXPECT_NEAR(quiet.covariance.trace(), 3.0 * 1e-4 / 200.0, 1e-8);  // from the sigmas alone
}

TEST_F(ManhattanAxesTest, IsNotUsableWithOneAxis) {
  ManhattanAxesData data = Observe(truth_, 90, 0.01, 0.01, &random_);
  for (size_t i = 0; i < data.observations.size(); ++i) {
    data.observations[i] = data.observations[i - i % 3];
  }
  const Eigen::Vector4d before = data.world_from_manhattan.coeffs();
  const ManhattanAxesSummary summary = RefineManhattanAxes(&data);
  EXPECT_FALSE(summary.usable);
  EXPECT_EQ(summary.covariance, Eigen::Matrix3d::Zero());
  EXPECT_EQ(data.world_from_manhattan.coeffs(), before);
}

TEST_F(ManhattanAxesTest, RecoversTheRotationFromTwoAxes) {
  ManhattanAxesData data = Observe(truth_, 90, 0.01, 0.01, &random_);
  for (size_t i = 0; i < data.observations.size(); ++i) {
    if (i % 3 == 2) data.observations[i] = data.observations[i - 1];
  }
  Disturb(&data, 4.0);
  ASSERT_TRUE(RefineManhattanAxes(&data).usable);
  EXPECT_LT(RadiansToDegrees(Error(data, truth_).norm()), 0.5);
}

TEST_F(ManhattanAxesTest, IsNotUsableWithTooFewObservations) {
  ManhattanAxesData data = Observe(truth_, 5, 0.01, 0.0, &random_);
  EXPECT_FALSE(RefineManhattanAxes(&data).usable);
  data.observations.clear();
  const ManhattanAxesSummary summary = RefineManhattanAxes(&data);
  EXPECT_FALSE(summary.usable);
  EXPECT_EQ(summary.num_inliers, 0);
}

TEST_F(ManhattanAxesTest, ReclassifiesEarlierOutliers) {
  ManhattanAxesData data = Observe(truth_, 60, 0.01, 0.005, &random_);
  for (auto& o : data.observations) o.inlier = false;  // must not matter
  Disturb(&data, 8.0);
  ASSERT_TRUE(RefineManhattanAxes(&data).usable);
  for (const auto& o : data.observations) EXPECT_TRUE(o.inlier);
}

TEST_F(ManhattanAxesTest, IsDeterministic) {
  ManhattanAxesData a = Observe(truth_, 60, 0.01, 0.01, &random_);
  Disturb(&a, 3.0);
  ManhattanAxesData b = a;
  ASSERT_TRUE(RefineManhattanAxes(&a).usable);
  ASSERT_TRUE(RefineManhattanAxes(&b).usable);
  EXPECT_EQ(a.world_from_manhattan.coeffs(), b.world_from_manhattan.coeffs());
}

TEST_F(ManhattanAxesTest, NamesTheInvalidObservation) {
  const ManhattanAxesData good = Observe(truth_, 30, 0.01, 0.0, &random_);
  const auto message = [&](const auto& spoil) -> std::string {
    ManhattanAxesData data = good;
    spoil(&data);
    try {
      RefineManhattanAxes(&data);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  using Data = ManhattanAxesData;
  EXPECT_THAT(message([](Data* d) { d->observations[4].direction *= 2.0; }),
              Names("observation 4", "direction", "unit"));
  EXPECT_THAT(message([](Data* d) { d->observations[4].axis = 3; }),
              Names("observation 4", "axis", "0", "1", "2"));
  EXPECT_THAT(message([](Data* d) { d->observations[4].sigma = 0.0; }),
              Names("observation 4", "sigma"));
  EXPECT_THAT(message([](Data* d) { d->world_from_manhattan.coeffs() *= 2.0; }),
              Names("world_from_manhattan", "quaternion"));
  EXPECT_THAT(message([](Data* d) {
                d->observations[2].direction.x() = std::numeric_limits<double>::quiet_NaN();
              }),
              Names("observation 2", "direction"));
}

}  // namespace
}  // namespace msc_vo
