// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_match.h"

#include <cmath>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/factors/camera_linearization.h"
#include "msc_vo/pose_estimation/pose_factors.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

PointPoseMatch MakePoseMatch(const PointMatch& match, const Frame& frame,
                             const Rigid3& /*cam_from_world*/, const PointLandmark* landmark,
                             const NoiseScale& scale) {
  const PointFeature& feature = frame.points[match.feature];
  const double noise = landmark != nullptr ? landmark->noise : 1.0;
  if (landmark != nullptr && landmark->has_false_depth) {
    return {match.position, feature.pixel, noise * feature.sigma};
  }
  return {match.position, feature.pixel, noise * feature.sigma, feature.inverse_depth,
          noise * scale.point_depth * feature.inverse_depth_sigma};
}

const char* MatchError(const PointPoseMatch& p) {
  const char* error = PositionError(p.position);
  return error != nullptr
             ? error
             : PointObservationError(p.pixel, p.sigma, p.inverse_depth, p.inverse_depth_sigma);
}

bool HasReprojection(const PoseOptions& options, const PointPoseMatch& /*point*/) {
  return options.point_reprojection.enabled;
}
bool HasDepth(const PoseOptions& options, const PointPoseMatch& point) {
  return options.point_depth.enabled && point.inverse_depth > 0.0;
}

double PixelChiSquare(const PinholeCamera& camera, const PointPoseMatch& point,
                      const Eigen::Vector3d& in_cam) {
  return ResidualInCamera(PointReprojection(camera, point.pixel, point.sigma), {in_cam})
      .squaredNorm();
}
double DepthChiSquare(const PinholeCamera& /*camera*/, const PointPoseMatch& point,
                      const Eigen::Vector3d& in_cam) {
  return ResidualInCamera(DepthReprojection(point.inverse_depth, point.inverse_depth_sigma),
                          {in_cam})
      .squaredNorm();
}
double LimitWithDepth(const PoseOptions& options, const PointPoseMatch& /*point*/) {
  return options.reject_chi2_3;
}

void AddFactors(const PoseOptions& options, const PinholeCamera& camera,
                const PointPoseMatch& point, const InlierMask& mask, const Rigid3& /*pose*/,
                PoseFactors* factors) {
  if (mask.reprojection && options.point_reprojection.enabled) {
    factors->Of<PointReprojection>().blocks.push_back(
        {PointReprojection(camera, point.pixel, point.sigma), point.position});
  }
  if (mask.depth) {
    factors->Of<DepthReprojection>().blocks.push_back(
        {DepthReprojection(point.inverse_depth, point.inverse_depth_sigma), point.position});
  }
}

void SetLosses(LandmarkKind<PointLandmark> /*kind*/, const PoseOptions& options,
               PoseFactors* factors) {
  factors->Of<PointReprojection>().huber = options.point_reprojection.huber;
  factors->Of<DepthReprojection>().huber = options.point_depth.huber;
}

void WeightByMapVariance(PointPoseMatch* point) {
  const double scale = 1.0 / std::sqrt(1.0 + point->map_variance);
  point->sigma *= scale;
  point->inverse_depth_sigma *= scale;
}

void AddVariances(const PoseOptions& options, const PointPoseMatch& point, const InlierMask& mask,
                  double* sum) {
  const double rows = options.point_reprojection.enabled ? 2.0 : 0.0;
  *sum += (mask.reprojection ? rows : 0.0) * (1.0 + point.map_variance);
  *sum += (mask.depth ? 1.0 : 0.0) * (1.0 + point.map_variance);
}

LinePoseMatch MakePoseMatch(const LineMatch& match, const Frame& frame,
                            const Rigid3& cam_from_world, const LineLandmark* landmark,
                            const NoiseScale& scale) {
  const LineFeature& feature = frame.lines[match.feature];
  const LinePart part = ObservedPart(frame.camera, feature.segment, cam_from_world * match.segment)
                            .value_or(LinePart());
  const double noise = landmark != nullptr ? landmark->noise : 1.0;
  LineDepth depth = feature.depth.value_or(LineDepth());
  if (landmark != nullptr) depth = Nearer(depth, landmark->depth_offset);
  depth.covariance *= noise * noise * scale.line_depth * scale.line_depth;
  return {part.Of(match.segment), feature.segment, noise * scale.line_pixel * feature.sigma,
          feature.depth.has_value() && (landmark == nullptr || !landmark->has_false_depth), depth};
}

const char* MatchError(const LinePoseMatch& l) {
  const char* error = MapLineError(l.map_segment);
  return error != nullptr ? error : LineObservationError(l.segment, l.sigma, l.has_depth, l.depth);
}

bool HasReprojection(const PoseOptions& options, const LinePoseMatch& /*line*/) {
  return options.line_reprojection.enabled;
}
bool HasDepth(const PoseOptions& options, const LinePoseMatch& line) {
  return options.line_depth.enabled && line.has_depth;
}

double PixelChiSquare(const PinholeCamera& camera, const LinePoseMatch& line,
                      const LineSegment3& in_cam) {
  return LineResidual(camera, line.segment, line.sigma, in_cam).squaredNorm();
}
double DepthChiSquare(const PinholeCamera& camera, const LinePoseMatch& line,
                      const LineSegment3& in_cam) {
  return ResidualInCamera(MakeLineDepthReprojection(camera, line.segment, line.depth, in_cam),
                          {in_cam.start, in_cam.end})
      .squaredNorm();
}
double LimitWithDepth(const PoseOptions& options, const LinePoseMatch& /*line*/) {
  return options.reject_chi2_4;
}

void AddFactors(const PoseOptions& options, const PinholeCamera& camera, const LinePoseMatch& line,
                const InlierMask& mask, const Rigid3& pose, PoseFactors* factors) {
  if (!mask.reprojection) return;
  const LineSegment3 in_cam = pose * line.map_segment;
  Eigen::Matrix<double, 6, 1> ends;
  ends << line.map_segment.start, line.map_segment.end;
  if (options.line_reprojection.enabled) {
    factors->Of<LineReprojection>().blocks.push_back(
        {MakeLineReprojection(camera, line.segment, line.sigma, in_cam), ends});
  }
  if (mask.depth) {
    factors->Of<LineDepthReprojection>().blocks.push_back(
        {MakeLineDepthReprojection(camera, line.segment, line.depth, in_cam), ends});
  }
}

void SetLosses(LandmarkKind<LineLandmark> /*kind*/, const PoseOptions& options,
               PoseFactors* factors) {
  factors->Of<LineReprojection>().huber = options.line_reprojection.huber;
  factors->Of<LineDepthReprojection>().huber = options.line_depth.huber;
}

void WeightByMapVariance(LinePoseMatch* line) {
  const double variance_scale = 1.0 / (1.0 + line->map_variance);
  line->sigma *= std::sqrt(variance_scale);
  line->depth.covariance *= variance_scale;
}

void AddVariances(const PoseOptions& options, const LinePoseMatch& line, const InlierMask& mask,
                  double* sum) {
  if (!mask.reprojection) return;
  const double rows = options.line_reprojection.enabled ? 2.0 : 0.0;
  *sum += (rows + (mask.depth ? 2.0 : 0.0)) * (1.0 + line.map_variance);
}

}  // namespace msc_vo
