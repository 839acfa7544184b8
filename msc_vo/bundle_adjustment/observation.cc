// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/observation.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/factors/camera_linearization.h"

namespace msc_vo {

InlierMask TestChiSquare(double reprojection, double depth, double limit, double limit_with_depth) {
  const bool passes = reprojection <= limit;
  return {passes, passes && reprojection + depth <= limit_with_depth};
}

bool IsInFront(const Eigen::Vector3d& x_in_cam) { return x_in_cam.z() >= kMinObservedDepth; }

bool IsInFront(const LineSegment3& line_in_cam) {
  return line_in_cam.start.z() >= kMinObservedDepth && line_in_cam.end.z() >= kMinObservedDepth;
}

namespace {

// Parameter of the point of the line that is seen beside `pixel`: on the plane through the viewing
// ray of the pixel and across the segment. Not finite where that plane contains the line.
double ParameterAt(const PinholeCamera& camera, const LineSegment2& segment,
                   const LineSegment3& line_in_cam, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d along = segment.Direction();
  const Eigen::Vector3d across(-along.y() / camera.fx, along.x() / camera.fy, 0.0);
  const Eigen::Vector3d normal = camera.Ray(pixel).cross(across);
  const Eigen::Vector3d start = line_in_cam.start, end = line_in_cam.end;
  return normal.dot(start) / normal.dot(start - end);
}

// The part with z >= kMinObservedDepth of a line that has one end there.
LinePart PartInFront(const LineSegment3& line_in_cam) {
  const double start = line_in_cam.start.z(), end = line_in_cam.end.z();
  const double limit = (kMinObservedDepth - start) / (end - start);
  return start < end ? LinePart{limit, 1.0} : LinePart{0.0, limit};
}

}  // namespace

std::optional<LinePart> ObservedPart(const PinholeCamera& camera, const LineSegment2& segment,
                                     const LineSegment3& line_in_cam) {
  if (IsInFront(line_in_cam)) return LinePart();
  if (!IsInFront(Eigen::Vector3d(line_in_cam.start)) &&
      !IsInFront(Eigen::Vector3d(line_in_cam.end))) {
    return std::nullopt;
  }
  const LinePart front = PartInFront(line_in_cam);
  const double start = ParameterAt(camera, segment, line_in_cam, segment.start);
  const double end = ParameterAt(camera, segment, line_in_cam, segment.end);
  if (!std::isfinite(start) || !std::isfinite(end)) return front;
  const LinePart part{std::clamp(start, front.start, front.end),
                      std::clamp(end, front.start, front.end)};
  return part.Of(line_in_cam).Length() < kMinLineLength ? front : part;
}

double ImageLineSigma(const LineSegment2& segment, double sigma, const Eigen::Vector2d& pixel) {
  const double s = segment.Parameter(pixel);
  return sigma * std::sqrt((1.0 - s) * (1.0 - s) + s * s);
}

LineReprojection MakeLineReprojection(const PinholeCamera& camera, const LineSegment2& segment,
                                      double sigma, const LineSegment3& line_in_cam) {
  return {camera, segment, ImageLineSigma(segment, sigma, camera.Project(line_in_cam.start)),
          ImageLineSigma(segment, sigma, camera.Project(line_in_cam.end))};
}

LineDepthReprojection MakeLineDepthReprojection(const PinholeCamera& camera,
                                                const LineSegment2& segment, const LineDepth& depth,
                                                const LineSegment3& line_in_cam) {
  const double s_start = segment.Parameter(camera.Project(line_in_cam.start));
  const double s_end = segment.Parameter(camera.Project(line_in_cam.end));
  return {camera, segment, depth, depth.SigmaAt(s_start), depth.SigmaAt(s_end)};
}

Eigen::Vector2d LineResidual(const PinholeCamera& camera, const LineSegment2& segment, double sigma,
                             const LineSegment3& line_in_cam) {
  return ResidualInCamera(MakeLineReprojection(camera, segment, sigma, line_in_cam),
                          {line_in_cam.start, line_in_cam.end});
}

std::optional<double> InverseDepthAt(const PinholeCamera& camera, const LineSegment2& segment,
                                     const LineSegment3& line_in_cam, double s) {
  // 1/z is linear along the image of a line.
  const double start = segment.Parameter(camera.Project(line_in_cam.start));
  const double end = segment.Parameter(camera.Project(line_in_cam.end));
  // The rounding of pixel coordinates changes parameters by up to 1e-12: the difference of
  // parameters that are closer than this has no accurate digit.
  if (std::abs(end - start) < 1e-11) return std::nullopt;
  const double ratio = (s - start) / (end - start);
  return (1.0 - ratio) / line_in_cam.start.z() + ratio / line_in_cam.end.z();
}

}  // namespace msc_vo
