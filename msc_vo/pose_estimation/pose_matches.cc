// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_matches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "msc_vo/factors/camera_linearization.h"

namespace msc_vo {

namespace {

InlierMask ClassifyPoint(const PoseOptions& options, const PinholeCamera& camera,
                         const Rigid3& pose, const PoseData::Point& p) {
  const Eigen::Vector3d x = pose * p.position;
  if (!IsInFront(x)) return {};
  const bool has_depth = options.point_depth.enabled && p.inverse_depth > 0.0;
  const double pixels = options.point_reprojection.enabled ? PixelChiSquare(camera, pose, p) : 0.0;
  const double depth =
      has_depth ? ResidualInCamera(DepthReprojection(p.inverse_depth, p.inverse_depth_sigma), {x})
                      .squaredNorm()
                : 0.0;
  InlierMask mask = TestChiSquare(pixels, depth, options.reject_chi2_2, options.reject_chi2_3);
  mask.depth = mask.depth && has_depth;
  return mask;
}

InlierMask ClassifyLine(const PoseOptions& options, const PinholeCamera& camera, const Rigid3& pose,
                        const PoseData::Line& l) {
  const LineSegment3 line = pose * l.map_segment;
  if (!IsInFront(line)) return {};
  const bool has_depth = options.line_depth.enabled && l.has_depth;
  const double pixels = options.line_reprojection.enabled ? PixelChiSquare(camera, pose, l) : 0.0;
  const double depth =
      has_depth ? ResidualInCamera(MakeLineDepthReprojection(camera, l.segment, l.depth, line),
                                   {line.start, line.end})
                      .squaredNorm()
                : 0.0;
  InlierMask mask = TestChiSquare(pixels, depth, options.reject_chi2_2, options.reject_chi2_4);
  mask.depth = mask.depth && has_depth;
  return mask;
}

// Ratio of the median squared residual of the frame's points to its expectation, clamped to
// [1, max_frame_noise^2]: the variance inflation of a blurred image.
double SquaredFrameNoise(const PoseOptions& options, const PoseData& data, const Rigid3& pose) {
  std::vector<double> chi2;
  chi2.reserve(data.points.size());
  for (const PoseData::Point& p : data.points) {
    if (IsInFront(pose * p.position)) chi2.push_back(PixelChiSquare(data.camera, pose, p));
  }
  return std::clamp(MedianChiSquareRatio(std::move(chi2)), 1.0,
                    options.max_frame_noise * options.max_frame_noise);
}

// Maps NaN, as of a sigma whose inverse overflows, to infinity: std::nth_element needs an order.
double NanToInfinity(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

}  // namespace

double PixelChiSquare(const PinholeCamera& camera, const Rigid3& pose,
                      const PoseData::Point& point) {
  const Eigen::Vector3d in_cam = pose * point.position;
  if (!IsInFront(in_cam)) return std::numeric_limits<double>::infinity();
  return NanToInfinity(
      ResidualInCamera(PointReprojection(camera, point.pixel, point.sigma), {in_cam})
          .squaredNorm());
}

double PixelChiSquare(const PinholeCamera& camera, const Rigid3& pose, const PoseData::Line& line) {
  const LineSegment3 in_cam = pose * line.map_segment;
  if (!IsInFront(in_cam)) return std::numeric_limits<double>::infinity();
  return NanToInfinity(LineResidual(camera, line.segment, line.sigma, in_cam).squaredNorm());
}

double MedianChiSquareRatio(std::vector<double> chi2) {
  constexpr size_t kMinValues = 10;
  constexpr double kChiSquareMedian2 = 1.386;
  if (chi2.size() < kMinValues) return 1.0;
  const auto middle = chi2.begin() + static_cast<std::ptrdiff_t>(chi2.size() / 2);
  std::nth_element(chi2.begin(), middle, chi2.end());
  return *middle / kChiSquareMedian2;
}

PoseInlierMask AllInFront(const PoseOptions& options, const PoseData& data, const Rigid3& pose) {
  PoseInlierMask all;
  for (const PoseData::Point& p : data.points) {
    const bool in_front = IsInFront(pose * p.position);
    all.points.push_back(
        {in_front, in_front && options.point_depth.enabled && p.inverse_depth > 0.0});
  }
  for (const PoseData::Line& l : data.lines) {
    const bool in_front = IsInFront(pose * l.map_segment);
    all.lines.push_back({in_front, in_front && options.line_depth.enabled && l.has_depth});
  }
  return all;
}

PoseInlierMask ClassifyMatches(PoseOptions options, const PoseData& data, const Rigid3& pose) {
  const double noise2 = SquaredFrameNoise(options, data, pose);
  for (double* limit : {&options.reject_chi2_2, &options.reject_chi2_3, &options.reject_chi2_4}) {
    *limit *= noise2;
  }
  PoseInlierMask result;
  for (const PoseData::Point& p : data.points) {
    result.points.push_back(p.dynamic ? InlierMask()
                                      : ClassifyPoint(options, data.camera, pose, p));
  }
  for (const PoseData::Line& l : data.lines) {
    result.lines.push_back(l.dynamic ? InlierMask() : ClassifyLine(options, data.camera, pose, l));
  }
  return result;
}

void AddFactors(const PoseOptions& options, const PinholeCamera& camera,
                const PoseData::Point& point, const InlierMask& mask, PoseFactors* factors) {
  if (mask.reprojection && options.point_reprojection.enabled) {
    factors->point_reprojection.blocks.push_back(
        {PointReprojection(camera, point.pixel, point.sigma), point.position});
  }
  if (mask.depth) {
    factors->point_depth.blocks.push_back(
        {DepthReprojection(point.inverse_depth, point.inverse_depth_sigma), point.position});
  }
}

void AddFactors(const PoseOptions& options, const PinholeCamera& camera, const PoseData::Line& line,
                const InlierMask& mask, const Rigid3& pose, PoseFactors* factors) {
  if (!mask.reprojection) return;
  const LineSegment3 in_cam = pose * line.map_segment;
  Eigen::Matrix<double, 6, 1> ends;
  ends << line.map_segment.start, line.map_segment.end;
  if (options.line_reprojection.enabled) {
    factors->line_reprojection.blocks.push_back(
        {MakeLineReprojection(camera, line.segment, line.sigma, in_cam), ends});
  }
  if (mask.depth) {
    factors->line_depth.blocks.push_back(
        {MakeLineDepthReprojection(camera, line.segment, line.depth, in_cam), ends});
  }
}

void SetLosses(const PoseOptions& options, PoseFactors* factors) {
  factors->point_reprojection.huber = options.point_reprojection.huber;
  factors->point_depth.huber = options.point_depth.huber;
  factors->line_reprojection.huber = options.line_reprojection.huber;
  factors->line_depth.huber = options.line_depth.huber;
}

PoseFactors BuildFactors(const PoseOptions& options, const PoseData& data,
                         const PoseInlierMask& mask, const Rigid3& pose, bool robust) {
  PoseFactors factors;
  if (robust) SetLosses(options, &factors);
  for (size_t i = 0; i < data.points.size(); ++i) {
    AddFactors(options, data.camera, data.points[i], mask.points[i], &factors);
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    AddFactors(options, data.camera, data.lines[i], mask.lines[i], pose, &factors);
  }
  factors.custom = data.custom_factors;
  return factors;
}

}  // namespace msc_vo
