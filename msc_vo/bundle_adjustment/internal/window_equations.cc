// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

#include <algorithm>

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Numbers the unknowns among blocks that may be fixed.
template <typename Item>
int Number(const std::vector<Item>& items, const std::vector<bool>& takes_part,
           std::vector<int>* numbers) {
  int count = 0;
  for (size_t i = 0; i < items.size(); ++i) {
    numbers->push_back(takes_part[i] && !items[i].fixed ? count++ : -1);
  }
  return count;
}

// Brings the two factors of each observation together; both terms are in the order of the data.
template <typename Reprojection, typename Depth>
std::vector<Sighting<Reprojection, Depth>> Sightings(const WindowTerm<Reprojection>& image,
                                                     const WindowTerm<Depth>& depth) {
  std::vector<Sighting<Reprojection, Depth>> sightings;
  sightings.reserve(std::max(image.blocks.size(), depth.blocks.size()));
  auto d = depth.blocks.begin();
  const auto add_depths_before = [&](int source) {
    for (; d != depth.blocks.end() && d->source < source; ++d) {
      sightings.push_back({d->first, d->second, -1, nullptr, &d->factor});
    }
  };
  for (const auto& i : image.blocks) {
    add_depths_before(i.source);
    const bool has_depth = d != depth.blocks.end() && d->source == i.source;
    sightings.push_back({i.first, i.second, -1, &i.factor, has_depth ? &d->factor : nullptr});
    if (has_depth) ++d;
  }
  if (d != depth.blocks.end()) add_depths_before(depth.blocks.back().source + 1);
  return sightings;
}

// One link for every unknown pose that sees an unknown landmark, however often.
template <typename AnySighting>
void Link(const std::vector<int>& pose, const std::vector<int>& landmark, int num_landmarks,
          std::vector<AnySighting>* sightings, std::vector<LinkRange>* links,
          std::vector<int>* link_poses) {
  links->resize(num_landmarks);
  for (const AnySighting& s : *sightings) {
    if (landmark[s.landmark] >= 0) ++(*links)[landmark[s.landmark]].size;
  }
  int end = 0;
  for (LinkRange& range : *links) {
    range.begin = end;
    end += range.size;
    range.size = 0;
  }
  link_poses->resize(end);
  for (AnySighting& s : *sightings) {
    if (landmark[s.landmark] < 0 || pose[s.keyframe] < 0) continue;
    LinkRange& range = (*links)[landmark[s.landmark]];
    const auto begin = link_poses->begin() + range.begin, stop = begin + range.size;
    s.link = static_cast<int>(std::find(begin, stop, pose[s.keyframe]) - link_poses->begin());
    if (s.link == range.end()) (*link_poses)[range.begin + range.size++] = pose[s.keyframe];
  }
}

using Pose = WindowEquations::Pose;

// Cost of one block in camera coordinates x, and its derivatives, of each of `Points` points.
template <int Points>
struct InCamera {
  std::array<Eigen::Vector3d, Points> x;
  std::array<Eigen::Matrix3d, Points> hessian;
  std::array<Eigen::Vector3d, Points> gradient;
  double cost = 0.0;

  template <typename Factor>
  void Add(const Factor& factor, const HuberLoss& loss) {
    constexpr int kRows = Factor::kRowsPerPoint;
    Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
    for (int k = 0; k < Points; ++k) factor.Residual(k, x[k], r.data() + k * kRows);
    const double s = r.squaredNorm();
    const double weight = loss.Weight(s);
    cost += 0.5 * loss.Cost(s);
    for (int k = 0; k < Points; ++k) {
      const Eigen::Matrix<double, kRows, 3> j = factor.Jacobian(k, x[k]);
      const Eigen::Matrix<double, kRows, 3> weighted = weight * j;
      hessian[k].noalias() += weighted.transpose() * j;
      gradient[k].noalias() += weighted.transpose() * r.template segment<kRows>(k * kRows);
    }
  }
};

class Linearizer {
 public:
  Linearizer(const WindowStructure& structure, const WindowTerms& terms, const WindowState& state,
             WindowEquations* equations)
      : structure_(structure), terms_(terms), state_(state), equations_(equations) {}

  bool Run() {
    SetZero();
    for (size_t i = 0; i < structure_.pose.size(); ++i) {
      rotations_.push_back(state_.Pose(i).rotation().toRotationMatrix());
    }
    double cost = 0.0;
    for (const PointSighting& s : structure_.point_sightings) {
      if (!AddSighting<1>(s, terms_.point_reprojection.loss, terms_.point_depth.loss,
                          state_.PointBlock(s.landmark), structure_.point[s.landmark],
                          &equations_->points, &cost)) {
        return false;
      }
    }
    for (const LineSighting& s : structure_.line_sightings) {
      if (!AddSighting<2>(s, terms_.line_reprojection.loss, terms_.line_depth.loss,
                          state_.LineBlock(s.landmark), structure_.line[s.landmark],
                          &equations_->lines, &cost)) {
        return false;
      }
    }
    if (!FindDirections()) return false;
    AddEndpointPriors(&cost);
    AddAlignments(&cost);
    AddPairs(terms_.parallel, &cost);
    AddPairs(terms_.perpendicular, &cost);
    AddPriors(&cost);
    equations_->cost = cost;
    return std::isfinite(cost);
  }

