// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace msc_vo {

namespace {

constexpr int kPointParameters = 3;
constexpr int kLineParameters = 4;

// What the observations of one landmark say.
struct Evidence {
  double chi2 = 0.0;
  int num_residuals = 0;
  // Of depths measured too far, metres, with their inverse variances as weights.
  double offset_sum = 0.0;
  double offset_weight = 0.0;

  void AddResiduals(double squared_norm, int rows) {
    chi2 += squared_norm;
    num_residuals += rows;
  }
  void AddOffset(double offset, double sigma) {
    offset_sum += offset / (sigma * sigma);
    offset_weight += 1.0 / (sigma * sigma);
  }
};

std::vector<Evidence> OfPoints(const WindowIndex& index, const WindowInlierMask& inlier_mask,
                               const WindowState& state, const WindowData& data) {
  std::vector<Evidence> evidence(data.points.size());
  for (size_t i = 0; i < index.points.size(); ++i) {
    const auto& [keyframe, point] = index.points[i];
    const WindowData::PointObservation& o = data.point_observations[i];
    const Eigen::Vector3d in_cam = state.Pose(keyframe) * state.Point(point);
    if (!inlier_mask.points[i].reprojection || !IsInFront(in_cam)) continue;
    const Eigen::Vector2d pixels = data.camera.Project(in_cam) - o.pixel;
    evidence[point].AddResiduals(pixels.squaredNorm() / (o.sigma * o.sigma), 2);
    if (!inlier_mask.points[i].depth) continue;
    const double depth = (1.0 / in_cam.z() - o.inverse_depth) / o.inverse_depth_sigma;
    evidence[point].AddResiduals(depth * depth, 1);
  }
  return evidence;
}

// Of depth one row, in the middle of the observed segment: the errors of its ends are one error.
std::vector<Evidence> OfLines(const WindowIndex& index, const WindowInlierMask& inlier_mask,
                              const WindowState& state, const WindowData& data) {
  std::vector<Evidence> evidence(data.lines.size());
  for (size_t i = 0; i < index.lines.size(); ++i) {
    const auto& [keyframe, line] = index.lines[i];
    const WindowData::LineObservation& o = data.line_observations[i];
    const LineSegment3 in_cam = state.Pose(keyframe) * state.Line(line);
    if (!inlier_mask.lines[i].reprojection || !IsInFront(in_cam)) continue;
    const Eigen::Vector2d pixels = LineResidual(data.camera, o.segment, o.sigma, in_cam);
    evidence[line].AddResiduals(pixels.squaredNorm(), 2);
    if (!inlier_mask.lines[i].depth) continue;
    const WindowData::Line& before = data.lines[line];
    const double inverse_depth = InverseDepthAt(data.camera, o.segment, in_cam, 0.5);
    const double sigma = o.depth.SigmaAt(0.5);
    const double depth = (inverse_depth - Nearer(o.depth, before.depth_offset).At(0.5)) / sigma;
    evidence[line].AddResiduals(depth * depth, 1);
    const double z = 1.0 / inverse_depth;
    evidence[line].AddOffset(1.0 / o.depth.At(0.5) - z, z * z * before.noise * sigma);
  }
  return evidence;
}

double Noise(const LandmarkNoiseOptions& options, const Evidence& evidence, int num_parameters) {
  const double freedom = std::max(0, evidence.num_residuals - num_parameters);
  return std::sqrt((options.prior + evidence.chi2) / (options.prior + freedom));
}

double DepthOffset(const LandmarkNoiseOptions& options, const Evidence& evidence) {
  const double sigma = options.depth_offset_sigma;
  return evidence.offset_sum / (evidence.offset_weight + 1.0 / (sigma * sigma));
}

}  // namespace

bool LandmarkNoiseOptions::IsValid(std::string* error) const {
  if (!(prior > 0.0)) {
    *error = "landmark_noise.prior must be positive";
  } else if (!(depth_offset_sigma > 0.0)) {
    *error = "landmark_noise.depth_offset_sigma must be positive";
  } else {
    return true;
  }
  return false;
}

void LearnLandmarkNoise(const LandmarkNoiseOptions& options, const WindowIndex& index,
                        const WindowInlierMask& inlier_mask, const WindowState& state,
                        WindowData* data) {
  if (!options.enabled) return;
  const std::vector<Evidence> points = OfPoints(index, inlier_mask, state, *data);
  const std::vector<Evidence> lines = OfLines(index, inlier_mask, state, *data);
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].num_residuals == 0) continue;
    data->points[i].noise = Noise(options, points[i], kPointParameters);
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].num_residuals == 0) continue;
    data->lines[i].noise = Noise(options, lines[i], kLineParameters);
    data->lines[i].depth_offset = DepthOffset(options, lines[i]);
  }
}

}  // namespace msc_vo
