// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_optimization.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/pose_estimation/cell_consensus.h"
#include "msc_vo/pose_estimation/estimate_covariance.h"
#include "msc_vo/pose_estimation/image_grid.h"
#include "msc_vo/pose_estimation/pose_matches.h"

namespace msc_vo {

namespace {

const char* MapVarianceError(double map_variance) {
  const bool valid = std::isfinite(map_variance) && map_variance >= 0.0;
  return valid ? nullptr : "map_variance must be finite and not negative";
}

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
    if (what == nullptr) what = MapVarianceError(p.map_variance);
    if (what != nullptr) fail("point " + std::to_string(i), what);
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    const PoseData::Line& l = data.lines[i];
    const char* what = MapLineError(l.map_segment);
    if (what == nullptr) what = LineObservationError(l.segment, l.sigma, l.has_depth, l.depth);
    if (what == nullptr) what = MapVarianceError(l.map_variance);
    if (what != nullptr) fail("line " + std::to_string(i), what);
  }
  for (const PoseFactor& factor : data.custom_factors) {
    const std::string what = PoseFactorError(factor, data.cam_from_world);
    if (!what.empty()) fail("custom factor '" + factor.name + "'", what);
  }
}

// Optimises the pose and reclassifies all matches, up to `num_rounds` times, until the inlier mask
// is stable. Returns false if fewer than six rows are left or the solver failed.
bool RunRounds(const PoseOptions& options, const PoseData& data, int num_rounds, bool robust,
               PoseInlierMask* mask, Rigid3* pose) {
  for (int round = 0; round < num_rounds; ++round) {
    const PoseFactors factors = BuildFactors(options, data, *mask, *pose, robust);
    if (factors.NumRows() < 6) return false;
    const LevenbergMarquardtTermination end =
        MinimizePose(factors, options.iterations_per_round, pose);
    if (end == LevenbergMarquardtTermination::kFailed) return false;
    PoseInlierMask next = ClassifyMatches(options, data, *pose);
    const bool settled = end == LevenbergMarquardtTermination::kConverged && next == *mask;
    *mask = std::move(next);
    if (settled) break;
  }
  return true;
}

// The robust rounds, then those without a loss.
bool SolveRounds(const PoseOptions& options, const PoseData& data, PoseInlierMask* mask,
                 Rigid3* pose) {
  return RunRounds(options, data, options.num_robust_rounds, true, mask, pose) &&
         RunRounds(options, data, options.num_rounds - options.num_robust_rounds, false, mask,
                   pose);
}

// Marks the matches in dynamic cells.
PoseData MarkDynamicMatches(const PoseData& data, const std::vector<bool>& dynamic_cells) {
  const ImageGrid grid = ConsensusGrid(data.camera);
  PoseData marked = data;
  for (PoseData::Point& point : marked.points) {
    point.dynamic = dynamic_cells[grid.CellOf(point.pixel)];
  }
  for (PoseData::Line& line : marked.lines) line.dynamic = dynamic_cells[grid.CellOf(line.segment)];
  return marked;
}

// Optimises once more without the cells of dynamic objects, if there are any, and returns the
// cells. Changes nothing and returns none if the remaining matches do not determine a pose.
std::vector<bool> RejectDynamicObjects(const PoseOptions& options, PoseData* data,
                                       PoseInlierMask* mask, Rigid3* pose) {
  const std::optional<CellConsensus> consensus = FindCellConsensus(options, *data, *pose);
  if (!consensus) return {};
  PoseData marked = MarkDynamicMatches(*data, consensus->dynamic_cells);
  Rigid3 static_pose = consensus->cam_from_world;
  PoseInlierMask static_mask = ClassifyMatches(options, marked, static_pose);
  if (!SolveRounds(options, marked, &static_mask, &static_pose)) return {};
  *data = std::move(marked);
  *mask = std::move(static_mask);
  *pose = static_pose;
  return consensus->dynamic_cells;
}

// Counts a match, whose flags are set; the caller counts the inliers of its kind.
template <typename Match>
void Count(const Match& match, PoseSummary* summary) {
  summary->num_dynamic += match.dynamic;
  if (match.dynamic || !match.confirmed) return;
  ++summary->num_confirmed;
  summary->num_confirmed_inliers += match.inlier;
}

// Writes the flags of the matches and counts them.
void WriteFlags(const PoseInlierMask& mask, PoseData* data, PoseSummary* summary) {
  for (size_t i = 0; i < data->points.size(); ++i) {
    data->points[i].inlier = mask.points[i].reprojection;
    summary->num_inlier_points += data->points[i].inlier;
    Count(data->points[i], summary);
  }
  for (size_t i = 0; i < data->lines.size(); ++i) {
    data->lines[i].inlier = mask.lines[i].reprojection;
    summary->num_inlier_lines += data->lines[i].inlier;
    Count(data->lines[i], summary);
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

PoseSummary OptimizePose(const PoseOptions& options, PoseData* data) {
  Validate(options, *data);
  Rigid3 pose = data->cam_from_world;
  PoseInlierMask mask = AllInFront(options, *data, pose);
  for (PoseData::Point& point : data->points) point.dynamic = false;
  for (PoseData::Line& line : data->lines) line.dynamic = false;
  const bool solved = SolveRounds(options, *data, &mask, &pose);
  PoseSummary summary;
  if (solved && options.consensus.enabled) {
    summary.dynamic_cells = RejectDynamicObjects(options, data, &mask, &pose);
  }
  WriteFlags(mask, data, &summary);
  const PoseFactors inliers = BuildFactors(options, *data, mask, pose, false);
  NormalEquations equations;
  if (!solved || inliers.NumRows() < 6 || !inliers.Linearize(pose, &equations)) return summary;
  const auto covariance = CovarianceOfEstimate(options, *data, mask, pose, equations);
  if (!covariance || !covariance->allFinite() || !std::isfinite(equations.cost) ||
      PoseError(pose) != nullptr) {
    return summary;
  }
  summary.usable = true;
  summary.final_cost = equations.cost;
  summary.covariance = *covariance;
  data->cam_from_world = pose;
  return summary;
}

}  // namespace msc_vo