 private:
  template <int N>
  static void SetZero(int count, int num_links, WindowEquations::Landmarks<N>* landmarks) {
    using Landmarks = WindowEquations::Landmarks<N>;
    landmarks->hessian.assign(count, Landmarks::Block::Zero());
    landmarks->gradient.assign(count, Landmarks::Vector::Zero());
    landmarks->poses.assign(num_links, Landmarks::Coupling::Zero());
  }
  void SetZero() {
    equations_->pose_hessian.assign(structure_.num_poses, Pose::Block::Zero());
    equations_->pose_gradient.assign(structure_.num_poses, Pose::Vector::Zero());
    SetZero(structure_.num_points, static_cast<int>(structure_.point_link_poses.size()),
            &equations_->points);
    SetZero(structure_.num_lines, static_cast<int>(structure_.line_link_poses.size()),
            &equations_->lines);
    equations_->couplings.clear();
    rotations_.clear();
  }

  // x = R X + t, so that dx = [-[R X]x, I] (w, u) + R dX.
  template <int Points, typename AnySighting>
  bool AddSighting(const AnySighting& s, const HuberLoss& image_loss, const HuberLoss& depth_loss,
                   const double* landmark, int unknown,
                   WindowEquations::Landmarks<3 * Points>* landmarks, double* cost) {
    const int pose = structure_.pose[s.keyframe];
    const Eigen::Matrix3d& rotation = rotations_[s.keyframe];
    const Eigen::Map<const Eigen::Vector3d> translation(state_.PoseBlock(s.keyframe) + 4);
    std::array<Eigen::Vector3d, Points> rotated;
    InCamera<Points> at;
    for (int k = 0; k < Points; ++k) {
      rotated[k] = rotation * Eigen::Map<const Eigen::Vector3d>(landmark + 3 * k);
      at.x[k] = rotated[k] + translation;
      if (!(at.x[k].z() >= kMinCameraDepth)) return false;
      at.hessian[k].setZero();
      at.gradient[k].setZero();
    }
    if (s.reprojection != nullptr) at.Add(*s.reprojection, image_loss);
    if (s.depth != nullptr) at.Add(*s.depth, depth_loss);
    *cost += at.cost;
    for (int k = 0; k < Points; ++k) {
      const Eigen::Matrix3d& h = at.hessian[k];
      const Eigen::Matrix3d h_rotation = h * rotation;
      if (unknown >= 0) {
        landmarks->hessian[unknown].template block<3, 3>(3 * k, 3 * k).noalias() +=
            rotation.transpose() * h_rotation;
        landmarks->gradient[unknown].template segment<3>(3 * k).noalias() +=
            rotation.transpose() * at.gradient[k];
      }
      if (pose < 0) continue;
      const Eigen::Matrix3d arm = Skew(rotated[k]);
      const Eigen::Matrix3d arm_h = arm * h;
      Pose::Block& pose_hessian = equations_->pose_hessian[pose];
      pose_hessian.topLeftCorner<3, 3>().noalias() -= arm_h * arm;
      pose_hessian.bottomLeftCorner<3, 3>() += arm_h.transpose();
      pose_hessian.bottomRightCorner<3, 3>() += h;
      equations_->pose_gradient[pose].head<3>() += rotated[k].cross(at.gradient[k]);
      equations_->pose_gradient[pose].tail<3>() += at.gradient[k];
      if (s.link < 0) continue;
      auto coupling = landmarks->poses[s.link].template middleCols<3>(3 * k);
      coupling.template topRows<3>().noalias() += arm * h_rotation;
      coupling.template bottomRows<3>() += h_rotation;
    }
    return true;
  }

  // Of all lines that are observed, once: each is part of many pairs. False if one has no length.
  bool FindDirections() {
    equations_->directions.resize(structure_.num_lines);
    directions_.resize(structure_.line.size());
    for (size_t i = 0; i < structure_.line.size(); ++i) {
      if (!terms_.line_observed[i]) continue;
      if (!LineDirection(state_.LineBlock(i), &directions_[i].unit)) return false;
      directions_[i].jacobian = LineDirectionJacobian(state_.LineBlock(i));
      if (structure_.line[i] >= 0) {
        equations_->directions[structure_.line[i]] = directions_[i].unit;
      }
    }
    return true;
  }

