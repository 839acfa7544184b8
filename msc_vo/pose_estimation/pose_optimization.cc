// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_optimization.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/pose_estimation/cell_consensus.h"
#include "msc_vo/pose_estimation/image_grid.h"
#include "msc_vo/pose_estimation/pose_matches.h"

namespace msc_vo {

namespace {

void Validate(const PoseOptions& options, const PoseData& data) {
  const auto fail = [](const std::string& who, const std::string& what) {
    throw std::invalid_argument("OptimizePose: " + who + ": " + what);
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

// Solves and classifies up to `num_rounds` times; earlier if that changes nothing any more. False
// if there are fewer than six rows or the solver failed.
bool RunRounds(const PoseOptions& options, const PoseData& data, int num_rounds, bool robust,
               PoseInlierMask* active, Rigid3* pose) {
  for (int round = 0; round < num_rounds; ++round) {
    const PoseFactors factors = BuildFactors(options, data, *active, *pose, robust);
    if (factors.NumRows() < 6) return false;
    const PoseTermination end = MinimizePose(factors, options.iterations_per_round, pose);
    if (end == PoseTermination::kFailed) return false;
    PoseInlierMask next = ClassifyMatches(options, data, *pose);
    const bool settled = end == PoseTermination::kConverged && next == *active;
    *active = std::move(next);
    if (settled) break;
  }
  return true;
}

bool SolveRounds(const PoseOptions& options, const PoseData& data, PoseInlierMask* active,
                 Rigid3* pose) {
  return RunRounds(options, data, options.num_robust_rounds, true, active, pose) &&
         RunRounds(options, data, options.num_rounds - options.num_robust_rounds, false, active,
                   pose);
}

// Solves once more without the parts of the image that move by themselves, if any do, and returns
// them. Leaves all as it is and returns none if what then remains fixes no pose.
std::vector<bool> LeaveOutWhatMoves(const PoseOptions& options, PoseData* data,
                                    PoseInlierMask* active, Rigid3* pose) {
  const std::optional<CellConsensus> consensus = FindCellConsensus(options, *data, *pose);
  if (!consensus) return {};
  const ImageGrid parts(options.consensus.columns, options.consensus.rows, data->camera);
  PoseData resting = *data;
  for (PoseData::Point& point : resting.points) {
    point.dynamic = consensus->dynamic_cells[parts.CellOf(point.pixel)];
  }
  for (PoseData::Line& line : resting.lines) {
    line.dynamic = consensus->dynamic_cells[parts.CellOf(line.segment)];
  }
  Rigid3 next = consensus->cam_from_world;
  PoseInlierMask kept = ClassifyMatches(options, resting, next);
  if (!SolveRounds(options, resting, &kept, &next)) return {};
  *data = std::move(resting);
  *active = std::move(kept);
  *pose = next;
  return consensus->dynamic_cells;
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
void WriteFlags(const PoseInlierMask& active, PoseData* data, PoseSummary* summary) {
  for (size_t i = 0; i < data->points.size(); ++i) {
    data->points[i].inlier = active.points[i].reprojection;
    summary->num_inlier_points += data->points[i].inlier;
    summary->num_dynamic += data->points[i].dynamic;
  }
  for (size_t i = 0; i < data->lines.size(); ++i) {
    data->lines[i].inlier = active.lines[i].reprojection;
    summary->num_inlier_lines += data->lines[i].inlier;
    summary->num_dynamic += data->lines[i].dynamic;
  }
}

}  // namespace

bool CellConsensusOptions::IsValid(std::string* error) const {
  if (columns < 1 || rows < 1) {
    *error = "consensus: columns and rows must be at least 1";
  } else if (!(reject_chi2_6 > 0.0) || !(min_cells >= 0.0)) {
    *error = "consensus: reject_chi2_6 must be positive, min_cells not negative";
  } else if (!(unconfirmed_weight > 0.0 && unconfirmed_weight <= 1.0)) {
    *error = "consensus: unconfirmed_weight must be in (0, 1]";
  } else {
    return true;
  }
  return false;
}

bool PoseOptions::IsValid(std::string* error) const {
  if (!CommonOptionsAreValid(*this, error) || !consensus.IsValid(error)) return false;
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

PoseSummary OptimizePose(const PoseOptions& options, PoseData* data) {
  Validate(options, *data);
  Rigid3 pose = data->cam_from_world;
  PoseInlierMask active = AllInFront(options, *data, pose);
  for (PoseData::Point& point : data->points) point.dynamic = false;
  for (PoseData::Line& line : data->lines) line.dynamic = false;
  const bool solved = SolveRounds(options, *data, &active, &pose);
  PoseSummary summary;
  if (solved && options.consensus.enabled) {
    summary.dynamic_cells = LeaveOutWhatMoves(options, data, &active, &pose);
  }
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
