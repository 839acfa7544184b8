// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace msc_vo {

namespace {

// Weight of the prior noise factor 1, as a number of residuals: the degrees of freedom of the
// Student distribution of a landmark's residuals. Chosen by measurement, see docs/lab/noise.md.
constexpr double kPrior = 2.0;
// Standard deviation, metres, of the depth error that a line has in all of its observations, as at
// the edge of a door casing. Chosen by measurement, see docs/lab/noise.md.
constexpr double kDepthOffsetSigma = 0.005;

constexpr int kPointParameters = 3;
constexpr int kLineParameters = 4;

// Sums over the observations of one landmark.
struct ResidualSums {
  double chi2 = 0.0;
  int num_residuals = 0;
  // Weighted sum and sum of weights of measured minus true depth; weights are inverse variances.
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

std::vector<ResidualSums> SumPointResiduals(const WindowIndex& index,
                                            const WindowInlierMask& inlier_mask,
                                            const WindowState& state, const WindowData& data) {
  std::vector<ResidualSums> sums(data.points.size());
  for (size_t i = 0; i < index.points.size(); ++i) {
    const auto& [keyframe, point] = index.points[i];
    const WindowData::PointObservation& o = data.point_observations[i];
    const Eigen::Vector3d in_cam = state.Pose(keyframe) * state.Point(point);
    if (!inlier_mask.points[i].reprojection || !IsInFront(in_cam)) continue;
    const Eigen::Vector2d pixels = data.camera.Project(in_cam) - o.pixel;
    sums[point].AddResiduals(pixels.squaredNorm() / (o.sigma * o.sigma), 2);
    if (!inlier_mask.points[i].depth) continue;
    const double depth = (1.0 / in_cam.z() - o.inverse_depth) / o.inverse_depth_sigma;
    sums[point].AddResiduals(depth * depth, 1);
  }
  return sums;
}

// The depth residual of a line is that at the middle of the observed segment, one row, because the
// depth errors at its ends are correlated.
std::vector<ResidualSums> SumLineResiduals(const WindowIndex& index,
                                           const WindowInlierMask& inlier_mask,
                                           const WindowState& state, const WindowData& data) {
  std::vector<ResidualSums> sums(data.lines.size());
  for (size_t i = 0; i < index.lines.size(); ++i) {
    const auto& [keyframe, line] = index.lines[i];
    const WindowData::LineObservation& o = data.line_observations[i];
    const LineSegment3 whole = state.Pose(keyframe) * state.Line(line);
    const std::optional<LinePart> part = ObservedPart(data.camera, o.segment, whole);
    if (!inlier_mask.lines[i].reprojection || !part) continue;
    const LineSegment3 in_cam = part->Of(whole);
    const Eigen::Vector2d pixels = LineResidual(data.camera, o.segment, o.sigma, in_cam);
    sums[line].AddResiduals(pixels.squaredNorm(), 2);
    if (!inlier_mask.lines[i].depth) continue;
    const WindowData::Line& previous = data.lines[line];
    const std::optional<double> inverse_depth = InverseDepthAt(data.camera, o.segment, in_cam, 0.5);
    if (!inverse_depth) continue;
    const double sigma = o.depth.SigmaAt(0.5);
    const double depth = (*inverse_depth - Nearer(o.depth, previous.depth_offset).At(0.5)) / sigma;
    sums[line].AddResiduals(depth * depth, 1);
    const double z = 1.0 / *inverse_depth;
    sums[line].AddOffset(1.0 / o.depth.At(0.5) - z, z * z * previous.noise * sigma);
  }
  return sums;
}

// One per point, and one per line.
std::pair<std::vector<ResidualSums>, std::vector<ResidualSums>> SumResiduals(
    const WindowIndex& index, const WindowInlierMask& inlier_mask, const WindowState& state,
    const WindowData& data) {
  return {SumPointResiduals(index, inlier_mask, state, data),
          SumLineResiduals(index, inlier_mask, state, data)};
}

double DegreesOfFreedom(const ResidualSums& sums, int num_parameters) {
  return std::max(0, sums.num_residuals - num_parameters);
}

double Noise(const ResidualSums& sums, int num_parameters) {
  return std::sqrt((kPrior + sums.chi2) / (kPrior + DegreesOfFreedom(sums, num_parameters)));
}

// Root of the ratio of the information of residuals whose noise is known to that of residuals whose
// noise is estimated from them.
double NoiseUncertainty(const ResidualSums& sums, int num_parameters) {
  const double weight = kPrior + DegreesOfFreedom(sums, num_parameters);
  return std::sqrt((weight + 2.0) / weight);
}

double DepthOffset(const ResidualSums& sums) {
  return sums.offset_sum / (sums.offset_weight + 1.0 / (kDepthOffsetSigma * kDepthOffsetSigma));
}

}  // namespace

void EstimateLandmarkNoise(const LandmarkNoiseOptions& options, const WindowIndex& index,
                           const WindowInlierMask& inlier_mask, const WindowState& state,
                           WindowData* data) {
  if (!options.enabled) return;
  const auto [points, lines] = SumResiduals(index, inlier_mask, state, *data);
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].num_residuals == 0) continue;
    data->points[i].noise = Noise(points[i], kPointParameters);
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].num_residuals == 0) continue;
    data->lines[i].noise = Noise(lines[i], kLineParameters);
    data->lines[i].depth_offset = DepthOffset(lines[i]);
  }
}

void AddNoiseUncertainty(const LandmarkNoiseOptions& options, const WindowIndex& index,
                         const WindowInlierMask& inlier_mask, const WindowState& state,
                         WindowData* data) {
  if (!options.enabled) return;
  const auto [points, lines] = SumResiduals(index, inlier_mask, state, *data);
  for (size_t i = 0; i < points.size(); ++i) {
    data->points[i].noise *= NoiseUncertainty(points[i], kPointParameters);
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    data->lines[i].noise *= NoiseUncertainty(lines[i], kLineParameters);
  }
}

}  // namespace msc_vo
