// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Whether the errors of solved windows are as large as EstimateCovariance says.

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/test_window.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "msc_vo/bundle_adjustment/window_covariance.h"
#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {
namespace {

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

TEST(NoiseCovarianceConsistency, RobustLossesChangeTheErrorsLittle) {
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

TEST(NoiseCovarianceConsistency, ContainsTheErrorOfEstimatedNoise) {
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

TEST(NoiseCovarianceConsistency, ContainsTheErrorOfNoiseThatDiffers) {
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
TEST(NoiseCovarianceConsistency, ContainsTheErrorOfEstimatedNoiseAfterFewRobustSteps) {
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

TEST(NoiseCovarianceConsistency, NeedsTheErrorOfEstimatedNoise) {
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
