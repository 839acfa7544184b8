// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Custom factors in both back-ends: optimum, covariances, robust losses, undefined steps.

#include "msc_vo/bundle_adjustment/custom_factor.h"

#include <cmath>
#include <string>

#include "tests/support/ceres_covariance.h"
#include "tests/support/custom_factors.h"
#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"
#include <ceres/loss_function.h>
#include <ceres/numeric_diff_cost_function.h>

#include "msc_vo/bundle_adjustment/window_covariance.h"
#include "msc_vo/factors/unit_vector_manifold.h"

namespace msc_vo {
namespace {

// Distance of the middle of line a from the plane through the middle of line b across `normal`.
struct LineOffset {
  Eigen::Vector3d normal;
  double measured, sigma;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    residual[0] = T(-measured);
    for (int i = 0; i < 3; ++i) {
      residual[0] += 0.5 * normal[i] * (a[i] + a[i + 3] - b[i] - b[i + 3]);
    }
    residual[0] /= sigma;
    return true;
  }
};

// Distance of a point from the optical centre of a camera.
struct Range {
  double measured, sigma;

  bool operator()(const double* pose, const double* point, double* residual) const {
    Rigid3 cam_from_world;
    cam_from_world.params = Eigen::Matrix<double, 7, 1>(pose);
    residual[0] = ((cam_from_world * Eigen::Vector3d(point)).norm() - measured) / sigma;
    return true;
  }
};

// Direction of a line along the first Manhattan axis, and the axis along a unit vector.
struct LineAlongAxis {
  double sigma;

  template <typename T>
  bool operator()(const T* line, const T* axes, const T* direction, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector> start(line), end(line + 3), unit(direction);
    const Vector axis = Eigen::Map<const Eigen::Quaternion<T>>(axes) * Vector::UnitX();
    Eigen::Map<Vector> r(residual), s(residual + 3);
    r = (end - start).normalized().cross(axis) / T(sigma);
    s = axis.cross(unit) / T(sigma);
    return true;
  }
};

// Distances of `Points` points from a known plane, normal * x = offset.
template <int Points>
struct PlaneDistance {
  Eigen::Vector3d normal;
  double offset, sigma;

  template <typename T>
  bool operator()(const T* points, T* residual) const {
    for (int k = 0; k < Points; ++k) {
      residual[k] = T(-offset);
      for (int i = 0; i < 3; ++i) residual[k] += normal[i] * points[3 * k + i];
      residual[k] /= sigma;
    }
    return true;
  }
};

struct AxisPrior {
  template <typename T>
  bool operator()(const T* axes, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = axes[i] / 0.2;
    return true;
  }
};

// 1 / x - measured, undefined where x is not positive.
struct Inverse {
  double measured;

  template <typename T>
  bool operator()(const T* x, T* residual) const {
    if (!(x[0] > 0.0)) return false;
    residual[0] = 1.0 / x[0] - measured;
    return true;
  }
};

class CustomFactorTest : public ::testing::TestWithParam<BundleAdjustmentSolver> {
 protected:
  CustomFactorTest() {
    scene_.num_keyframes = 6;
    scene_.num_points = 40;
    scene_.num_lines = 12;
    options_.solver = GetParam();
    options_.first_iterations = options_.second_iterations = 50;
    window_ = MakeTestWindow(scene_);
    data_ = window_.data;
  }

  int64_t Keyframe(int i) const { return data_.keyframes[i].id; }
  int64_t Point(int i) const { return data_.points[i].id; }
  int64_t Line(int i) const { return data_.lines[i].id; }
  Rigid3 TruePose(int i) const { return window_.truth.keyframes[i].cam_from_world; }

