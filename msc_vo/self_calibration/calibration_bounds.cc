// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_bounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using S = SensorCorrection;

const double kMaxLogFocalLength = std::log(1.5);
constexpr double kMinFieldOfView = DegreesToRadians(35.0);
constexpr double kMaxFieldOfView = DegreesToRadians(110.0);
constexpr double kMaxDecentering = 0.15;  // of the image size
constexpr double kMaxCornerRatio = 1.15;  // of the distances with and without distortion
const double kMaxLogMagnification = std::log(1.65);
constexpr double kMaxShift = 0.1;  // focal lengths
constexpr double kMaxRoll = DegreesToRadians(5.0);
constexpr double kMaxParallax = 0.15;     // metres
constexpr double kMaxDepthOffset = 0.05;  // 1/metres
constexpr double kMaxDepthBowl = 0.25;

const PinholeCamera& Recorded(const CameraIntrinsics& intrinsics) {
  return intrinsics.distortion.Recorded(intrinsics.camera);
}

// Horizontal, radians, of a pinhole camera.
double FieldOfView(const CameraIntrinsics& intrinsics) {
  const PinholeCamera& camera = Recorded(intrinsics);
  return 2.0 * std::atan(0.5 * camera.width / std::abs(camera.fx));
}

// Distance of the principal point from the middle of the image, as a ratio of its size.
double Decentering(const CameraIntrinsics& intrinsics) {
  const PinholeCamera& camera = Recorded(intrinsics);
  return std::max(std::abs(camera.cx / camera.width - 0.5),
                  std::abs(camera.cy / camera.height - 0.5));
}

// Distance from the axis with and without distortion: the ratio at the corner of the recorded image
// where it is largest.
double CornerRatio(const CameraIntrinsics& intrinsics) {
  constexpr double kTolerance = 1e-9;
  const PinholeCamera& camera = Recorded(intrinsics);
  double largest = 0.0;
  for (const double x : {0.0, camera.width - 1.0}) {
    for (const double y : {0.0, camera.height - 1.0}) {
      const Eigen::Vector2d distorted = camera.Ray({x, y}).head<2>();
      const Eigen::Vector2d ideal =
          intrinsics.distortion.UndistortNormalized(distorted, kTolerance);
      largest = std::max(largest, distorted.norm() / ideal.norm());
    }
  }
  return largest;
}

// Empty if the colour camera is plausible.
std::string DescribeColor(const CameraIntrinsics& given, const S::Vector& correction) {
  const CameraIntrinsics corrected = Corrected(given, correction);
  const PinholeCamera& camera = Recorded(corrected);
  if (!(std::abs(correction(S::kFocalLength)) <= kMaxLogFocalLength)) {
    return FormatText("the focal length would be %.2f times the given one",
                      std::exp(correction(S::kFocalLength)));
  }
  const double view = FieldOfView(corrected), given_view = FieldOfView(given);
  if (!(view >= std::min(kMinFieldOfView, given_view) &&
        view <= std::max(kMaxFieldOfView, given_view))) {
    return FormatText("the field of view would be %.0f degrees", RadiansToDegrees(view));
  }
  if (!(Decentering(corrected) <= std::max(kMaxDecentering, Decentering(given)))) {
    return FormatText("the principal point would be (%.0f, %.0f), far from the middle of the image",
                      camera.cx, camera.cy);
  }
  std::string error;
  if (!IsInvertible(corrected.distortion, corrected.camera, &error)) return error;
  const double ratio = CornerRatio(corrected);
  if (!(ratio <= std::max(kMaxCornerRatio, CornerRatio(given)))) {
    return FormatText(
        "the lens, k1 = %.3g and k2 = %.3g, would move a corner of the image outwards by %.0f %%",
        corrected.distortion.k[0], corrected.distortion.k[1], 100.0 * (ratio - 1.0));
  }
  return "";
}

double LargerOf(const S::Vector& correction, int index) {
  return correction.segment<2>(index).cwiseAbs().maxCoeff();
}

// The same of the depth images.
std::string DescribeDepth(const S::Vector& correction) {
  if (!(std::abs(correction(S::kDepthFocalLength)) <= kMaxLogMagnification)) {
    return FormatText("depth images would be magnified %.2f times",
                      std::exp(correction(S::kDepthFocalLength)));
  }
  if (!(LargerOf(correction, S::kDepthX) <= kMaxShift)) {
    return FormatText("depth images would be shifted by %.2f focal lengths",
                      LargerOf(correction, S::kDepthX));
  }
  if (!(std::abs(correction(S::kDepthRoll)) <= kMaxRoll)) {
    return FormatText("depth images would be turned by %.1f degrees",
                      RadiansToDegrees(correction(S::kDepthRoll)));
  }
  if (!(LargerOf(correction, S::kDepthParallaxX) <= kMaxParallax)) {
    return FormatText("the depth camera would be %.0f cm beside the colour camera",
                      100.0 * LargerOf(correction, S::kDepthParallaxX));
  }
  if (!(std::abs(correction(S::kDepthOffset)) <= kMaxDepthOffset)) {
    return FormatText("inverse depths would be off by %.3f 1/m", correction(S::kDepthOffset));
  }
  if (!(std::abs(correction(S::kDepthBowl)) <= kMaxDepthBowl)) {
    return FormatText("inverse depths would be off by %.0f %% at 45 degrees from the axis",
                      100.0 * correction(S::kDepthBowl));
  }
  return "";
}

}  // namespace

std::string DescribeImplausible(const CameraIntrinsics& given, const S::Vector& correction) {
  if (!correction.allFinite()) return "the estimate has no finite value";
  const std::string color = DescribeColor(given, correction);
  return color.empty() ? DescribeDepth(correction) : color;
}

}  // namespace msc_vo
