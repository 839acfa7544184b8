// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

/// The true surfaces of a scene in an image, row by row.
struct SurfaceView {
  PinholeCamera camera;
  Rigid3 cam_from_world;
  std::vector<int> quad;      ///< index into Scene::quads; -1: none
  std::vector<double> depth;  ///< metres along z; 0: none

  /// Centre of pixel (x, y) on its surface, metres, world.
  Eigen::Vector3d PointAt(int x, int y) const;
};

/// Computes what a camera sees.
SurfaceView ViewSurfaces(const Scene& scene, const PinholeCamera& camera,
                         const Rigid3& cam_from_world);

/// The camera with the same field of view and about `width` pixels per row.
PinholeCamera ScaledCamera(const PinholeCamera& camera, int width);

/// Ratio of the pixels of `a` whose surface points are visible in `b`, to one pixel of `b`: inside
/// its image, and on the same rectangle of the scene. The sides of a wall are two rectangles.
double OverlapOf(const SurfaceView& a, const SurfaceView& b);

/// Angle between the optical axes of two images, radians.
double ViewingAngle(const SurfaceView& a, const SurfaceView& b);

struct ReturnOptions {
  /// Least overlap with the earlier image, in both directions.
  double min_overlap = 0.3;
  double max_angle = DegreesToRadians(45.0);  ///< between the optical axes, radians
  /// The camera has left a place if an image in between shows at most this ratio of the later
  /// image's surfaces.
  double max_between = 0.05;
};

/// A time in which the camera is back at a place that it had left. Indices of views.
struct TrueReturn {
  int first = 0, last = 0;  ///< the consecutive views that show an earlier place
  int later = 0;            ///< of these, the one with the largest overlap
  int earlier = 0;          ///< view of the same place before
  double overlap = 0.0;     ///< of both, the smaller direction
};

/// Finds the returns among views in order of time.
std::vector<TrueReturn> FindReturns(const std::vector<SurfaceView>& views,
                                    const ReturnOptions& options = {});

}  // namespace msc_vo