  // Wheel odometry between consecutive keyframes, in units of which `scale` are a metre.
  void AddWheelOdometry(double scale, int64_t extra, double initial_scale = 1.0) {
    data_.extra_blocks.push_back({extra, Eigen::VectorXd::Constant(1, initial_scale), {}, false});
    for (int i = 1; i < scene_.num_keyframes; ++i) {
      const Rigid3 b_from_a = TruePose(i) * TruePose(i - 1).Inverse();
      data_.custom_factors.push_back(MakeCustomFactor<3, 7, 7, 1>(
          "wheel", ScaledTranslation{b_from_a.translation() / scale, 0.001},
          {BlockId::Pose(Keyframe(i - 1)), BlockId::Pose(Keyframe(i)), BlockId::Extra(extra)}));
    }
  }
  // Factors over every kind of block: two points, a pose and a point, two lines with and without
  // pairs, and a line with the Manhattan axes and an extra block on a sphere.
  void AddOneOfEachKind() {
    const auto& points = window_.truth.points;
    const auto& lines = window_.truth.lines;
    AddWheelOdometry(1.1, 7);
    data_.custom_factors.push_back(MakeCustomFactor<3, 3, 3>(
        "points", PointDifference{points[1].position - points[0].position, 0.01},
        {BlockId::Point(Point(0)), BlockId::Point(Point(1))}));
    const double range = (TruePose(3) * points[2].position).norm();
    CustomFactor range_factor;
    range_factor.name = "range";
    range_factor.cost =
        std::make_shared<ceres::NumericDiffCostFunction<Range, ceres::CENTRAL, 1, 7, 3>>(
            new Range{range, 0.01});
    range_factor.blocks = {BlockId::Pose(Keyframe(3)), BlockId::Point(Point(2))};
    data_.custom_factors.push_back(range_factor);
    for (const int other : {4, 8, 11}) {
      const Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
      const double offset = normal.dot(lines[0].segment.At(0.5) - lines[other].segment.At(0.5));
      data_.custom_factors.push_back(
          MakeCustomFactor<1, 6, 6>("lines", LineOffset{normal, offset, 0.005},
                                    {BlockId::Line(Line(0)), BlockId::Line(Line(other))}));
    }
    data_.axes.emplace();
    data_.axes->fixed = false;
    data_.axes->world_from_axes = Eigen::Quaterniond(ExpSO3({0.03, -0.02, 0.01}));
    data_.extra_blocks.push_back({9, Eigen::Vector3d(1.0, 0.05, 0.02).normalized(),
                                  std::make_shared<UnitVectorManifold>(), false});
    data_.custom_factors.push_back(MakeCustomFactor<6, 6, 4, 3>(
        "axis", LineAlongAxis{0.01}, {BlockId::Line(Line(3)), BlockId::Axes(), BlockId::Extra(9)}));
    data_.custom_factors.push_back(
        MakeCustomFactor<3, 4>("axis prior", AxisPrior(), {BlockId::Axes()}));
    for (const int i : {1, 5, 6}) AddPlane(i, /*line=*/4 + i);
    AddPairs();
  }
  // A known plane through a point, and one that contains a line.
  void AddPlane(int point, int line) {
    const Eigen::Vector3d x = window_.truth.points[point].position;
    data_.custom_factors.push_back(
        MakeCustomFactor<1, 3>("plane", PlaneDistance<1>{Eigen::Vector3d::UnitX(), x.x(), 0.0005},
                               {BlockId::Point(Point(point))}));
    const LineSegment3 segment = window_.truth.lines[line].segment;
    const Eigen::Vector3d normal = (segment.end - segment.start).unitOrthogonal();
    data_.custom_factors.push_back(MakeCustomFactor<2, 6>(
        "plane", PlaneDistance<2>{normal, normal.dot(Eigen::Vector3d(segment.start)), 0.002},
        {BlockId::Line(Line(line))}));
  }
  // Some of the lines of custom factors are in pairs, with lines in the reduced system and not.
  void AddPairs() {
    const auto add = [this](int i, int j) {
      (i % 3 == j % 3 ? data_.parallel_pairs : data_.perpendicular_pairs)
          .push_back({Line(i), Line(j), 0.02});
    };
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) add(i, j);
    }
    for (int i = 5; i < 9; ++i) add(4, i);
  }

  TestWindowOptions scene_;
  TestWindow window_;
  BundleAdjustmentOptions options_;
  WindowData data_;
};

