// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_pair.h"

#include <cmath>

#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/self_calibration/pair_view.h"
#include "msc_vo/self_calibration/surface_plane.h"

namespace msc_vo {

CalibrationPair::CalibrationPair(const CorrectedCamera& camera, const CalibrationView* a,
                                 const CalibrationView* b)
    : camera_(camera), a_(a), b_(b) {
  const Frame& from = *a->frame;
  const Frame& to = *b->frame;
  const double radius = kPairSearchRadius * to.camera.FocalLength();
  for (const PointMatch& match :
       MatchFrames(from, a->cam_from_world, to, b->cam_from_world, radius)) {
    const PointFeature& in_a = from.points[match.id];
    const PointFeature& in_b = to.points[match.feature];
    points_.push_back({MakePairView(camera.distortion(), from, in_a),
                       MakePairView(camera.distortion(), to, in_b), in_a.inverse_depth,
                       in_a.sigma * in_a.sigma + in_b.sigma * in_b.sigma});
  }
}

std::vector<CalibrationPoint> CalibrationPair::PointsWithSurfaces(
    const SensorCorrection::Vector& correction) const {
  const LinearizedCamera camera(camera_, correction);
  std::vector<CalibrationPoint> points;
  for (CalibrationPoint point : points_) {
    const auto in_a = FindSurface(camera, a_->depth, point.a.recorded_pixel);
    const auto in_b = FindSurface(camera, b_->depth, point.b.recorded_pixel);
    if (!in_a || !in_b) continue;
    point.a.surface = *in_a;
    point.b.surface = *in_b;
    points.push_back(point);
  }
  return points;
}

std::optional<CalibrationInformation> CalibrationPair::Linearize(
    const SensorCorrection::Vector& correction) const {
  Rigid3 b_from_a = b_->cam_from_world * a_->cam_from_world.Inverse();
  const auto information =
      LinearizePair(camera_, PointsWithSurfaces(correction), correction, &b_from_a);
  if (!information) return std::nullopt;
  const double squared_shift_rate = SquaredShiftRate(*a_->frame) + SquaredShiftRate(*b_->frame);
  return WithCommonError(*information, CommonVariance(camera_.camera(), squared_shift_rate,
                                                      b_->frame->readout_time, 0.0));
}

std::vector<PairResidual> CalibrationPair::Residuals(
    const SensorCorrection::Vector& correction) const {
  const std::vector<CalibrationPoint> points = PointsWithSurfaces(correction);
  Rigid3 b_from_a = b_->cam_from_world * a_->cam_from_world.Inverse();
  if (!LinearizePair(camera_, points, correction, &b_from_a)) return {};
  std::vector<PairResidual> residuals;
  for (const CalibrationPoint& point : points) {
    const RgbdPairReprojection factor(camera_, point.a, point.b, Eigen::Matrix3d::Identity());
    Eigen::Vector3d residual;
    if (!factor(b_from_a.params.data(), correction.data(), residual.data())) continue;
    const double inverse_depth = factor.InverseDepth(point.b, correction.data());
    if (!residual.allFinite() || !(inverse_depth > 0.0) || !std::isfinite(inverse_depth)) continue;
    residuals.push_back({point.b.recorded_pixel, residual.head<2>(), inverse_depth, residual.z()});
  }
  return residuals;
}

}  // namespace msc_vo
