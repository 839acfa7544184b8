// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/diagnosis/surface_patch.h"

namespace msc_vo {

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
    /// Number of places in the image that have the surfaces of num_curve: a single bent surface,
    /// repeated in every image of a slow camera, proves no curve.
    int num_curve_places = 0;
    double origin = 0.0;  ///< kInverted: the value at distance 0, metres
    /// The curve is proven, but depth behind an undescribed lens explains the surfaces as well.
    bool may_be_lens = false;

    /// Whether the surfaces prove the curve, or depth.
    bool ProveCurve() const;
    bool ProveDepth() const;
  };

  /// The most likely curve other than depth. An undescribed lens bends planes, too: the more, the
  /// farther they are from the optical axis. A curve bends all planes alike.
  Votes Best() const;
  Votes OfInverse() const;
  /// Whether the surfaces prove depth, compared with every curve, or the best curve.
  bool IsDecided() const;

  double depth_scale() const { return depth_scale_; }

 private:
  double depth_scale_;
  int step_;                  // pixels between the cells of rays_
  cv::Mat_<cv::Vec2d> rays_;  // undistorted points of the plane z = 1
  // For each place in the image and each size, the surfaces of all images.
  std::vector<std::vector<SurfacePatch>> patches_;
};

}  // namespace msc_vo
