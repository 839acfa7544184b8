// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/normal_prior.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/factors/self_calibrating_reprojection.h"
#include "msc_vo/self_calibration/calibration_evidence.h"
#include "msc_vo/self_calibration/pair_view.h"

namespace msc_vo {

namespace {

using S = SensorCorrection;
constexpr int kColorSize = S::kColorSize;
using ColorVector = Eigen::Matrix<double, kColorSize, 1>;

// Bounds of the computing time.
constexpr size_t kMaxKeyframes = 100;
constexpr int kMaxSteps = 25;
// Relative change of the cost that ends the iteration: with thousands of residuals of size one, a
// change far below what a standard deviation makes.
constexpr double kFunctionTolerance = 3e-5;
// Fewest observations that make an adjustment worth its time.
constexpr size_t kMinObservations = 300;
// Fewest points that a keyframe must observe.
constexpr int kMinPointsOfKeyframe = 10;
// Square root of the 95 % quantile of chi-square with three degrees of freedom.
constexpr double kLossThreshold = 2.795;
// Relative error of depth: also what a wrong registration to colour, or an error that depends on
// the distance or the place in the image, amounts to.
constexpr double kDepthError = 0.1;
// Damping of poses and points when they are marginalised, relative to their information: it bounds
// what hardly anything determines.
constexpr double kMarginalDamping = 1e-6;

bool IsInFront(const Map& map, const PointLandmark& point, KeyframeId keyframe) {
  return (map.CamFromWorld(keyframe) * point.position).z() > kMinCameraDepth;
}

// The observations of a point by keyframes of this run: those of earlier sessions may be of another
// camera.
std::vector<Observation> ObservationsOfThisRun(const Map& map, const PointLandmark& point) {
  std::vector<Observation> observations;
  for (const Observation& observation : point.observations) {
    if (!map.IsOfEarlierSession(observation.keyframe)) observations.push_back(observation);
  }
  return observations;
}

// The points with most observations, in order of their ids.
std::vector<LandmarkId> SelectPoints(const Map& map, size_t max_observations) {
  std::vector<std::pair<size_t, LandmarkId>> ranked;
  for (const auto& [id, point] : map.points()) {
    const size_t count = ObservationsOfThisRun(map, point).size();
    if (count >= 2) ranked.emplace_back(count, id);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<LandmarkId> selected;
  size_t num_observations = 0;
  for (const auto& [count, id] : ranked) {
    num_observations += count;
    if (num_observations > max_observations) break;
    selected.push_back(id);
  }
  std::sort(selected.begin(), selected.end());
  return selected;
}

// The keyframes that observe most of the points.
std::set<KeyframeId> SelectKeyframes(const Map& map, const std::vector<LandmarkId>& points) {
  std::map<KeyframeId, int> counts;
  for (const LandmarkId id : points) {
    for (const Observation& observation :
         ObservationsOfThisRun(map, *map.Find<PointLandmark>(id))) {
      ++counts[observation.keyframe];
    }
  }
  std::vector<std::pair<int, KeyframeId>> ranked;
  for (const auto& [id, count] : counts) {
    if (count >= kMinPointsOfKeyframe) ranked.emplace_back(-count, id);
  }
  std::sort(ranked.begin(), ranked.end());
  std::set<KeyframeId> selected;
  for (const auto& [count, id] : ranked) {
    if (selected.size() < kMaxKeyframes) selected.insert(id);
  }
  return selected;
}

// The observations of a point that are used: those of the keyframes that have it in front of them.
std::vector<Observation> SelectObservations(const Map& map, const PointLandmark& point,
                                            const std::set<KeyframeId>& keyframes) {
  std::vector<Observation> selected;
  for (const Observation& observation : point.observations) {
    if (keyframes.count(observation.keyframe) == 0) continue;
    if (IsInFront(map, point, observation.keyframe)) selected.push_back(observation);
  }
  return selected;
}

SelfCalibratingReprojection::Measurement MeasurementOf(const Keyframe& keyframe,
                                                       const PointLandmark& point, int feature) {
  const Frame& frame = *keyframe.frame;
  const PointFeature& observed = frame.points[feature];
  SelfCalibratingReprojection::Measurement measurement;
  measurement.pixel = MakePairView(frame.intrinsics->distortion, frame, observed).pixel;
  measurement.sigma = observed.sigma * point.noise;
  if (point.has_false_depth) return measurement;
  measurement.inverse_depth = observed.inverse_depth;
  measurement.inverse_depth_sigma =
      std::hypot(observed.inverse_depth_sigma * point.noise, kDepthError * observed.inverse_depth);
  return measurement;
}

// Poses and points of a map, and the correction of the colour camera that all of them share. Ceres
// orders the blocks by address: they are elements of vectors, so that the result does not depend on
// the allocator.
class SelfCalibrationProblem {
 public:
  SelfCalibrationProblem(const CameraIntrinsics& given, const Map& map, const ColorVector& start,
                         size_t max_observations)
      : camera_(given.camera, given.distortion), correction_(start) {
    const std::vector<LandmarkId> points = SelectPoints(map, max_observations);
    const std::set<KeyframeId> keyframes = SelectKeyframes(map, points);
    for (const KeyframeId id : keyframes) {
      pose_index_.emplace(id, poses_.size());
      poses_.push_back(map.CamFromWorld(id));
    }
    points_.reserve(points.size());
    for (const LandmarkId id : points) {
      const PointLandmark& point = *map.Find<PointLandmark>(id);
      const std::vector<Observation> observations = SelectObservations(map, point, keyframes);
      if (observations.size() >= 2) AddPoint(map, point, observations);
    }
    AddPrior();
    HoldGauge();
  }

  size_t num_observations() const { return observations_.size(); }

  bool Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = kMaxSteps;
    options.function_tolerance = kFunctionTolerance;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (Eigen::Vector3d& point : points_) ordering->AddElementToGroup(point.data(), 0);
    for (double* pose : FreePoses()) ordering->AddElementToGroup(pose, 1);
    ordering->AddElementToGroup(correction_.data(), 2);
    options.linear_solver_ordering = ordering;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  // The information of the observations about the correction, without its prior.
  std::optional<CalibrationInformation> Marginalize() {
    ceres::Problem::EvaluateOptions options;
    for (Eigen::Vector3d& point : points_) options.parameter_blocks.push_back(point.data());
    for (double* pose : FreePoses()) options.parameter_blocks.push_back(pose);
    options.parameter_blocks.push_back(correction_.data());
    options.residual_blocks = observations_;
    std::vector<double> gradient;
    ceres::CRSMatrix crs;
    if (!problem_.Evaluate(options, nullptr, nullptr, &gradient, &crs)) return std::nullopt;
    const Eigen::SparseMatrix<double> jacobian =
        Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
            crs.num_rows, crs.num_cols, static_cast<Eigen::Index>(crs.values.size()),
            crs.rows.data(), crs.cols.data(), crs.values.data());
    return EliminateOthers(jacobian, Eigen::Map<Eigen::VectorXd>(gradient.data(), crs.num_cols));
  }

 private:
  void AddPoint(const Map& map, const PointLandmark& point,
                const std::vector<Observation>& observations) {
    points_.push_back(point.position);
    for (const Observation& observation : observations) {
      const Keyframe& keyframe = *map.FindKeyframe(observation.keyframe);
      Rigid3& pose = poses_[pose_index_.at(observation.keyframe)];
      const SelfCalibratingReprojection::Measurement measurement =
          MeasurementOf(keyframe, point, observation.feature);
      observations_.push_back(problem_.AddResidualBlock(
          SelfCalibratingReprojection::Create(camera_, measurement), &loss_, pose.params.data(),
          points_.back().data(), correction_.data()));
      point_information_ += 1.0 / (measurement.sigma * measurement.sigma);
    }
  }

  // Keeps near zero what the observations do not determine.
  void AddPrior() {
    const Eigen::MatrixXd inverse =
        WrongCalibrationSigma().head<kColorSize>().cwiseInverse().asDiagonal();
    problem_.AddResidualBlock(new ceres::NormalPrior(inverse, ColorVector::Zero()), nullptr,
                              correction_.data());
  }

  void HoldGauge() {
    for (Rigid3& pose : poses_) {
      if (problem_.HasParameterBlock(pose.params.data())) {
        problem_.SetManifold(pose.params.data(), &manifold_);
      }
    }
    for (Rigid3& pose : poses_) {
      if (!problem_.HasParameterBlock(pose.params.data())) continue;
      problem_.SetParameterBlockConstant(pose.params.data());
      return;
    }
  }

  std::vector<double*> FreePoses() {
    std::vector<double*> free;
    for (Rigid3& pose : poses_) {
      double* block = pose.params.data();
      if (problem_.HasParameterBlock(block) && !problem_.IsParameterBlockConstant(block)) {
        free.push_back(block);
      }
    }
    return free;
  }

  // The correction is in the last columns of the Jacobian.
  std::optional<CalibrationInformation> EliminateOthers(const Eigen::SparseMatrix<double>& jacobian,
                                                        const Eigen::VectorXd& gradient) const {
    const Eigen::Index num_others = jacobian.cols() - kColorSize;
    const Eigen::SparseMatrix<double> others = jacobian.leftCols(num_others);
    const Eigen::MatrixXd shared = jacobian.rightCols(kColorSize);
    Eigen::SparseMatrix<double> damped = others.transpose() * others;
    damped.diagonal() *= 1.0 + kMarginalDamping;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(damped);
    if (ldlt.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixXd coupling = others.transpose() * shared;
    const Eigen::MatrixXd solution = ldlt.solve(coupling);
    Eigen::Matrix<double, kColorSize, kColorSize> matrix =
        shared.transpose() * shared - coupling.transpose() * solution;
    matrix = (0.5 * (matrix + matrix.transpose())).eval();
    CalibrationInformation information;
    information.matrix.topLeftCorner<kColorSize, kColorSize>() = matrix;
    information.vector.head<kColorSize>() = matrix * correction_ - gradient.tail<kColorSize>() +
                                            solution.transpose() * gradient.head(num_others);
    information.point_information = point_information_ / static_cast<double>(poses_.size());
    if (!information.matrix.allFinite() || !information.vector.allFinite()) return std::nullopt;
    return information;
  }

  static ceres::Problem::Options ProblemOptions() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  CorrectedCamera camera_;
  ceres::HuberLoss loss_{kLossThreshold};
  Rigid3Manifold manifold_;
  ceres::Problem problem_{ProblemOptions()};
  ColorVector correction_;
  std::map<KeyframeId, size_t> pose_index_;
  std::vector<Rigid3> poses_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<ceres::ResidualBlockId> observations_;
  double point_information_ = 0.0;  // 1/pixels^2, of all images
};

}  // namespace

std::optional<CalibrationInformation> SelfCalibratingBundleAdjustment(
    const CameraIntrinsics& given, const Map& map, const SensorCorrection::Vector& start,
    size_t max_observations) {
  SelfCalibrationProblem problem(given, map, start.head<kColorSize>(), max_observations);
  if (problem.num_observations() < kMinObservations || !problem.Solve()) return std::nullopt;
  return problem.Marginalize();
}

}  // namespace msc_vo