TEST_P(CustomFactorTest, ReachesTheOptimumOfCeres) {
  AddOneOfEachKind();
  BundleAdjustmentOptions reference = options_;
  reference.solver = BundleAdjustmentSolver::kCeres;
  WindowData expected = data_;
  const BundleAdjustmentSummary a = LocalBundleAdjustment(reference, &expected);
  const BundleAdjustmentSummary b = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(a.usable && b.usable) << a.BriefReport() << b.BriefReport();
  EXPECT_EQ(b.custom.num_residual_blocks, static_cast<int>(data_.custom_factors.size()));
  EXPECT_GT(b.custom.initial_cost, 10.0 * b.custom.final_cost);
  EXPECT_NEAR(b.initial_cost, a.initial_cost, 1e-9 * a.initial_cost);
  EXPECT_NEAR(b.final_cost, a.final_cost, 1e-6 * a.final_cost);
  for (size_t i = 0; i < data_.keyframes.size(); ++i) {
    EXPECT_LT(Distance(data_.keyframes[i].cam_from_world, expected.keyframes[i].cam_from_world),
              1e-4);
  }
  for (size_t i = 0; i < data_.extra_blocks.size(); ++i) {
    EXPECT_LT((data_.extra_blocks[i].value - expected.extra_blocks[i].value).norm(), 1e-4);
  }
  EXPECT_LT(data_.axes->world_from_axes.angularDistance(expected.axes->world_from_axes), 1e-4);
  EXPECT_THAT(data_.points[0].position, IsNear(expected.points[0].position, 1e-3));
  EXPECT_THAT(data_.lines[0].segment.end, IsNear(expected.lines[0].segment.end, 1e-3));
}

TEST_P(CustomFactorTest, EstimatesAScale) {
  AddWheelOdometry(1.1, 7);
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  const WindowCovariance covariance = EstimateCovariance(options_, data_, {{}, {}, {}, {7}});
  ASSERT_TRUE(covariance.extra_blocks[0]);
  const double sigma = std::sqrt((*covariance.extra_blocks[0])(0, 0));
  EXPECT_LT(sigma, 0.02);
  EXPECT_NEAR(data_.extra_blocks[0].value[0], 1.1, 4.0 * sigma);
}

TEST_P(CustomFactorTest, HasTheCovariancesOfCeres) {
  AddOneOfEachKind();
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  CovarianceSelection all;
  for (const auto& k : data_.keyframes) all.keyframes.push_back(k.id);
  for (const auto& p : data_.points) all.points.push_back(p.id);
  for (const auto& l : data_.lines) all.lines.push_back(l.id);
  all.extra_blocks = {7, 9};
  const WindowCovariance found = EstimateCovariance(options_, data_, all);
  CeresCovariance expected(options_, data_);
  for (size_t i = scene_.num_fixed; i < data_.keyframes.size(); ++i) {
    ExpectSameCovariance(found.keyframes[i], expected.Of<6>(expected.state_.PoseBlock(i)));
  }
  for (size_t i = 0; i < data_.points.size(); ++i) {
    ExpectSameCovariance(found.points[i], expected.Of<3>(expected.state_.PointBlock(i)));
  }
  for (size_t i = 0; i < data_.lines.size(); ++i) {
    ExpectSameCovariance(found.lines[i], expected.Of<6>(expected.state_.LineBlock(i)));
  }
  ExpectSameCovariance(found.extra_blocks[0],
                       Eigen::MatrixXd(expected.Of<1>(expected.state_.ExtraBlock(0))));
  ExpectSameCovariance(found.extra_blocks[1],
                       Eigen::MatrixXd(expected.Of<2>(expected.state_.ExtraBlock(1))));
}

TEST_P(CustomFactorTest, HoldsFixedBlocks) {
  AddWheelOdometry(1.1, 7, 1.05);
  data_.extra_blocks[0].fixed = true;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  EXPECT_EQ(data_.extra_blocks[0].value[0], 1.05);
  const WindowCovariance covariance = EstimateCovariance(options_, data_, {{}, {}, {}, {7}});
  EXPECT_EQ(*covariance.extra_blocks[0], Eigen::MatrixXd::Zero(1, 1));
}

TEST_P(CustomFactorTest, KeepsUnusedExtraBlocks) {
  data_.extra_blocks.push_back({7, Eigen::VectorXd::Constant(2, 0.5), {}, false});
  WindowData without = window_.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  ASSERT_TRUE(LocalBundleAdjustment(options_, &without).usable);
  EXPECT_EQ(data_.extra_blocks[0].value, Eigen::VectorXd::Constant(2, 0.5));
  data_.extra_blocks.clear();
  EXPECT_TRUE(SameState(data_, without));
  EXPECT_FALSE(EstimateCovariance(options_, window_.data, {}).extra_blocks.size());
}

