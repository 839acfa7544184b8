// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

// The rows of an image from `first` to `last`, both of them included.
struct RowBand {
  int first = 0;
  int last = -1;
};

// A rectangle as the image sees it. 1/z, u/z and v/z are linear in the pixel (x, y, 1): that is the
// plane's homography, and the reason why no ray needs a division to find whether it hits.
struct QuadView {
  int quad = 0;
  Eigen::Vector3d inverse_depth, u_over_z, v_over_z;
  RowBand rows;  // of the band asked for, all that it touches

  // Whether it covers the place `pixel` (x, y, 1), where its 1/z is `w`.
  bool Contains(const Eigen::Vector3d& pixel, double w) const;
};

// The rectangles of a scene that show their visible side to the camera and may touch a band of its
// image, in the scene's order. Views do not depend on the band, apart from their rows.
std::vector<QuadView> ViewQuads(const Scene& scene, const PinholeCamera& camera,
                                const Rigid3& cam_from_world, const RowBand& band);

// What the pixel centres of a band see, row by row: index into the views (-1: nothing) and inverse
// depth.
struct HitBuffer {
  RowBand rows;
  int width = 0;
  std::vector<int> view;
  std::vector<double> inverse_depth;

  // Where pixel (x, y) of the whole image is in the buffers; y must be in the band.
  size_t Index(int x, int y) const { return static_cast<size_t>(y - rows.first) * width + x; }
};

// The band must be the one that the views were made for.
HitBuffer Rasterize(const std::vector<QuadView>& views, const RowBand& band, int width);

// For every pixel of a band the views that touch its square but not its centre, unless they are
// hidden behind what the centre sees: borders, and whatever is thinner than a pixel.
class BorderBuffer {
 public:
  BorderBuffer(const std::vector<QuadView>& views, const HitBuffer& hits);

  // Of a pixel, by its index in the hits.
  const int* begin(size_t pixel) const { return views_.data() + first_[pixel]; }
  const int* end(size_t pixel) const { return views_.data() + first_[pixel + 1]; }

 private:
  struct Entry {
    size_t pixel;
    int view;
  };

  void AddIfInFront(const std::vector<QuadView>& views, const HitBuffer& hits, int view, int x,
                    int y);
  void SortByPixel();

  std::vector<size_t> first_;  // of each pixel in views_
  std::vector<int> views_;
  std::vector<Entry> entries_;
};

}  // namespace msc_vo
