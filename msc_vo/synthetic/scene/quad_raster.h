// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

/// The rows of an image from `first` to `last`, inclusive.
struct RowBand {
  int first = 0;
  int last = -1;
};

/// The projection of a rectangle. 1/z, u/z and v/z are linear forms in the pixel (x, y, 1), the
/// homography of the plane, so intersection tests need no division.
struct QuadView {
  int quad = 0;  ///< index into Scene::quads
  Eigen::Vector3d inverse_depth, u_over_z, v_over_z;
  RowBand rows;  ///< rows of the requested band that the rectangle touches

  /// True if the rectangle covers `pixel` (x, y, 1), where its 1/z is `w`.
  bool Contains(const Eigen::Vector3d& pixel, double w) const;
};

/// Projects the rectangles of a scene whose visible side faces the camera and that may touch the
/// given band of the image, in the order of the scene. Apart from their rows, views do not depend
/// on the band.
std::vector<QuadView> ViewQuads(const Scene& scene, const PinholeCamera& camera,
                                const Rigid3& cam_from_world, const RowBand& band);

/// Removes views of rectangles that are behind the camera, or to the left or right of the image.
/// They touch no pixel, but their extended planes may take time.
void RemoveInvisible(const Scene& scene, const PinholeCamera& camera, const Rigid3& cam_from_world,
                     std::vector<QuadView>* views);

/// The surfaces visible at the pixel centres of a band, row by row: index into the views (-1: none)
/// and inverse depth.
struct HitBuffer {
  RowBand rows;
  int width = 0;
  std::vector<int> view;
  std::vector<double> inverse_depth;

  /// Index of pixel (x, y) of the whole image in the buffers; y must lie in the band.
  size_t Index(int x, int y) const { return static_cast<size_t>(y - rows.first) * width + x; }
};

/// Rasterises the views with a depth buffer. `band` must be the one passed to ViewQuads().
HitBuffer Rasterize(const std::vector<QuadView>& views, const RowBand& band, int width);

/// For every pixel of a band, the views that touch the pixel's square but not its centre and are
/// not occluded by the surface at the centre: borders, and objects thinner than a pixel.
class BorderBuffer {
 public:
  BorderBuffer(const std::vector<QuadView>& views, const HitBuffer& hits);

  /// The views of a pixel, given its index in the HitBuffer.
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

  std::vector<size_t> first_;  // index into views_ for each pixel
  std::vector<int> views_;
  std::vector<Entry> entries_;
};

}  // namespace msc_vo
