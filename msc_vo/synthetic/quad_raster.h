// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene.h"

namespace msc_vo {

// A rectangle as the image sees it. 1/z, u/z and v/z are linear in the pixel (x, y, 1): that is the
// plane's homography, and the reason why no ray needs a division to find whether it hits.
struct QuadView {
  int quad = 0;
  Eigen::Vector3d inverse_depth, u_over_z, v_over_z;
  int first_row = 0, last_row = -1;  // all that it touches lies between

  // Whether it covers the place `pixel` (x, y, 1), where its 1/z is `w`.
  bool Contains(const Eigen::Vector3d& pixel, double w) const;
};

// The rectangles of a scene that show their visible side to the camera, in the scene's order.
std::vector<QuadView> ViewQuads(const Scene& scene, const PinholeCamera& camera,
                                const Rigid3& cam_from_world);

// What the pixel centres see: index into the views (-1: nothing) and inverse depth.
struct HitBuffer {
  std::vector<int> view;
  std::vector<double> inverse_depth;
};

HitBuffer Rasterize(const std::vector<QuadView>& views, const PinholeCamera& camera);

// For every pixel the views that touch its square but not its centre, unless they are hidden behind
// what the centre sees: borders, and whatever is thinner than a pixel.
class BorderBuffer {
 public:
  BorderBuffer(const std::vector<QuadView>& views, const HitBuffer& hits,
               const PinholeCamera& camera);

  const int* begin(size_t pixel) const { return views_.data() + first_[pixel]; }
  const int* end(size_t pixel) const { return views_.data() + first_[pixel + 1]; }

 private:
  struct Entry {
    size_t pixel;
    int view;
  };

  void AddIfInFront(const std::vector<QuadView>& views, const HitBuffer& hits, int width, int view,
                    int x, int y);
  void SortByPixel();

  std::vector<size_t> first_;  // of each pixel in views_
  std::vector<int> views_;
  std::vector<Entry> entries_;
};

}  // namespace msc_vo
