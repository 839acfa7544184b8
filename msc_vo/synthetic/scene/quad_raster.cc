// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/quad_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace msc_vo {

namespace {

constexpr double kNear = 0.01;  // near clipping plane, metres; paths keep a larger distance
// Tolerance at the border of a rectangle, pixels: closes gaps between rectangles with a common
// edge. Rounding errors are many orders of magnitude smaller.
constexpr double kTolerance = 1e-6;

// Coefficients of c . ray(x, y) as a linear form in (x, y, 1).
Eigen::Vector3d LinearForm(const PinholeCamera& camera, const Eigen::Vector3d& c) {
  const double x = c.x() / camera.fx, y = c.y() / camera.fy;
  return {x, y, c.z() - x * camera.cx - y * camera.cy};
}

// Rows of `band` that the rectangle with the given origin and edges a, b (camera frame) may touch;
// none if first > last.
RowBand BoundRows(const PinholeCamera& camera, const RowBand& band, const Eigen::Vector3d& origin,
                  const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  double low = camera.height, high = -1.0;
  for (const Eigen::Vector3d& corner :
       {origin, Eigen::Vector3d(origin + a), Eigen::Vector3d(origin + b),
        Eigen::Vector3d(origin + a + b)}) {
    // The projection of a rectangle that extends behind the camera is not bounded by its corners.
    const bool in_front = corner.z() > kNear;
    low = std::min(low, in_front ? camera.Project(corner).y() : 0.0);
    high = std::max(high, in_front ? camera.Project(corner).y() : camera.height);
  }
  return {static_cast<int>(std::clamp(low - 1.0, band.first + 0.0, band.last + 1.0)),
          static_cast<int>(std::clamp(high + 1.0, band.first - 1.0, band.last + 0.0))};
}

// Range of x in a row; empty if first > last.
struct RowSpan {
  int first = 0;
  int last = -1;
};

using Outline = std::array<Eigen::Vector3d, 5>;

// Returns the pixels of row `y` at which every form is >= 0 at some position within `reach` pixels
// along both axes: with a reach of 0 the pixels whose centres are inside the outline, with 0.5
// those whose squares the outline touches.
RowSpan SpanOfRow(const Outline& inside, int width, int y, double reach) {
  double low = 0.0, high = width - 1.0;
  for (const Eigen::Vector3d& form : inside) {
    const double slope = form.x();
    const double offset =
        form.y() * y + form.z() + reach * (std::abs(form.x()) + std::abs(form.y()));
    if (slope > 0.0) {
      low = std::max(low, -offset / slope - kTolerance);
    } else if (slope < 0.0) {
      high = std::min(high, -offset / slope + kTolerance);
    } else if (offset < 0.0) {
      return {};
    }
  }
  if (low > high) return {};
  return {static_cast<int>(std::ceil(low)), static_cast<int>(high)};
}

Outline InsideForms(const QuadView& view) {
  const Eigen::Vector3d& w = view.inverse_depth;
  return {view.u_over_z, w - view.u_over_z, view.v_over_z, w - view.v_over_z,
          Eigen::Vector3d(0.0, 0.0, 1.0 / kNear) - w};
}

}  // namespace

bool QuadView::Contains(const Eigen::Vector3d& pixel, double w) const {
  const double u = u_over_z.dot(pixel), v = v_over_z.dot(pixel);
  const double slack = 1e-9 * w;  // corresponds to kTolerance for rectangles of some hundred pixels
  return w > 0.0 && w < 1.0 / kNear && u >= -slack && v >= -slack && u <= w + slack &&
         v <= w + slack;
}

std::vector<QuadView> ViewQuads(const Scene& scene, const PinholeCamera& camera,
                                const Rigid3& cam_from_world, const RowBand& band) {
  std::vector<QuadView> views;
  for (size_t i = 0; i < scene.quads.size(); ++i) {
    const Quad& quad = scene.quads[i];
    const Eigen::Vector3d origin = cam_from_world * quad.origin;
    const Eigen::Vector3d a = cam_from_world.rotation() * quad.edge_u;
    const Eigen::Vector3d b = cam_from_world.rotation() * quad.edge_v;
    const Eigen::Vector3d normal = a.cross(b);
    const double offset = normal.dot(origin);
    if (offset >= 0.0) continue;  // faces away from the camera
    QuadView view;
    view.rows = BoundRows(camera, band, origin, a, b);
    if (view.rows.first > view.rows.last) continue;
    view.quad = static_cast<int>(i);
    view.inverse_depth = LinearForm(camera, normal / offset);
    const Eigen::Vector3d per_u = a / a.squaredNorm(), per_v = b / b.squaredNorm();
    view.u_over_z = LinearForm(camera, per_u) - per_u.dot(origin) * view.inverse_depth;
    view.v_over_z = LinearForm(camera, per_v) - per_v.dot(origin) * view.inverse_depth;
    views.push_back(view);
  }
  return views;
}

