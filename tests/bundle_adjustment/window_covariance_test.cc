// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/window_covariance.h"

#include <algorithm>
#include <stdexcept>

#include "tests/support/ceres_covariance.h"
#include "tests/support/factor_checks.h"
#include "tests/support/message_matchers.h"
#include "tests/support/test_window.h"
#include <gmock/gmock.h>

#include "msc_vo/factors/direction_prior.h"
#include "msc_vo/factors/unit_vector_manifold.h"

namespace msc_vo {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

class WindowCovarianceTest : public ::testing::Test {
 protected:
  WindowCovarianceTest() {
    scene_.num_keyframes = 6;
    scene_.num_points = 40;
    scene_.num_lines = 12;
    scene_.outlier_ratio = 0.03;
  }

  void Solve() {
    window_ = MakeTestWindow(scene_);
    data_ = window_.data;
    if (with_structure_) AddStructure();
    for (size_t i = 0; with_wrong_depths_ && i < data_.point_observations.size(); i += 25) {
      data_.point_observations[i].inverse_depth *= 0.7;
    }
    ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  }
  // A clique, a star and alignments: lines in the reduced system, lines coupled with those, and
  // lines without pairs.
  void AddStructure() {
    const auto add = [this](int i, int j) {
      (i % 3 == j % 3 ? data_.parallel_pairs : data_.perpendicular_pairs)
          .push_back({data_.lines[i].id, data_.lines[j].id, 0.02});
    };
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) add(i, j);
    }
    for (int i = 5; i < 9; ++i) add(4, i);
    data_.axis_alignments.push_back({data_.lines[9].id, Eigen::Vector3d::UnitX(), 0.02});
    data_.pose_priors.push_back({data_.keyframes[3].id, data_.keyframes[3].cam_from_world});
    data_.pose_priors[0].covariance *= 1e-4;
  }
  CovarianceSelection All() const { return AllItems(data_); }

  TestWindowOptions scene_;
  TestWindow window_;
  BundleAdjustmentOptions options_;
  WindowData data_;
  bool with_structure_ = false, with_wrong_depths_ = false;
};

TEST_F(WindowCovarianceTest, MatchesCeres) {
  for (const bool with_structure : {false, true}) {
    SCOPED_TRACE(with_structure);
    with_structure_ = with_structure;
    with_wrong_depths_ = true;
    Solve();
    const auto& observations = data_.point_observations;
    EXPECT_TRUE(std::any_of(observations.begin(), observations.end(),
                            [](const auto& o) { return o.depth_rejected; }));
    const WindowCovariance found = EstimateCovariance(options_, data_, All());
    const CeresCovariance expected(options_, data_);
    for (size_t i = 0; i < data_.keyframes.size(); ++i) {
      if (data_.keyframes[i].fixed) {
        EXPECT_EQ(*found.keyframes[i], Matrix6d(Matrix6d::Zero()));
      } else {
        ExpectSameCovariance(found.keyframes[i], expected.Of<6>(expected.state_.PoseBlock(i)));
      }
    }
    for (size_t i = 0; i < data_.points.size(); ++i) {
      ExpectSameCovariance(found.points[i], expected.Of<3>(expected.state_.PointBlock(i)));
    }
    for (size_t i = 0; i < data_.lines.size(); ++i) {
      ExpectSameCovariance(found.lines[i], expected.Of<6>(expected.state_.LineBlock(i)));
    }
  }
}

TEST_F(WindowCovarianceTest, DoesNotDependOnTheSelection) {
  with_structure_ = true;
  Solve();
  const WindowCovariance all = EstimateCovariance(options_, data_, All());
  const WindowCovariance some = EstimateCovariance(
      options_, data_,
      {{data_.keyframes[4].id, data_.keyframes[0].id}, {data_.points[7].id}, {data_.lines[2].id}});
  ASSERT_EQ(some.keyframes.size(), 2u);
  EXPECT_EQ(*some.keyframes[0], *all.keyframes[4]);
  EXPECT_EQ(*some.keyframes[1], Matrix6d(Matrix6d::Zero()));
  EXPECT_EQ(*some.points.at(0), *all.points[7]);
  EXPECT_EQ(*some.lines.at(0), *all.lines[2]);
}

