// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/surface_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "msc_vo/synthetic/scene/quad_raster.h"

namespace msc_vo {

namespace {

bool IsVisible(const SurfaceView& view, const Eigen::Vector3d& x_in_world, int quad) {
  const Eigen::Vector3d x = view.cam_from_world * x_in_world;
  if (x.z() <= 0.0) return false;
  const Eigen::Vector2d pixel = view.camera.Project(x);
  const int width = view.camera.width, height = view.camera.height;
  if (!(pixel.x() > -0.5 && pixel.x() < width - 0.5)) return false;
  if (!(pixel.y() > -0.5 && pixel.y() < height - 0.5)) return false;
  const int left = static_cast<int>(std::floor(pixel.x()));
  const int top = static_cast<int>(std::floor(pixel.y()));
  for (int j = std::max(top, 0); j <= std::min(top + 1, height - 1); ++j) {
    for (int i = std::max(left, 0); i <= std::min(left + 1, width - 1); ++i) {
      if (view.quad[static_cast<size_t>(j) * width + i] == quad) return true;
    }
  }
  return false;
}

Eigen::Vector3d OpticalAxis(const SurfaceView& view) {
  return view.cam_from_world.rotation().conjugate() * Eigen::Vector3d::UnitZ();
}

// The earlier view of the place that view `later` has come back to, with the largest overlap.
std::optional<TrueReturn> ReturnOf(const std::vector<SurfaceView>& views, int later,
                                   const ReturnOptions& options) {
  std::optional<TrueReturn> best;
  bool has_left = false;
  for (int earlier = later - 1; earlier >= 0; --earlier) {
    const SurfaceView &b = views[later], &a = views[earlier];
    const double forth = OverlapOf(b, a);
    if (has_left && forth >= options.min_overlap && ViewingAngle(a, b) <= options.max_angle) {
      const double overlap = std::min(forth, OverlapOf(a, b));
      if (overlap >= options.min_overlap && (!best || overlap > best->overlap)) {
        best = TrueReturn{later, later, later, earlier, overlap};
      }
    }
    has_left = has_left || forth <= options.max_between;
  }
  return best;
}

}  // namespace

Eigen::Vector3d SurfaceView::PointAt(int x, int y) const {
  const double z = depth[static_cast<size_t>(y) * camera.width + x];
  return cam_from_world.Inverse() * camera.BackProject(Eigen::Vector2d(x, y), z);
}

SurfaceView ViewSurfaces(const Scene& scene, const PinholeCamera& camera,
                         const Rigid3& cam_from_world) {
  const RowBand band{0, camera.height - 1};
  const std::vector<QuadView> views = ViewQuads(scene, camera, cam_from_world, band);
  const HitBuffer hits = Rasterize(views, band, camera.width);
  SurfaceView view{camera, cam_from_world, {}, {}};
  for (size_t i = 0; i < hits.view.size(); ++i) {
    const bool is_hit = hits.view[i] >= 0;
    view.quad.push_back(is_hit ? views[hits.view[i]].quad : -1);
    view.depth.push_back(is_hit ? 1.0 / hits.inverse_depth[i] : 0.0);
  }
  return view;
}

PinholeCamera ScaledCamera(const PinholeCamera& camera, int width) {
  const double scale = static_cast<double>(width) / camera.width;
  PinholeCamera scaled = camera;
  scaled.width = width;
  scaled.height = std::max(1, static_cast<int>(std::lround(scale * camera.height)));
  scaled.fx *= scale;
  scaled.fy *= scale;
  scaled.cx = (camera.cx + 0.5) * scale - 0.5;
  scaled.cy = (camera.cy + 0.5) * scale - 0.5;
  return scaled;
}

double OverlapOf(const SurfaceView& a, const SurfaceView& b) {
  if (a.quad.empty()) return 0.0;
  size_t num_visible = 0;
  for (int y = 0; y < a.camera.height; ++y) {
    for (int x = 0; x < a.camera.width; ++x) {
      const int quad = a.quad[static_cast<size_t>(y) * a.camera.width + x];
      if (quad >= 0 && IsVisible(b, a.PointAt(x, y), quad)) ++num_visible;
    }
  }
  return static_cast<double>(num_visible) / static_cast<double>(a.quad.size());
}

double ViewingAngle(const SurfaceView& a, const SurfaceView& b) {
  const Eigen::Vector3d p = OpticalAxis(a), q = OpticalAxis(b);
  return std::atan2(p.cross(q).norm(), p.dot(q));
}

std::vector<TrueReturn> FindReturns(const std::vector<SurfaceView>& views,
                                    const ReturnOptions& options) {
  std::vector<TrueReturn> returns;
  for (int later = 0; later < static_cast<int>(views.size()); ++later) {
    std::optional<TrueReturn> found = ReturnOf(views, later, options);
    if (!found) continue;
    if (!returns.empty() && returns.back().last == later - 1) {
      TrueReturn& run = returns.back();
      found->first = run.first;
      if (found->overlap < run.overlap) {
        run.last = later;
      } else {
        run = *found;
      }
    } else {
      returns.push_back(*found);
    }
  }
  return returns;
}

}  // namespace msc_vo