void RemoveInvisible(const Scene& scene, const PinholeCamera& camera, const Rigid3& cam_from_world,
                     std::vector<QuadView>* views) {
  // Half-spaces beside the image, one pixel further out: n . x < 0 is outside.
  const Eigen::Vector3d inside[] = {{0.0, 0.0, 1.0},
                                    {camera.fx, 0.0, camera.cx + 1.0},
                                    {-camera.fx, 0.0, camera.width - camera.cx}};
  const auto is_outside = [&](const QuadView& view) {
    const Quad& quad = scene.quads[view.quad];
    const Eigen::Vector3d corners[] = {
        cam_from_world * quad.At(0, 0), cam_from_world * quad.At(1, 0),
        cam_from_world * quad.At(1, 1), cam_from_world * quad.At(0, 1)};
    return std::any_of(std::begin(inside), std::end(inside), [&](const Eigen::Vector3d& n) {
      return std::all_of(std::begin(corners), std::end(corners),
                         [&](const Eigen::Vector3d& x) { return n.dot(x) < 0.0; });
    });
  };
  views->erase(std::remove_if(views->begin(), views->end(), is_outside), views->end());
}

HitBuffer Rasterize(const std::vector<QuadView>& views, const RowBand& band, int width) {
  const size_t size = static_cast<size_t>(band.last - band.first + 1) * width;
  HitBuffer hits{band, width, std::vector<int>(size, -1), std::vector<double>(size, 0.0)};
  for (size_t i = 0; i < views.size(); ++i) {
    const Eigen::Vector3d& w = views[i].inverse_depth;
    const Outline inside = InsideForms(views[i]);
    for (int y = views[i].rows.first; y <= views[i].rows.last; ++y) {
      const RowSpan span = SpanOfRow(inside, width, y, 0.0);
      const double row_offset = w.y() * y + w.z();
      const size_t row = hits.Index(0, y);
      for (int x = span.first; x <= span.last; ++x) {
        const double here = w.x() * x + row_offset;
        if (here <= hits.inverse_depth[row + x]) continue;
        hits.inverse_depth[row + x] = here;
        hits.view[row + x] = static_cast<int>(i);
      }
    }
  }
  return hits;
}

BorderBuffer::BorderBuffer(const std::vector<QuadView>& views, const HitBuffer& hits)
    : first_(hits.view.size() + 1, 0) {
  for (size_t i = 0; i < views.size(); ++i) {
    const Outline inside = InsideForms(views[i]);
    for (int y = views[i].rows.first; y <= views[i].rows.last; ++y) {
      const RowSpan touched = SpanOfRow(inside, hits.width, y, 0.5);
      RowSpan covered = SpanOfRow(inside, hits.width, y, 0.0);
      if (covered.first > covered.last) covered = {touched.last + 1, touched.last};
      for (int x = touched.first; x < covered.first; ++x) {
        AddIfInFront(views, hits, static_cast<int>(i), x, y);
      }
      for (int x = covered.last + 1; x <= touched.last; ++x) {
        AddIfInFront(views, hits, static_cast<int>(i), x, y);
      }
    }
  }
  SortByPixel();
}

void BorderBuffer::AddIfInFront(const std::vector<QuadView>& views, const HitBuffer& hits, int view,
                                int x, int y) {
  const size_t pixel = hits.Index(x, y);
  const int hit = hits.view[pixel];
  if (hit >= 0) {
    // Compares the smallest depth of the view within the pixel with the largest of the hit.
    const Eigen::Vector3d& w = views[view].inverse_depth;
    const Eigen::Vector3d& hit_w = views[hit].inverse_depth;
    const double reach = 0.5 * (w.head<2>().lpNorm<1>() + hit_w.head<2>().lpNorm<1>());
    if (w.dot(Eigen::Vector3d(x, y, 1.0)) + reach < hits.inverse_depth[pixel]) return;
  }
  entries_.push_back({pixel, view});
  ++first_[pixel + 1];
}

// Stable counting sort: preserves the order of the views of a pixel.
void BorderBuffer::SortByPixel() {
  for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  std::vector<size_t> next(first_.begin(), first_.end() - 1);
  views_.resize(entries_.size());
  for (const Entry& entry : entries_) views_[next[entry.pixel]++] = entry.view;
  entries_.clear();
}

}  // namespace msc_vo