TEST_P(CustomFactorTest, PullsLandmarksOntoAKnownPlane) {
  for (int i = 0; i < scene_.num_points; ++i) AddPlane(i, i % scene_.num_lines);
  const auto squared_offsets = [this](const WindowData& data) {
    double sum = 0.0;
    for (size_t i = 0; i < data.points.size(); ++i) {
      sum += std::pow(data.points[i].position.x() - window_.truth.points[i].position.x(), 2);
    }
    return sum;
  };
  WindowData without = window_.data;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &without).usable);
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable);
  EXPECT_LT(squared_offsets(data_), 0.25 * squared_offsets(without));
  if (options_.solver != BundleAdjustmentSolver::kBlockSchur) return;
  // Factors on single landmarks leave these eliminated: only free poses are in the reduced system.
  EXPECT_EQ(summary.schur_structure, "block Schur, " +
                                         std::to_string(scene_.num_keyframes - scene_.num_fixed) +
                                         " poses, 0 line directions");
}

TEST_P(CustomFactorTest, RobustLossResistsAnOutlier) {
  AddWheelOdometry(1.0, 7);
  data_.extra_blocks[0].fixed = true;
  data_.custom_factors[3] = MakeCustomFactor<3, 7, 7, 1>(
      "slip", ScaledTranslation{{0.4, 0.0, 0.0}, 0.001}, data_.custom_factors[3].blocks);
  const auto error = [this](WindowData data) {
    EXPECT_TRUE(LocalBundleAdjustment(options_, &data).usable);
    double sum = 0.0;
    for (int i = 0; i < scene_.num_keyframes; ++i) {
      sum += Distance(data.keyframes[i].cam_from_world, TruePose(i));
    }
    return sum;
  };
  const double plain = error(data_);
  data_.custom_factors[3].loss = std::make_shared<ceres::CauchyLoss>(1.0);
  EXPECT_LT(error(data_), 0.2 * plain);
}

TEST_P(CustomFactorTest, ConstrainsALandmarkWithoutObservations) {
  const int64_t id = 77777;
  data_.points.push_back({id, Eigen::Vector3d::Zero(), false});
  const Eigen::Vector3d offset(0.1, 0.2, 0.3);
  data_.custom_factors.push_back(MakeCustomFactor<3, 3, 3>(
      "points", PointDifference{offset, 0.01}, {BlockId::Point(Point(0)), BlockId::Point(id)}));
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  EXPECT_THAT(data_.points.back().position, IsNear(data_.points[0].position + offset, 1e-6));
}

TEST_P(CustomFactorTest, FixesTheGauge) {
  for (auto& keyframe : data_.keyframes) keyframe.fixed = false;
  for (const int i : {0, 5}) {
    CustomFactor factor;
    factor.name = "marker";
    factor.cost.reset(
        PosePrior::Create(PosePrior(TruePose(i), Eigen::Matrix<double, 6, 6>::Identity() * 1e-6)));
    factor.blocks = {BlockId::Pose(Keyframe(i))};
    data_.custom_factors.push_back(factor);
  }
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  EXPECT_LT(Distance(data_.keyframes[3].cam_from_world, TruePose(3)), 0.02);
}

TEST_P(CustomFactorTest, RejectsStepsToWhereAFactorIsUndefined) {
  // From x = 5 the Gauss-Newton step leads to a negative x.
  data_.extra_blocks.push_back({1, Eigen::VectorXd::Constant(1, 5.0), {}, false});
  data_.custom_factors.push_back(
      MakeCustomFactor<1, 1>("inverse", Inverse{2.0}, {BlockId::Extra(1)}));
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_, &data_);
  ASSERT_TRUE(summary.usable) << summary.BriefReport();
  EXPECT_NEAR(data_.extra_blocks[0].value[0], 0.5, 1e-3);
}

TEST_P(CustomFactorTest, IsDeterministic) {
  AddOneOfEachKind();
  WindowData other = data_;
  ASSERT_TRUE(LocalBundleAdjustment(options_, &data_).usable);
  ASSERT_TRUE(LocalBundleAdjustment(options_, &other).usable);
  EXPECT_TRUE(SameState(data_, other));
}

std::string NameOf(const ::testing::TestParamInfo<BundleAdjustmentSolver>& solver) {
  switch (solver.param) {
    case BundleAdjustmentSolver::kBlockSchur:
      return "BlockSchur";
    case BundleAdjustmentSolver::kCeres:
      return "Ceres";
    case BundleAdjustmentSolver::kCeresSuiteSparse:
      return "SuiteSparse";
  }
  return "";
}

INSTANTIATE_TEST_SUITE_P(Solvers, CustomFactorTest,
                         ::testing::Values(BundleAdjustmentSolver::kBlockSchur,
                                           BundleAdjustmentSolver::kCeres,
                                           BundleAdjustmentSolver::kCeresSuiteSparse),
                         NameOf);

}  // namespace
}  // namespace msc_vo
