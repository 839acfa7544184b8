// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_noise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "msc_vo/problems/observation.h"

namespace msc_vo {

namespace {

constexpr int kPointParameters = 3;
constexpr int kLineParameters = 4;

// What the observations of one landmark say.
struct Evidence {
  double chi2 = 0.0;  // in the sigmas of the window
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
using EvidenceById = std::map<LandmarkId, Evidence>;

// Adds what an observation leaves in the image (2 rows) and, where that agrees with it, in depth (1
// row). Returns whether the depth was added.
bool AddObservation(double pixel_chi2, const std::optional<double>& depth, double limit,
                    double limit_with_depth, Evidence* evidence) {
  evidence->AddResiduals(pixel_chi2, 2);
  if (!depth) return false;
  const double depth_chi2 = *depth * *depth;
  if (!TestChiSquare(pixel_chi2, depth_chi2, limit, limit_with_depth).depth) return false;
  evidence->AddResiduals(depth_chi2, 1);
  return true;
}

EvidenceById OfPoints(const WindowOptions& options, const WindowResiduals& residuals) {
  EvidenceById evidence;
  const auto& observations = residuals.window().point_observations;
  for (size_t i = 0; i < observations.size(); ++i) {
    const std::optional<Eigen::Vector2d> pixel = residuals.PointPixel(i);
    if (observations[i].rejected || !pixel) continue;
    AddObservation(pixel->squaredNorm(), residuals.PointDepth(i), options.reject_chi2_2,
                   options.reject_chi2_3, &evidence[observations[i].point]);
  }
  return evidence;
}

EvidenceById OfLines(const WindowOptions& options, const WindowResiduals& residuals) {
  EvidenceById evidence;
  const auto& observations = residuals.window().line_observations;
  for (size_t i = 0; i < observations.size(); ++i) {
    const WindowData::LineObservation& o = observations[i];
    const std::optional<Eigen::Vector2d> pixel = residuals.LinePixel(i);
    if (o.rejected || !pixel) continue;
    Evidence& its = evidence[o.line];
    if (!AddObservation(pixel->squaredNorm(), residuals.LineDepth(i), options.reject_chi2_2,
                        options.reject_chi2_3, &its)) {
      continue;
    }
    const double z = 1.0 / residuals.LineInverseDepth(i);
    const double measured = 1.0 / o.depth.At(0.5);
    its.AddOffset(measured - z, z * z * o.depth.SigmaAt(0.5));
  }
  return evidence;
}

// `before`: the noise that the window was solved with.
double Noise(const LandmarkNoiseOptions& options, const Evidence& evidence, int num_parameters,
             double before) {
  const double freedom = std::max(0, evidence.num_residuals - num_parameters);
  return std::sqrt((options.prior + before * before * evidence.chi2) / (options.prior + freedom));
}

// `before`: the offset that was taken off already.
double DepthOffset(const LandmarkNoiseOptions& options, const Evidence& evidence, double before) {
  const double sigma = options.depth_offset_sigma;
  return (evidence.offset_sum + before * evidence.offset_weight) /
         (evidence.offset_weight + 1.0 / (sigma * sigma));
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

void ApplyLandmarkNoise(const Map& map, WindowData* window) {
  for (WindowData::PointObservation& o : window->point_observations) {
    const double noise = map.FindPoint(o.point)->noise;
    o.sigma *= noise;
    o.inverse_depth_sigma *= noise;
  }
  for (WindowData::LineObservation& o : window->line_observations) {
    const LineLandmark& line = *map.FindLine(o.line);
    o.sigma *= line.noise;
    if (o.has_depth) o.depth = Nearer(o.depth, line.depth_offset);
    o.depth.covariance *= line.noise * line.noise;
  }
}

void LearnLandmarkNoise(const LandmarkNoiseOptions& options, const WindowOptions& window_options,
                        const WindowResiduals& residuals, Map* map) {
  if (!options.enabled) return;
  for (const auto& [id, evidence] : OfPoints(window_options, residuals)) {
    map->SetPointNoise(id, Noise(options, evidence, kPointParameters, map->FindPoint(id)->noise));
  }
  for (const auto& [id, evidence] : OfLines(window_options, residuals)) {
    const LineLandmark& line = *map->FindLine(id);
    map->SetLineNoise(id, Noise(options, evidence, kLineParameters, line.noise),
                      DepthOffset(options, evidence, line.depth_offset));
  }
}

}  // namespace msc_vo