  void AddEndpointPriors(double* cost) {
    for (const auto& block : terms_.line_endpoint_prior.blocks) {
      const int unknown = structure_.line[block.first];
      Eigen::Vector2d r;
      block.factor(state_.LineBlock(block.first), r.data());
      *cost += 0.5 * r.squaredNorm();
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector3d j = block.factor.Jacobian();
        equations_->lines.hessian[unknown].block<3, 3>(3 * k, 3 * k) += j * j.transpose();
        equations_->lines.gradient[unknown].segment<3>(3 * k) += r[k] * j;
      }
    }
  }

  // Adds derivatives with respect to E - S.
  void AddToLine(int unknown, const Eigen::Matrix3d& hessian, const Eigen::Vector3d& gradient) {
    WindowEquations::Landmarks<6>::Block& h = equations_->lines.hessian[unknown];
    h.topLeftCorner<3, 3>() += hessian;
    h.topRightCorner<3, 3>() -= hessian;
    h.bottomLeftCorner<3, 3>() -= hessian;
    h.bottomRightCorner<3, 3>() += hessian;
    equations_->lines.gradient[unknown].head<3>() -= gradient;
    equations_->lines.gradient[unknown].tail<3>() += gradient;
  }

  void AddAlignments(double* cost) {
    for (const auto& block : terms_.manhattan.blocks) {
      Eigen::Vector2d r;
      const Direction& d = directions_[block.first];
      block.factor.Residual(d.unit, r.data());
      const double s = r.squaredNorm();
      const double weight = terms_.manhattan.loss.Weight(s);
      *cost += 0.5 * terms_.manhattan.loss.Cost(s);
      const Eigen::Matrix<double, 2, 3> j = block.factor.Jacobian() * d.jacobian;
      AddToLine(structure_.line[block.first], weight * j.transpose() * j,
                weight * j.transpose() * r);
    }
  }

  template <typename Factor>
  void AddPairs(const WindowTerm<Factor>& term, double* cost) {
    for (const auto& block : term.blocks) {
      const Direction &d_i = directions_[block.first], &d_j = directions_[block.second];
      Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
      block.factor.Residual(d_i.unit, d_j.unit, r.data());
      const double s = r.squaredNorm();
      const double weight = block.count * term.loss.Weight(s);
      *cost += 0.5 * (block.count * term.loss.Cost(s));
      const typename Factor::Jacobian by_i =
          block.factor.JacobianI(d_i.unit, d_j.unit) * d_i.jacobian;
      const typename Factor::Jacobian by_j =
          block.factor.JacobianJ(d_i.unit, d_j.unit) * d_j.jacobian;
      const int i = structure_.line[block.first], j = structure_.line[block.second];
      if (i >= 0) AddToLine(i, weight * by_i.transpose() * by_i, weight * by_i.transpose() * r);
      if (j >= 0) AddToLine(j, weight * by_j.transpose() * by_j, weight * by_j.transpose() * r);
      if (i >= 0 && j >= 0) equations_->couplings.push_back(weight * by_i.transpose() * by_j);
    }
  }

  void AddPriors(double* cost) {
    for (const auto& block : terms_.pose_prior.blocks) {
      const int pose = structure_.pose[block.first];
      Pose::Vector r;
      block.factor(state_.PoseBlock(block.first), r.data());
      const Pose::Block j = block.factor.TangentJacobian(state_.Pose(block.first));
      *cost += 0.5 * r.squaredNorm();
      equations_->pose_hessian[pose] += j.transpose() * j;
      equations_->pose_gradient[pose] += j.transpose() * r;
    }
  }

  const WindowStructure& structure_;
  const WindowTerms& terms_;
  const WindowState& state_;
  WindowEquations* equations_;
  struct Direction {
    Eigen::Vector3d unit;
    Eigen::Matrix3d jacobian;  // of it, with respect to E - S
  };
  std::vector<Eigen::Matrix3d> rotations_;  // of all keyframes
  std::vector<Direction> directions_;       // of all lines
};

}  // namespace

WindowStructure::WindowStructure(const WindowData& data, const WindowTerms& terms)
    : point_sightings(Sightings(terms.point_reprojection, terms.point_depth)),
      line_sightings(Sightings(terms.line_reprojection, terms.line_depth)) {
  num_poses = Number(data.keyframes, terms.keyframe_takes_part, &pose);
  num_points = Number(data.points, terms.point_observed, &point);
  num_lines = Number(data.lines, terms.line_observed, &line);
  Link(pose, point, num_points, &point_sightings, &point_links, &point_link_poses);
  Link(pose, line, num_lines, &line_sightings, &line_links, &line_link_poses);

  const auto couple = [this](const auto& term) {
    for (const auto& block : term.blocks) {
      const WindowIndex::Pair pair{line[block.first], line[block.second]};
      if (pair.a >= 0 && pair.b >= 0) couplings.push_back(pair);
    }
  };
  couple(terms.parallel);
  couple(terms.perpendicular);
  for (const bool keep : LinesInReducedSystem(num_lines, couplings)) {
    reduced_line.push_back(keep ? num_reduced_lines++ : -1);
  }
}

bool Linearize(const WindowStructure& structure, const WindowTerms& terms, const WindowState& state,
               WindowEquations* equations) {
  return Linearizer(structure, terms, state, equations).Run();
}

}  // namespace msc_vo
