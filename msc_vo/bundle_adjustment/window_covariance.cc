// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/window_covariance.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "msc_vo/bundle_adjustment/internal/covariance_blocks.h"
#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/bundle_adjustment/internal/landmark_consensus.h"
#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Relative damping of 1e-12 keeps the Hessian invertible where parameters are undetermined, and is
// negligible for all others.
constexpr double kRadius = 1e12;
// A parameter is undetermined if its marginal variance exceeds its variance given all other
// parameters by this factor: the damping then dominates the result.
constexpr double kMaxInflation = 1e8;

template <typename Item>
int PositionOf(const std::vector<Item>& items, int64_t id, const char* kind) {
  const auto it =
      std::find_if(items.begin(), items.end(), [id](const Item& i) { return i.id == id; });
  if (it == items.end()) {
    throw std::invalid_argument(std::string("EstimateCovariance: ") + kind + " " +
                                std::to_string(id) + " is selected but not in the window");
  }
  return static_cast<int>(it - items.begin());
}

// Positions of items in the data by their ids.
template <typename Item>
std::vector<int> Positions(const std::vector<Item>& items, const std::vector<int64_t>& ids,
                           const char* kind) {
  std::vector<int> positions;
  for (const int64_t id : ids) positions.push_back(PositionOf(items, id, kind));
  return positions;
}

// Numbers of the unknowns among `positions`.
std::vector<int> Unknowns(const std::vector<int>& positions, const std::vector<int>& numbers) {
  std::vector<int> unknowns;
  for (const int position : positions) {
    if (numbers[position] >= 0) unknowns.push_back(numbers[position]);
  }
  return unknowns;
}

// Distributes the blocks of the unknowns to the selected items. size(position): degrees of freedom
// of an item.
template <typename Item, typename Matrix, typename Size>
std::vector<std::optional<Matrix>> Collect(const std::vector<Item>& items,
                                           const std::vector<int>& positions,
                                           const std::vector<int>& numbers,
                                           const std::vector<Matrix>& hessian,
                                           const std::vector<Matrix>& inverse, const Size& size) {
  std::vector<std::optional<Matrix>> covariances;
  auto next = inverse.begin();
  for (const int position : positions) {
    covariances.emplace_back();
    const int number = numbers[position];
    if (items[position].fixed) {
      const int n = size(position);
      covariances.back() = Matrix::Zero(n, n);
    }
    if (number < 0 || next == inverse.end()) continue;
    const Matrix& covariance = *next++;
    const auto inflation = covariance.diagonal().cwiseProduct(hessian[number].diagonal());
    // Rounding may even make a variance negative where the system is close to singular.
    const bool determined = hessian[number].diagonal().minCoeff() > 0.0 &&
                            inflation.minCoeff() > 0.0 && inflation.maxCoeff() < kMaxInflation &&
                            covariance.allFinite();
    if (determined) covariances.back() = 0.5 * (covariance + covariance.transpose());
  }
  return covariances;
}

// Removes the covariances of landmarks that their views do not determine.
template <typename Matrix>
void KeepDetermined(const std::vector<int>& positions, const std::vector<bool>& determined,
                    std::vector<std::optional<Matrix>>* covariances) {
  for (size_t i = 0; i < positions.size(); ++i) {
    if (!determined[positions[i]]) (*covariances)[i].reset();
  }
}

}  // namespace

WindowCovariance EstimateCovariance(const BundleAdjustmentOptions& options,
                                    const WindowData& solved, const CovarianceSelection& selected) {
  const WindowIndex index = ValidateWindow(options, solved);
  const std::vector<int> keyframes = Positions(solved.keyframes, selected.keyframes, "keyframe");
  const std::vector<int> points = Positions(solved.points, selected.points, "point");
  const std::vector<int> lines = Positions(solved.lines, selected.lines, "line");
  const std::vector<int> extra =
      Positions(solved.extra_blocks, selected.extra_blocks, "extra block");

  const WindowState state(solved);
  const WindowInlierMask inlier_mask = UnrejectedInlierMask(options, index, solved);
  WindowData with_noise_uncertainty = solved;
  AddNoiseUncertainty(options.landmark_noise, index, inlier_mask, state, &with_noise_uncertainty);
  const WindowTerms terms =
      MakeWindowTerms(options, with_noise_uncertainty, index, inlier_mask, state);
  const BlockStructure structure(solved, terms, state);
  WindowEquations equations;
  CovarianceBlocks blocks;
  if (Linearize(structure, terms, state, &equations)) {
    // On failure the blocks stay empty: nothing is determined.
    ComputeCovarianceBlocks(structure, equations, kRadius,
                            {Unknowns(keyframes, structure.pose), Unknowns(points, structure.point),
                             Unknowns(lines, structure.line), Unknowns(extra, structure.extra)},
                            &blocks);
  }
  WindowCovariance result{Collect(solved.keyframes, keyframes, structure.pose,
                                  equations.pose_hessian, blocks.poses, [](int) { return 6; }),
                          Collect(solved.points, points, structure.point, equations.points.hessian,
                                  blocks.points, [](int) { return 3; }),
                          Collect(solved.lines, lines, structure.line, equations.lines.hessian,
                                  blocks.lines, [](int) { return 6; }),
                          Collect(solved.extra_blocks, extra, structure.extra,
                                  equations.extra_hessian, blocks.extra, [&state](int i) {
                                    return state.TangentSize({BlockKind::kExtra, i});
                                  })};
  const DeterminedLandmarks determined = FindDetermined(options, index, solved, inlier_mask, state);
  KeepDetermined(points, determined.points, &result.points);
  KeepDetermined(lines, determined.lines, &result.lines);
  return result;
}

// With c = -R^T t and R' = Exp(w) R, t' = t + u:  c' = c - R^T (u - w x t),  R'^T = Exp(-R^T w)
// R^T.
Eigen::Matrix<double, 6, 6> CovarianceInWorld(const Rigid3& cam_from_world,
                                              const Eigen::Matrix<double, 6, 6>& covariance) {
  const Eigen::Matrix3d world_from_cam = cam_from_world.rotation().conjugate().toRotationMatrix();
  Eigen::Matrix<double, 6, 6> j = Eigen::Matrix<double, 6, 6>::Zero();
  j.topLeftCorner<3, 3>() = -world_from_cam;
  j.bottomLeftCorner<3, 3>() = -world_from_cam * Skew(cam_from_world.translation());
  j.bottomRightCorner<3, 3>() = -world_from_cam;
  return j * covariance * j.transpose();
}

}  // namespace msc_vo
