// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/calibrated_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/self_calibration/noise_estimator.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

const char* KeptVerdict(bool is_observable) {
  return is_observable ? "kept" : "kept: not observable";
}

std::vector<CalibratedValue> ListCalibratedValues(const RunSummary& summary) {
  using G = CorrectionGroup;
  using S = SensorCorrection;
  const CorrectionEstimate& estimate = summary.calibration;
  const CameraIntrinsics& intrinsics = summary.intrinsics;
  const PinholeCamera& camera = intrinsics.distortion.Recorded(intrinsics.camera);
  const auto make = [&](const char* name, const char* unit, double value, double scale, int index,
                        G group) {
    const auto g = static_cast<size_t>(group);
    const double sigma = estimate.sigma(index);
    const bool is_estimated = sigma > 0.0;
    const bool is_observable = is_estimated && IsObservable(index, sigma);
    return CalibratedValue{
        name,
        unit,
        value,
        is_estimated ? std::abs(scale) * sigma : std::numeric_limits<double>::infinity(),
        estimate.log_odds[g],
        estimate.is_corrected[g],
        estimate.is_corrected[g] ? "corrected" : KeptVerdict(is_observable)};
  };
  const auto& k = intrinsics.distortion.k;
  const PinholeCamera& depth = summary.depth_camera.camera;
  const Eigen::Vector3d& translation = summary.depth_camera.depth_from_color.translation();
  // The depth images of an odometry have the pixels of the colour images, so that shifts of both
  // principal points are in focal lengths of these.
  const double f = camera.FocalLength();
  return {make("fx", "px", camera.fx, camera.fx, S::kFocalLength, G::kFocalLength),
          make("fy", "px", camera.fy, camera.fy, S::kFocalLength, G::kFocalLength),
          make("cx", "px", camera.cx, f, S::kCenterX, G::kPrincipalPoint),
          make("cy", "px", camera.cy, f, S::kCenterY, G::kPrincipalPoint),
          make("k1", "", k[0], 1.0, S::kK1, G::kLens),
          make("k2", "", k[1], 1.0, S::kK2, G::kLens),
          make("depth_fx", "px", depth.fx, depth.fx, S::kDepthFocalLength, G::kDepthRegistration),
          make("depth_cx", "px", depth.cx, f, S::kDepthX, G::kDepthRegistration),
          make("depth_cy", "px", depth.cy, f, S::kDepthY, G::kDepthRegistration),
          make("depth_roll", "degrees", RadiansToDegrees(summary.depth_camera.Roll()),
               RadiansToDegrees(1.0), S::kDepthRoll, G::kDepthRegistration),
          make("depth_x", "mm", 1000.0 * translation.x(), 1000.0 * f / depth.fx, S::kDepthParallaxX,
               G::kDepthRegistration),
          make("depth_y", "mm", 1000.0 * translation.y(), 1000.0 * f / depth.fy, S::kDepthParallaxY,
               G::kDepthRegistration)};
}

std::string DescribeDepthContradiction(const RunSummary& summary) {
  // Between 6, the largest of registered depth, and 20, the smallest of other depth.
  constexpr double kMinLogOdds = 10.0;
  constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);
  const NoiseScale& noise = summary.noise_scale;
  const double log_odds = summary.calibration.log_odds[kRegistration];
  if (std::max(noise.point_depth, noise.line_depth) < NoiseEstimator::kMaxScale ||
      summary.calibration.is_corrected[kRegistration] || log_odds < kMinLogOdds) {
    return "";
  }
  return FormatText(
      "depth contradicts the images: its errors reach the largest factor that is used, %g, and it "
      "is not registered to colour (odds e^%.0f), but no correction is certain; lengths may be "
      "wrong by several percent; check registration, mirroring and time stamps of depth (msc_vo "
      "check --deep), or use registered depth",
      NoiseEstimator::kMaxScale, log_odds);
}

}  // namespace msc_vo
