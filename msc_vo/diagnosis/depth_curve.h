// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

/// A smooth, inclined part of a surface in a depth image whose values v may be any function of the
/// depth. On a plane, inverse depth g(v) is affine on the image plane z = 1, so that
/// g'' (dv)^2 + g' d2v = 0 along every direction: the bend of the values tells g.
struct SurfacePatch {
  double value = 0.0;  ///< v in its middle, metres if it is a depth
  /// - d2v / (dv)^2 along the gradient, 1/metres: g''/g' on a plane, thus -2/v if v is depth.
  double bend = 0.0;
  double bend_sigma = 0.0;
  /// Laplacian of 1/v over 1/v: 0 on a plane if v is depth.
  double bowl = 0.0;
  double bowl_sigma = 0.0;
  double bowl_of_ray = 0.0;  ///< the same on a plane if v is the length of the viewing ray
  bool is_outward = false;   ///< v grows outwards from the principal point
};

/// What the values of depth images are.
enum class DepthCurve {
  kDepth,       ///< depth along the optical axis
  kInverse,     ///< an affine function of inverse depth: disparity, the depth buffer of a renderer
  kInverted,    ///< a constant minus depth
  kCompressed,  ///< grows more slowly, as the square root or the logarithm
  kStretched,   ///< grows faster, as the square
  kRayLength,   ///< distance from the camera
};

/// Finds out by the planes of a scene whether the values of depth images are depths. Surfaces that
/// are not plane bend in all ways and support no curve in particular.
class DepthCurveTest {
 public:
  static constexpr char kCheck[] = "depth.curve";  ///< Finding::check

  /// `depth_scale`: raw units per metre.
  DepthCurveTest(const PinholeCamera& camera, const LensDistortion& distortion, double depth_scale);

  /// Adds the surfaces of an image (CV_32FC1, metres; 0: none) of the recorded size.
  void Add(const cv::Mat& recorded);

  /// Numbers of surfaces that are planes, if the values are what a curve says, and if they are
  /// depths; others do not count.
  struct Votes {
    DepthCurve curve = DepthCurve::kDepth;
    int num_curve = 0;
    int num_depth = 0;
    double origin = 0.0;  ///< kInverted: the value at distance 0, metres
    /// Those of them whose values grow outwards.
    int num_outward_curve = 0;
    int num_outward_depth = 0;

    /// Whether the surfaces prove the curve, or depth.
    bool ProveCurve() const;
    bool ProveDepth() const;
    /// Whether an undescribed lens can look like the curve: it bends surfaces whose values grow
    /// outwards and inwards in opposite ways, a curve bends both alike.
    bool MayBeLens() const;
  };

  /// The most likely curve other than depth.
  Votes Best() const;
  Votes OfInverse() const;
  /// Whether the surfaces prove depth, compared with every curve, or the best curve.
  bool IsDecided() const;

  double depth_scale() const { return depth_scale_; }

 private:
  std::vector<Votes> AllVotes() const;
  void AddPatch(const cv::Mat& depth, const cv::Rect& cells);

  double depth_scale_;
  int step_;                  // pixels between the cells of rays_
  double cell_size_;          // on the plane z = 1
  cv::Mat_<cv::Vec2d> rays_;  // undistorted points of the plane z = 1
  std::vector<SurfacePatch> patches_;
};

}  // namespace msc_vo
