// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/input_checks.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/sensor/depth_units.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Largest time between a depth image and its colour image, seconds: the motion of the last two
// frames cannot be extrapolated further.
constexpr double kMaxDepthDelay = 1.0;

// Largest time stamp, seconds: the year 5138. Milliseconds since 1970 exceed it from 1973 on.
constexpr double kMaxTimestamp = 1e11;

}  // namespace

OdometryOptions ValidatedOptions(const OdometryOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
  return EffectiveOptions(options);
}

const PinholeCamera& ValidatedCamera(const PinholeCamera& camera,
                                     const LensDistortion& distortion) {
  std::string error;
  if (!camera.IsValid(&error) || !IsInvertible(distortion, camera, &error)) {
    throw std::invalid_argument(error);
  }
  return camera;
}

void CheckTimestamp(int64_t id, double timestamp, const std::optional<double>& last) {
  const std::string image = "image " + std::to_string(id);
  if (!std::isfinite(timestamp)) {
    throw std::invalid_argument(image + ": its time stamp must be a finite number of seconds");
  }
  if (std::abs(timestamp) > kMaxTimestamp) {
    throw std::invalid_argument(
        image + FormatText(": its time stamp %g must be in seconds: divide milliseconds by 1e3, "
                           "microseconds by 1e6, nanoseconds by 1e9",
                           timestamp));
  }
  if (!last || timestamp > *last) return;
  throw std::invalid_argument(image +
                              ": its time stamp is not later than that of the previous image");
}

void CheckDepthDelay(int64_t id, double delay) {
  if (std::abs(delay) <= kMaxDepthDelay) return;
  throw std::invalid_argument("image " + std::to_string(id) +
                              FormatText(": depth_delay = %g must be from -%g to %g seconds", delay,
                                         kMaxDepthDelay, kMaxDepthDelay));
}

void CheckRecordedDepth(int64_t id, const cv::Mat& recorded_depth) {
  if (recorded_depth.empty() || recorded_depth.type() == CV_32FC1) return;
  throw std::invalid_argument("image " + std::to_string(id) +
                              ": recorded_depth must be float (CV_32FC1, metres) or empty");
}

void CheckDepthUnits(int64_t id, const cv::Mat& depth) {
  const std::string error = DepthUnitsError(depth);
  if (!error.empty()) throw std::invalid_argument("image " + std::to_string(id) + ": " + error);
}

}  // namespace msc_vo
