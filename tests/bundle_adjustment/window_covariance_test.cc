// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/window_covariance.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "tests/support/ceres_covariance.h"
#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"
#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>

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
  bool with_structure_ = false;
};

TEST_F(WindowCovarianceTest, MatchesCeres) {
  for (const bool with_structure : {false, true}) {
    SCOPED_TRACE(with_structure);
    with_structure_ = with_structure;
    options_.reject_chi2_3 = options_.reject_chi2_4 = 1e9;  // no observation loses only its depth
    Solve();
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
  EXPECT_THAT(message({{9999}, {}, {}}), ::testing::HasSubstr("keyframe 9999 is selected but not"));
  EXPECT_THAT(message({{}, {-1}, {}}), ::testing::HasSubstr("point -1 is selected but not"));
  EXPECT_THAT(message({{}, {}, {8888}}), ::testing::HasSubstr("line 8888 is selected but not"));
  data_.keyframes[0].cam_from_world.params[3] = 7.0;
  EXPECT_THAT(message({}), ::testing::HasSubstr("rotation is not a unit quaternion"));
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

// Monte Carlo test: the squared Mahalanobis error has a chi-square distribution. Windows differ in
// landmarks, noise and initial state.
class Consistency {
 public:
  explicit Consistency(double noise, int num_keyframes = 5) {
    scene_.num_keyframes = num_keyframes;
    scene_.num_fixed = 1;
    scene_.num_points = std::max(40, 8 * num_keyframes);
    scene_.num_lines = std::max(10, 2 * num_keyframes);
    scene_.noise = noise;
    // In the middle: others of 20 may share few landmarks with the fixed one.
    keyframe_ = (num_keyframes + 1) / 2;
    point_ = scene_.num_points / 2;
  }
  // Every second point is observed with so much noise more than its sigma says.
  void SetFactorOfSecondPoints(double factor) { factor_ = factor; }

  void SetLineSigma(double pixels) { scene_.line_sigma = pixels; }

  // Mean squared Mahalanobis errors over the windows, per degree of freedom. The covariances are
  // those with the options of the solver, or with others.
  void Run(const BundleAdjustmentOptions& options, int num_windows) {
    Run(options, options, num_windows);
  }
  void Run(const BundleAdjustmentOptions& options, const BundleAdjustmentOptions& of_covariance,
           int num_windows) {
    for (int i = 0; i < num_windows; ++i) {
      scene_.seed = 100 + i;
      TestWindow window = MakeTestWindow(scene_);
      AddNoise(&window);
      Add(options, of_covariance, window);
    }
    pose /= 6.0 * num_windows;
    pose_directions /= num_windows;
    point /= 3.0 * num_windows;
    line /= 4.0 * num_windows;
  }
  double pose = 0.0, point = 0.0, line = 0.0;
  // Of the pose along the eigenvectors of its covariance, the best known one first.
  Eigen::Matrix<double, 6, 1> pose_directions = Eigen::Matrix<double, 6, 1>::Zero();

 private:
  void AddNoise(TestWindow* window) const {
    std::map<int64_t, Rigid3> poses;
    for (const auto& keyframe : window->truth.keyframes)
      poses[keyframe.id] = keyframe.cam_from_world;
    std::map<int64_t, Eigen::Vector3d> noisy_points;
    for (size_t i = 1; i < window->truth.points.size(); i += 2) {
      noisy_points[window->truth.points[i].id] = window->truth.points[i].position;
    }
    for (WindowData::PointObservation& o : window->data.point_observations) {
      const auto noisy = noisy_points.find(o.point);
      if (noisy == noisy_points.end()) continue;
      const Eigen::Vector3d in_cam = poses[o.keyframe] * noisy->second;
      const Eigen::Vector2d exact = window->truth.camera.Project(in_cam);
      o.pixel = exact + factor_ * (o.pixel - exact);
      o.inverse_depth = 1.0 / in_cam.z() + factor_ * (o.inverse_depth - 1.0 / in_cam.z());
    }
  }
  void Add(const BundleAdjustmentOptions& options, const BundleAdjustmentOptions& of_covariance,
           const TestWindow& window) {
    WindowData data = window.data;
    ASSERT_TRUE(LocalBundleAdjustment(options, &data).usable);
    const WindowCovariance covariance = EstimateCovariance(
        of_covariance, data,
        {{data.keyframes[keyframe_].id}, {data.points[point_].id}, {data.lines[7].id}});
    Eigen::Matrix<double, 6, 1> error;
    Rigid3Manifold().Minus(data.keyframes[keyframe_].cam_from_world.params.data(),
                           window.truth.keyframes[keyframe_].cam_from_world.params.data(),
                           error.data());
    pose += error.dot(covariance.keyframes[0]->inverse() * error);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(
        *covariance.keyframes[0]);
    pose_directions +=
        (eigen.eigenvectors().transpose() * error).cwiseAbs2().cwiseQuotient(eigen.eigenvalues());
    const Eigen::Vector3d off = data.points[point_].position - window.truth.points[point_].position;
    point += off.dot(covariance.points[0]->inverse() * off);

    // A line has four degrees of freedom: the positions of its end points across it.
    const LineSegment3& truth = window.truth.lines[7].segment;
    const LineSegment3& found = data.lines[7].segment;
    const Eigen::Vector3d d = truth.Direction(), u = d.unitOrthogonal(), v = d.cross(u);
    Eigen::Matrix<double, 4, 6> across = Eigen::Matrix<double, 4, 6>::Zero();
    across.block<1, 3>(0, 0) = across.block<1, 3>(2, 3) = u.transpose();
    across.block<1, 3>(1, 0) = across.block<1, 3>(3, 3) = v.transpose();
    Eigen::Matrix<double, 6, 1> ends;
    ends << Offset(truth, found.start), Offset(truth, found.end);
    const Eigen::Vector4d distance = across * ends;
    line += distance.dot((across * *covariance.lines[0] * across.transpose()).inverse() * distance);
  }
  // Vector from the infinite line to a point.
  static Eigen::Vector3d Offset(const LineSegment3& line, const Eigen::Vector3d& x) {
    const Eigen::Vector3d d = line.Direction(), w = x - line.start;
    return w - d.dot(w) * d;
  }

  TestWindowOptions scene_;
  double factor_ = 1.0;           // of the noise of every second point
  int keyframe_ = 0, point_ = 0;  // that are compared
};

// 99 % bound on |m / k - 1|, where m is the mean of n chi-square variables with k degrees of
// freedom.
double Bound(int n, int k) { return 2.576 * std::sqrt(2.0 / (double(n) * k)); }

// Plain least squares, the estimator for normal noise.
BundleAdjustmentOptions PlainLeastSquares() {
  BundleAdjustmentOptions options;
  options.point_reprojection.huber = options.point_depth.huber = 1e3;
  options.line_reprojection.huber = options.line_depth.huber = 1e3;
  options.reject_chi2_2 = options.reject_chi2_3 = options.reject_chi2_4 = 1e9;
  return options;
}

TEST(WindowCovarianceConsistency, ErrorsMatchTheCovariance) {
  constexpr int kWindows = 300;
  Consistency errors(1.0);
  errors.Run(PlainLeastSquares(), kWindows);
  EXPECT_NEAR(errors.pose, 1.0, Bound(kWindows, 6));
  EXPECT_NEAR(errors.point, 1.0, Bound(kWindows, 3));
  EXPECT_NEAR(errors.line, 1.0, Bound(kWindows, 4));
}

// Lines are as accurate as in real images: with one pixel, short ones that point at the camera turn
// (docs/lab/noise.md). The correlation of both ends is neglected, which makes errors a little
// smaller than expected.
TEST(WindowCovarianceConsistency, NoDirectionIsUnderestimated) {
  constexpr int kWindows = 300;
  for (const int num_keyframes : {3, 5, 10, 20}) {
    Consistency errors(1.0, num_keyframes);
    errors.SetLineSigma(0.25);
    errors.Run(PlainLeastSquares(), kWindows);
    EXPECT_LT(errors.pose_directions.maxCoeff(), 1.0 + Bound(kWindows, 1)) << num_keyframes;
    EXPECT_GT(errors.pose_directions.minCoeff(), 0.6) << num_keyframes;
  }
}

TEST(WindowCovarianceConsistency, RobustLossesChangeTheErrorsLittle) {
  constexpr int kWindows = 300;
  Consistency errors(1.0);
  errors.Run(BundleAdjustmentOptions(), kWindows);
  // Robust weights below one also affect inliers; the effect stays below a tenth.
  EXPECT_NEAR(errors.pose, 1.0, 0.1 + Bound(kWindows, 6));
  EXPECT_NEAR(errors.point, 1.0, 0.1 + Bound(kWindows, 3));
  EXPECT_NEAR(errors.line, 1.0, 0.1 + Bound(kWindows, 4));
}

BundleAdjustmentOptions LeastSquaresWithEstimatedNoise() {
  BundleAdjustmentOptions options = PlainLeastSquares();
  options.landmark_noise.enabled = true;
  options.first_iterations = options.second_iterations = 50;  // 20 keyframes
  return options;
}

// The distribution of an error whose sigma is estimated is not quite chi-square.
constexpr double kSlack = 0.05;

TEST(WindowCovarianceConsistency, ContainsTheErrorOfEstimatedNoise) {
  constexpr int kWindows = 300;
  for (const int num_keyframes : {3, 5, 10, 20}) {
    Consistency errors(1.0, num_keyframes);
    errors.Run(LeastSquaresWithEstimatedNoise(), kWindows);
    EXPECT_NEAR(errors.pose, 1.0, kSlack + Bound(kWindows, 6)) << num_keyframes;
    EXPECT_NEAR(errors.point, 1.0, kSlack + Bound(kWindows, 3)) << num_keyframes;
    // Too large for few views: of the two rows of a depth, one counts for the noise of a line.
    EXPECT_LT(errors.line, 1.0 + kSlack + Bound(kWindows, 4)) << num_keyframes;
    EXPECT_GT(errors.line, 0.7) << num_keyframes;
  }
}

TEST(WindowCovarianceConsistency, ContainsTheErrorOfNoiseThatDiffers) {
  constexpr int kWindows = 300;
  // Landmarks that happen to have small residuals count too much: 1.15 with three keyframes.
  for (const int num_keyframes : {3, 10}) {
    Consistency errors(1.0, num_keyframes);
    errors.SetFactorOfSecondPoints(3.0);
    errors.Run(LeastSquaresWithEstimatedNoise(), kWindows);
    EXPECT_NEAR(errors.pose, 1.0, 0.1 + Bound(kWindows, 6)) << num_keyframes;
    EXPECT_NEAR(errors.point, 1.0, 0.1 + Bound(kWindows, 3)) << num_keyframes;
  }
}

// As the mapper solves windows.
TEST(WindowCovarianceConsistency, ContainsTheErrorOfEstimatedNoiseAfterFewRobustSteps) {
  constexpr int kWindows = 300;
  BundleAdjustmentOptions options;
  options.landmark_noise.enabled = true;
  options.first_iterations = 2;
  options.second_iterations = 1;
  for (const int num_keyframes : {3, 10}) {
    Consistency errors(1.0, num_keyframes);
    errors.Run(options, kWindows);
    EXPECT_NEAR(errors.pose, 1.0, 0.1 + Bound(kWindows, 6)) << num_keyframes;
    EXPECT_NEAR(errors.point, 1.0, 0.1 + Bound(kWindows, 3)) << num_keyframes;
  }
}

TEST(WindowCovarianceConsistency, NeedsTheErrorOfEstimatedNoise) {
  constexpr int kWindows = 300;
  BundleAdjustmentOptions factors_alone = LeastSquaresWithEstimatedNoise();
  factors_alone.landmark_noise.enabled = false;
  for (const int num_keyframes : {3, 5}) {
    Consistency errors(1.0, num_keyframes);
    errors.Run(LeastSquaresWithEstimatedNoise(), factors_alone, kWindows);
    EXPECT_GT(errors.pose, 1.0 + kSlack + Bound(kWindows, 6)) << num_keyframes;
    EXPECT_GT(errors.point, 1.0 + kSlack + Bound(kWindows, 3)) << num_keyframes;
  }
}

TEST(WindowCovarianceConsistency, DetectsUnderestimatedNoise) {
  Consistency errors(2.0);
  errors.Run(PlainLeastSquares(), 100);
  EXPECT_GT(errors.pose, 3.0);
  EXPECT_GT(errors.point, 3.0);
  EXPECT_GT(errors.line, 3.0);
}

}  // namespace
}  // namespace msc_vo
