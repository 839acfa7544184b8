// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/frame_intrinsics.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace msc_vo {

namespace {

void RemoveDepths(Frame* frame) {
  ForEachFeatures(*frame, [](auto& features) {
    for (auto& feature : features) feature.RemoveDepth();
  });
  frame->depth_ranges = {};
}

bool AreEqual(const PinholeCamera& a, const PinholeCamera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && a.width == b.width &&
         a.height == b.height;
}

// The ranges of the cells that the centres of the cells of the other camera show.
DepthRanges ChangeCamera(const DepthRanges& ranges, const PinholeCamera& from,
                         const PinholeCamera& to) {
  DepthRanges changed;
  if (ranges.cells.empty()) return changed;
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      const Eigen::Vector2d pixel = from.Project(to.Ray(DepthRanges::CellCenter(to, column, row)));
      changed.cells.push_back(from.IsInside(pixel) ? ranges.cells[DepthRanges::CellOf(from, pixel)]
                                                   : DepthRanges::Cell());
    }
  }
  return changed;
}

// The same lens, with the undistorted image of another camera.
std::shared_ptr<const CameraIntrinsics> ChangeCamera(const CameraIntrinsics& intrinsics,
                                                     const PinholeCamera& camera) {
  CameraIntrinsics changed = intrinsics;
  changed.distortion.recorded = intrinsics.distortion.Recorded(intrinsics.camera);
  changed.camera = camera;
  return std::make_shared<const CameraIntrinsics>(changed);
}

// The planes that pixels with the same inverse depths show through another camera: with rays b = A
// b' of the pixels, q . b = (A^T q) . b'.
void MovePlanes(const PinholeCamera& from, const PinholeCamera& to,
                std::vector<PlaneFeature>* planes) {
  Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
  a(0, 0) = to.fx / from.fx;
  a(0, 2) = (to.cx - from.cx) / from.fx;
  a(1, 1) = to.fy / from.fy;
  a(1, 2) = (to.cy - from.cy) / from.fy;
  const Eigen::Matrix3d inverse = a.inverse();
  for (PlaneFeature& plane : *planes) {
    plane.inverse_depth = a.transpose() * plane.inverse_depth;
    plane.covariance = a.transpose() * plane.covariance * a;
    plane.mean_square_ray = inverse * plane.mean_square_ray * inverse.transpose();
    for (Eigen::Vector2d& vertex : plane.hull) {
      vertex = (inverse * vertex.homogeneous()).head<2>();
    }
  }
}

}  // namespace

std::shared_ptr<const Frame> ChangeIntrinsics(
    std::shared_ptr<const Frame> frame, const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  if (!intrinsics || !frame->intrinsics || frame->intrinsics == intrinsics) return frame;
  const CameraIntrinsics& from = *frame->intrinsics;
  const auto moved = std::make_shared<Frame>(*frame);
  moved->intrinsics = intrinsics;
  moved->camera = intrinsics->camera;
  if (moved->lens) moved->lens = intrinsics->distortion;
  if (intrinsics->registration.has_value() != from.registration.has_value()) RemoveDepths(&*moved);
  // Planes that another registration has bent cannot be measured again without the depth image.
  if (!HasSameRegistration(*intrinsics, from)) moved->planes.clear();
  MovePlanes(from.camera, intrinsics->camera, &moved->planes);
  if (from.distortion.IsZero() && intrinsics->distortion.IsZero()) return moved;
  const auto move = [&](const Eigen::Vector2d& pixel, double* /*inverse_depth*/) {
    return MovePixel(from, *intrinsics, pixel);
  };
  ForEachFeatures(*moved, [&](auto& features) {
    for (auto& feature : features) feature.MovePixels(move);
  });
  moved->grid = FeatureGrid(moved->camera, moved->points);
  return moved;
}

std::shared_ptr<const Frame> ChangeCamera(const std::shared_ptr<const Frame>& frame,
                                          const PinholeCamera& camera) {
  const PinholeCamera& from = frame->camera;
  if (AreEqual(from, camera)) return frame;
  const auto changed = std::make_shared<Frame>(*frame);
  const double scale = camera.FocalLength() / from.FocalLength();
  ForEachFeatures(*changed, [&](auto& features) {
    for (auto& feature : features) {
      feature.MovePixels([&](const Eigen::Vector2d& pixel, double* /*inverse_depth*/) {
        return camera.Project(from.Ray(pixel));
      });
      feature.sigma *= scale;
    }
  });
  const int levels = static_cast<int>(std::lround(std::log(scale) / std::log(kPyramidScale)));
  for (PointFeature& point : changed->points) point.level += levels;
  changed->camera = camera;
  if (frame->intrinsics) changed->intrinsics = ChangeCamera(*frame->intrinsics, camera);
  changed->grid = FeatureGrid(camera, changed->points);
  changed->depth_ranges = ChangeCamera(frame->depth_ranges, from, camera);
  changed->lens.reset();
  changed->velocity.reset();
  changed->readout_time = 0.0;
  return changed;
}

}  // namespace msc_vo
