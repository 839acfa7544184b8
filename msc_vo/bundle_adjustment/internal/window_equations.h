// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

// Poses that observe one landmark: a range of links.
struct LinkRange {
  int begin = 0;
  int size = 0;
  int end() const { return begin + size; }
};

// What one keyframe sees of one landmark: its factors, the image and the depth.
template <typename Reprojection, typename Depth>
struct Sighting {
  int keyframe = 0;  // positions in the state
  int landmark = 0;
  int link = -1;                               // between two unknowns; -1: one of them is constant
  const Reprojection* reprojection = nullptr;  // null: takes no part
  const Depth* depth = nullptr;
};
using PointSighting = Sighting<PointReprojection, DepthReprojection>;
using LineSighting = Sighting<LineReprojection, LineDepthReprojection>;

// Which numbers of a window are unknown, and which pairs of them meet in a factor. Unknowns are
// what is not fixed and takes part in an observation, counted in the order of the data.
struct WindowStructure {
  WindowStructure(const WindowData& data, const WindowTerms& terms);

  // Number of each keyframe, point and line among the unknowns; -1: constant.
  std::vector<int> pose, point, line;
  int num_poses = 0, num_points = 0, num_lines = 0;

  std::vector<PointSighting> point_sightings;
  std::vector<LineSighting> line_sightings;
  std::vector<LinkRange> point_links, line_links;      // of each unknown point and line
  std::vector<int> point_link_poses, line_link_poses;  // the unknown pose of each link

  // Pairs of two unknown lines, parallel ones first.
  std::vector<WindowIndex::Pair> couplings;
  // Number of each unknown line among those that cannot be eliminated for their partners; -1: can.
  std::vector<int> reduced_line;
  int num_reduced_lines = 0;
};

// The normal equations of a window, H step = -gradient, in blocks. H is the Gauss-Newton Hessian of
// the robust cost: every factor's J^T J weighs with the derivative of its loss.
// Steps of a pose are in the tangent space of Rigid3Manifold, of a point in metres, of a line in
// metres of its start and end.
struct WindowEquations {
  template <int N>
  struct Landmarks {
    using Block = Eigen::Matrix<double, N, N>;
    using Vector = Eigen::Matrix<double, N, 1>;
    using Coupling = Eigen::Matrix<double, 6, N>;
    std::vector<Block> hessian;
    std::vector<Vector> gradient;
    std::vector<Coupling> poses;  // one per link: d2 cost / d pose d landmark
  };
  using Pose = Landmarks<6>;

  std::vector<Pose::Block> pose_hessian;
  std::vector<Pose::Vector> pose_gradient;
  Landmarks<3> points;
  Landmarks<6> lines;
  // One per coupling: d2 cost / d(E - S)_a d(E - S)_b.
  std::vector<Eigen::Matrix3d> couplings;
  std::vector<Eigen::Vector3d> directions;  // of the unknown lines, unit
  double cost = 0.0;
};

// Evaluates all factors and their derivatives at `state`. False if one of them is not defined
// there, or not finite.
bool Linearize(const WindowStructure& structure, const WindowTerms& terms, const WindowState& state,
               WindowEquations* equations);

}  // namespace msc_vo
