// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/window_covariance.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/bundle_adjustment/internal/schur_complement.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Damping of a millionth of a millionth: far below what the window knows of anything that is of
// use, far above the rounding of the sums. Of what it does not know at all, it makes something
// finite.
constexpr double kRadius = 1e12;
// A number is not determined if, for all that it is bound to, it is known so many times worse than
// it would be with all others known: then the damping speaks.
constexpr double kMaxInflation = 1e8;

// What took part in the last solve.
WindowInlierMask LeftBySolver(const BundleAdjustmentOptions& options, const WindowData& data,
                              const WindowIndex& index, const WindowState& state) {
  int num_behind = 0;
  WindowInlierMask left = AllInFront(options, index, data, &num_behind);
  const auto keep = [](const auto& items, std::vector<bool>* active) {
    for (size_t i = 0; i < items.size(); ++i) (*active)[i] = !items[i].rejected;
  };
  const auto keep_observations = [](const auto& items, std::vector<InlierMask>* active) {
    for (size_t i = 0; i < items.size(); ++i) {
      if (items[i].rejected) (*active)[i] = {};
    }
  };
  keep_observations(data.point_observations, &left.points);
  keep_observations(data.line_observations, &left.lines);
  keep(data.parallel_pairs, &left.parallel);
  keep(data.perpendicular_pairs, &left.perpendicular);
  keep(data.axis_alignments, &left.alignments);

  // Depths that were lost alone have no mark.
  WindowInlierMask tested = left;
  BundleAdjustmentSummary unused;
  ClassifyAll(options, MakeWindowTerms(options, data, index, left, state), state, &tested, &unused);
  const auto drop_depths = [](const std::vector<InlierMask>& test,
                              std::vector<InlierMask>* active) {
    for (size_t i = 0; i < test.size(); ++i) {
      if (test[i].reprojection && !test[i].depth) (*active)[i].depth = false;
    }
  };
  drop_depths(tested.points, &left.points);
  drop_depths(tested.lines, &left.lines);
  return left;
}

template <typename Item>
int PositionOf(const std::vector<Item>& items, int64_t id, const char* kind) {
  const auto it =
      std::find_if(items.begin(), items.end(), [id](const Item& i) { return i.id == id; });
  if (it == items.end()) {
    throw std::invalid_argument(std::string("EstimateCovariance: ") + kind + " " +
                                std::to_string(id) + " is asked for but not in the window");
  }
  return static_cast<int>(it - items.begin());
}

// Positions of ids in the data.
template <typename Item>
std::vector<int> Positions(const std::vector<Item>& items, const std::vector<int64_t>& ids,
                           const char* kind) {
  std::vector<int> positions;
  for (const int64_t id : ids) positions.push_back(PositionOf(items, id, kind));
  return positions;
}

// Those among `positions` that are unknowns, by their numbers.
std::vector<int> Unknowns(const std::vector<int>& positions, const std::vector<int>& numbers) {
  std::vector<int> unknowns;
  for (const int position : positions) {
    if (numbers[position] >= 0) unknowns.push_back(numbers[position]);
  }
  return unknowns;
}

// Brings the blocks of the unknowns back to their places among all that were chosen.
template <typename Item, typename Matrix>
std::vector<std::optional<Matrix>> Collect(const std::vector<Item>& items,
                                           const std::vector<int>& positions,
                                           const std::vector<int>& numbers,
                                           const std::vector<Matrix>& hessian,
                                           const std::vector<Matrix>& inverse) {
  std::vector<std::optional<Matrix>> covariances;
  auto next = inverse.begin();
  for (const int position : positions) {
    covariances.emplace_back();
    const int number = numbers[position];
    if (items[position].fixed) covariances.back() = Matrix::Zero();
    if (number < 0 || next == inverse.end()) continue;
    const Matrix& covariance = *next++;
    const auto inflation = covariance.diagonal().cwiseProduct(hessian[number].diagonal());
    const bool determined = hessian[number].diagonal().minCoeff() > 0.0 &&
                            inflation.maxCoeff() < kMaxInflation && covariance.allFinite();
    if (determined) covariances.back() = 0.5 * (covariance + covariance.transpose());
  }
  return covariances;
}

}  // namespace

WindowCovariance EstimateCovariance(const BundleAdjustmentOptions& options,
                                    const WindowData& solved, const WindowChoice& chosen) {
  const WindowIndex index = ValidateWindow(options, solved);
  const std::vector<int> keyframes = Positions(solved.keyframes, chosen.keyframes, "keyframe");
  const std::vector<int> points = Positions(solved.points, chosen.points, "point");
  const std::vector<int> lines = Positions(solved.lines, chosen.lines, "line");

  const WindowState state(solved);
  const WindowTerms terms =
      MakeWindowTerms(options, solved, index, LeftBySolver(options, solved, index, state), state);
  const WindowStructure structure(solved, terms);
  WindowEquations equations;
  InverseBlocks inverse;
  if (Linearize(structure, terms, state, &equations)) {
    // Where it fails, nothing is determined.
    InvertBlocks(structure, equations, kRadius,
                 {Unknowns(keyframes, structure.pose), Unknowns(points, structure.point),
                  Unknowns(lines, structure.line)},
                 &inverse);
  }
  return {
      Collect(solved.keyframes, keyframes, structure.pose, equations.pose_hessian, inverse.poses),
      Collect(solved.points, points, structure.point, equations.points.hessian, inverse.points),
      Collect(solved.lines, lines, structure.line, equations.lines.hessian, inverse.lines)};
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
