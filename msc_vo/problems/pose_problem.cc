// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/pose_problem.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/problems/observation.h"
#include "msc_vo/problems/pose_factors.h"
#include "msc_vo/problems/validation.h"

namespace msc_vo {

namespace {

// Of every match.
struct Activities {
  std::vector<Activity> points;
  std::vector<Activity> lines;
  bool operator==(const Activities& other) const {
    return points == other.points && lines == other.lines;
  }
};

void Validate(const PoseOptions& options, const PoseData& data) {
  const auto fail = [](const std::string& who, const std::string& what) {
    throw std::invalid_argument("SolvePose: " + who + ": " + what);
  };
  std::string error;
  if (!options.IsValid(&error) || !data.camera.IsValid(&error)) fail("input", error);
  if (const char* what = PoseError(data.cam_from_world)) fail("prediction", what);
  for (size_t i = 0; i < data.points.size(); ++i) {
    const PoseData::Point& p = data.points[i];
    const char* what = PositionError(p.position);
    if (what == nullptr) {
      what = PointObservationError(p.pixel, p.sigma, p.inverse_depth, p.inverse_depth_sigma);
    }
    if (what != nullptr) fail("point " + std::to_string(i), what);
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    const PoseData::Line& l = data.lines[i];
    const char* what = MapLineError(l.map_segment);
    if (what == nullptr) what = LineObservationError(l.segment, l.sigma, l.has_depth, l.depth);
    if (what != nullptr) fail("line " + std::to_string(i), what);
  }
}

// Before anything is known of a match, it takes part if it is in front of the camera.
Activities AllInFront(const PoseOptions& options, const PoseData& data) {
  Activities all;
  for (const PoseData::Point& p : data.points) {
    const bool in_front = IsInFront(data.cam_from_world * p.position);
    all.points.push_back(
        {in_front, in_front && options.point_depth.enabled && p.inverse_depth > 0.0});
  }
  for (const PoseData::Line& l : data.lines) {
    const bool in_front = IsInFront(data.cam_from_world * l.map_segment);
    all.lines.push_back({in_front, in_front && options.line_depth.enabled && l.has_depth});
  }
  return all;
}

Activity ClassifyPoint(const PoseOptions& options, const PinholeCamera& camera, const Rigid3& pose,
                       const PoseData::Point& p) {
  const Eigen::Vector3d x = pose * p.position;
  if (!IsInFront(x)) return {};
  const bool has_depth = options.point_depth.enabled && p.inverse_depth > 0.0;
  Eigen::Vector2d pixels = Eigen::Vector2d::Zero();
  double depth = 0.0;
  if (options.point_reprojection.enabled) {
    PointReprojection(camera, p.pixel, p.sigma).Residual(0, x, pixels.data());
  }
  if (has_depth) DepthReprojection(p.inverse_depth, p.inverse_depth_sigma).Residual(0, x, &depth);
  Activity activity = TestChiSquare(pixels.squaredNorm(), depth * depth, options.reject_chi2_2,
                                    options.reject_chi2_3);
  activity.depth = activity.depth && has_depth;
  return activity;
}

Activity ClassifyLine(const PoseOptions& options, const PinholeCamera& camera, const Rigid3& pose,
                      const PoseData::Line& l) {
  const LineSegment3 line = pose * l.map_segment;
  if (!IsInFront(line)) return {};
  const auto chi_square = [&line](const auto& factor) {
    Eigen::Vector2d r;
    factor.Residual(0, Eigen::Vector3d(line.start), &r[0]);
    factor.Residual(1, Eigen::Vector3d(line.end), &r[1]);
    return r.squaredNorm();
  };
  const bool has_depth = options.line_depth.enabled && l.has_depth;
  const double pixels = options.line_reprojection.enabled
                            ? chi_square(MakeLineReprojection(camera, l.segment, l.sigma, line))
                            : 0.0;
  const double depth =
      has_depth ? chi_square(MakeLineDepthReprojection(camera, l.segment, l.depth, line)) : 0.0;
  Activity activity = TestChiSquare(pixels, depth, options.reject_chi2_2, options.reject_chi2_4);
  activity.depth = activity.depth && has_depth;
  return activity;
}

// Chi-square of a normal error of two coordinates in the median.
constexpr double kChiSquareMedian2 = 1.386;
// Fewer do not tell the noise of a frame.
constexpr size_t kMinPointsForNoise = 10;

// Square of how many times larger than their sigmas the errors of this frame's points are, by their
// median: within [1, max_frame_noise^2]. A blurred image shows all its points worse.
double SquaredFrameNoise(const PoseOptions& options, const PoseData& data, const Rigid3& pose) {
  std::vector<double> chi2;
  chi2.reserve(data.points.size());
  for (const PoseData::Point& p : data.points) {
    const Eigen::Vector3d in_cam = pose * p.position;
    if (!IsInFront(in_cam)) continue;
    chi2.push_back((data.camera.Project(in_cam) - p.pixel).squaredNorm() / (p.sigma * p.sigma));
  }
  if (chi2.size() < kMinPointsForNoise) return 1.0;
  const auto middle = chi2.begin() + static_cast<std::ptrdiff_t>(chi2.size() / 2);
  std::nth_element(chi2.begin(), middle, chi2.end());
  return std::clamp(*middle / kChiSquareMedian2, 1.0,
                    options.max_frame_noise * options.max_frame_noise);
}

// Chi-square test of every match over the terms that are enabled, outliers of earlier rounds
// included, in the noise of the frame.
Activities Classify(PoseOptions options, const PoseData& data, const Rigid3& pose) {
  const double noise2 = SquaredFrameNoise(options, data, pose);
  for (double* limit : {&options.reject_chi2_2, &options.reject_chi2_3, &options.reject_chi2_4}) {
    *limit *= noise2;
  }
  Activities result;
  for (const PoseData::Point& p : data.points) {
    result.points.push_back(ClassifyPoint(options, data.camera, pose, p));
  }
  for (const PoseData::Line& l : data.lines) {
    result.lines.push_back(ClassifyLine(options, data.camera, pose, l));
  }
  return result;
}

void AddPoints(const PoseOptions& options, const PoseData& data, const Activities& active,
               PoseFactors* factors) {
  for (size_t i = 0; i < data.points.size(); ++i) {
    const PoseData::Point& p = data.points[i];
    if (active.points[i].reprojection && options.point_reprojection.enabled) {
      factors->point_reprojection.blocks.push_back(
          {PointReprojection(data.camera, p.pixel, p.sigma), {p.position}});
    }
    if (active.points[i].depth) {
      factors->point_depth.blocks.push_back(
          {DepthReprojection(p.inverse_depth, p.inverse_depth_sigma), {p.position}});
    }
  }
}

void AddLines(const PoseOptions& options, const PoseData& data, const Activities& active,
              const Rigid3& pose, PoseFactors* factors) {
  for (size_t i = 0; i < data.lines.size(); ++i) {
    const PoseData::Line& l = data.lines[i];
    if (!active.lines[i].reprojection) continue;
    const LineSegment3 line = pose * l.map_segment;
    const std::array<Eigen::Vector3d, 2> ends{l.map_segment.start, l.map_segment.end};
    if (options.line_reprojection.enabled) {
      factors->line_reprojection.blocks.push_back(
          {MakeLineReprojection(data.camera, l.segment, l.sigma, line), ends});
    }
    if (active.lines[i].depth) {
      factors->line_depth.blocks.push_back(
          {MakeLineDepthReprojection(data.camera, l.segment, l.depth, line), ends});
    }
  }
}

// The factors of the active matches, linearised (as far as sigmas go) at `pose`.
PoseFactors BuildFactors(const PoseOptions& options, const PoseData& data, const Activities& active,
                         const Rigid3& pose, bool robust) {
  PoseFactors factors;
  if (robust) {
    factors.point_reprojection.huber = options.point_reprojection.huber;
    factors.point_depth.huber = options.point_depth.huber;
    factors.line_reprojection.huber = options.line_reprojection.huber;
    factors.line_depth.huber = options.line_depth.huber;
  }
  AddPoints(options, data, active, &factors);
  AddLines(options, data, active, pose, &factors);
  return factors;
}

// Solves and classifies up to `num_rounds` times; earlier if that changes nothing any more. False
// if there are fewer than six rows or the solver failed.
bool RunRounds(const PoseOptions& options, const PoseData& data, int num_rounds, bool robust,
               Activities* active, Rigid3* pose) {
  for (int round = 0; round < num_rounds; ++round) {
    const PoseFactors factors = BuildFactors(options, data, *active, *pose, robust);
    if (factors.NumRows() < 6) return false;
    const PoseTermination end = MinimizePose(factors, options.iterations_per_round, pose);
    if (end == PoseTermination::kFailed) return false;
    Activities next = Classify(options, data, *pose);
    const bool settled = end == PoseTermination::kConverged && next == *active;
    *active = std::move(next);
    if (settled) break;
  }
  return true;
}

// Inverse of J^T J, or nothing if it has none in a numerically sound way. Judged with its diagonal
// scaled to one, as radians and metres do not compare; then 6 >= eigenvalues, and 1e-10 leaves six
// digits above the rounding of the sums.
std::optional<Eigen::Matrix<double, 6, 6>> Covariance(const Eigen::Matrix<double, 6, 6>& hessian) {
  const Eigen::Matrix<double, 6, 1> diagonal = hessian.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::Matrix<double, 6, 1> scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 6, 6> scaled = scale.asDiagonal() * hessian * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(scaled);
  if (!(eigen.eigenvalues()[0] > 1e-10)) return std::nullopt;
  const Eigen::Matrix<double, 6, 6> inverse = eigen.eigenvectors() *
                                              eigen.eigenvalues().cwiseInverse().asDiagonal() *
                                              eigen.eigenvectors().transpose();
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

// Inlier flags and their counts.
void WriteFlags(const Activities& active, PoseData* data, PoseSummary* summary) {
  for (size_t i = 0; i < data->points.size(); ++i) {
    data->points[i].inlier = active.points[i].reprojection;
    summary->num_inlier_points += data->points[i].inlier;
  }
  for (size_t i = 0; i < data->lines.size(); ++i) {
    data->lines[i].inlier = active.lines[i].reprojection;
    summary->num_inlier_lines += data->lines[i].inlier;
  }
}

}  // namespace

bool PoseOptions::IsValid(std::string* error) const {
  if (!CommonOptionsAreValid(*this, error)) return false;
  if (num_rounds < 1 || num_robust_rounds < 0 || num_robust_rounds > num_rounds) {
    *error = "num_rounds must be at least 1, and num_robust_rounds within [0, num_rounds]";
  } else if (iterations_per_round < 1) {
    *error = "iterations_per_round must be at least 1";
  } else if (!(max_frame_noise >= 1.0)) {
    *error = "max_frame_noise must be at least 1";
  } else {
    return true;
  }
  return false;
}

PoseSummary SolvePose(const PoseOptions& options, PoseData* data) {
  Validate(options, *data);
  Rigid3 pose = data->cam_from_world;
  Activities active = AllInFront(options, *data);
  const bool solved = RunRounds(options, *data, options.num_robust_rounds, true, &active, &pose) &&
                      RunRounds(options, *data, options.num_rounds - options.num_robust_rounds,
                                false, &active, &pose);

  PoseSummary summary;
  WriteFlags(active, data, &summary);
  const PoseFactors inliers = BuildFactors(options, *data, active, pose, false);
  NormalEquations equations;
  if (!solved || inliers.NumRows() < 6 || !inliers.Linearize(pose, &equations)) return summary;
  const auto covariance = Covariance(equations.hessian);
  if (!covariance) return summary;
  summary.usable = true;
  summary.final_cost = equations.cost;
  summary.covariance = *covariance;
  data->cam_from_world = pose;
  return summary;
}

}  // namespace msc_vo