TEST_F(WindowCovarianceTest, IsEmptyForUndeterminedLandmarks) {
  scene_.outlier_ratio = 0.0;
  Solve();
  // Point 3 is observed once without depth, point 5 not at all.
  int num_observations = 0;
  for (auto& o : data_.point_observations) {
    if (o.point == data_.points[3].id) {
      o.rejected = num_observations++ > 0;
      o.inverse_depth = 0.0;
    }
    if (o.point == data_.points[5].id) o.rejected = true;
  }
  const WindowCovariance found = EstimateCovariance(options_, data_, All());
  for (size_t i = 0; i < data_.points.size(); ++i) {
    EXPECT_EQ(found.points[i].has_value(), i != 3 && i != 5) << i;
  }
  for (const auto& pose : found.keyframes) EXPECT_TRUE(pose.has_value());
}

TEST_F(WindowCovarianceTest, IsEmptyForUndeterminedScale) {
  scene_.outlier_ratio = 0.0;
  scene_.has_depth = false;
  options_.line_endpoint_prior_sigma = 1e6;
  Solve();
  // Two fixed keyframes fix the scale.
  for (const auto& pose : EstimateCovariance(options_, data_, All()).keyframes) {
    EXPECT_TRUE(pose.has_value());
  }
  data_.keyframes[1].fixed = false;
  const WindowCovariance found = EstimateCovariance(options_, data_, All());
  EXPECT_TRUE(found.keyframes[0].has_value());
  for (size_t i = 1; i < found.keyframes.size(); ++i) EXPECT_FALSE(found.keyframes[i].has_value());
}

TEST_F(WindowCovarianceTest, ShrinksWithMoreObservations) {
  Solve();
  const Matrix6d all = *EstimateCovariance(options_, data_, All()).keyframes[4];
  for (size_t i = 0; i < data_.point_observations.size(); i += 2) {
    data_.point_observations[i].rejected = true;
  }
  const Matrix6d half = *EstimateCovariance(options_, data_, All()).keyframes[4];
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(half - all).eigenvalues()[0], 0.0);
}

TEST_F(WindowCovarianceTest, OfADirectionIsInSquareRadians) {
  const Eigen::Vector3d direction = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  constexpr double kSigma = 0.02;
  data_ = MakeTestWindow(scene_).data;
  data_.extra_blocks.push_back({5, direction, std::make_shared<UnitVectorManifold>()});
  data_.custom_factors.push_back(
      {"direction", DirectionPrior::CreateShared(direction, kSigma), nullptr, {BlockId::Extra(5)}});
  const WindowCovariance found = EstimateCovariance(options_, data_, {{}, {}, {}, {5}});
  const Eigen::MatrixXd expected = kSigma * kSigma * Eigen::Matrix2d::Identity();
  EXPECT_THAT(*found.extra_blocks.at(0), IsNear(expected, 1e-12));
}

TEST_F(WindowCovarianceTest, ThrowsOnInvalidInput) {
  Solve();
  const auto message = [this](const CovarianceSelection& selected) -> std::string {
    try {
      EstimateCovariance(options_, data_, selected);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(message({{9999}, {}, {}}), Names("keyframe 9999", "selected"));
  EXPECT_THAT(message({{}, {-1}, {}}), Names("point -1", "selected"));
  EXPECT_THAT(message({{}, {}, {8888}}), Names("line 8888", "selected"));
  data_.keyframes[0].cam_from_world.params[3] = 7.0;
  EXPECT_THAT(message({}),
              Names("keyframe " + std::to_string(data_.keyframes[0].id), "quaternion"));
}

TEST(CovarianceInWorld, MatchesSamples) {
  RandomGeometry random(1);
  const Rigid3 pose = random.Pose();
  Matrix6d factor;
  for (int i = 0; i < 36; ++i) factor.data()[i] = 1e-3 * random.Normal();
  const Matrix6d expected = CovarianceInWorld(pose, factor * factor.transpose());
  const Rigid3 camera = pose.Inverse();
  Matrix6d found = Matrix6d::Zero();
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    Eigen::Matrix<double, 6, 1> d;
    for (int k = 0; k < 6; ++k) d[k] = random.Normal();
    d = factor * d;
    const Rigid3 moved = Moved(pose, d.head<3>(), d.tail<3>()).Inverse();
    Eigen::Matrix<double, 6, 1> difference;
    Rigid3Manifold().Minus(moved.params.data(), camera.params.data(), difference.data());
    found += difference * difference.transpose() / kSamples;
  }
  const auto sigma = expected.diagonal().cwiseSqrt().eval();
  // Five standard errors of a sample covariance.
  EXPECT_LT((found - expected).cwiseQuotient(sigma * sigma.transpose()).cwiseAbs().maxCoeff(),
            5.0 * std::sqrt(2.0 / kSamples));
}

}  // namespace
}  // namespace msc_vo
