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
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const auto& matches = OfKind<L>(data);
    for (size_t i = 0; i < matches.size(); ++i) {
      const char* what = MatchError(matches[i]);
      if (what == nullptr) what = MapVarianceError(matches[i].map_variance);
      if (what != nullptr) fail(L::kName + (" " + std::to_string(i)), what);
    }
  });
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
  ForEachLandmarkKind([&](auto kind) {
    for (auto& match : OfKind<typename decltype(kind)::Landmark>(marked)) {
      match.dynamic = dynamic_cells[CellOf(grid, match)];
    }
  });
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

// Writes the flags of the matches and counts them.
void WriteFlags(const PoseInlierMask& mask, PoseData* data, PoseSummary* summary) {
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    auto& matches = OfKind<L>(*data);
    for (size_t i = 0; i < matches.size(); ++i) {
      auto& match = matches[i];
      match.inlier = mask.Of<L>()[i].reprojection;
      summary->num_inliers.Of<L>() += match.inlier;
      summary->num_dynamic += match.dynamic;
      if (match.dynamic || !match.confirmed) continue;
      ++summary->num_confirmed;
      summary->num_confirmed_inliers += match.inlier;
    }
  });
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
  ForEachLandmarkKind([&](auto kind) {
    for (auto& match : OfKind<typename decltype(kind)::Landmark>(*data)) match.dynamic = false;
  });
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
