// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/input_checks.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "msc_vo/camera/lens_validity.h"

namespace msc_vo {

namespace {

// Largest time between a depth image and its colour image, seconds: the motion of the last two
// frames cannot be extrapolated further.
constexpr double kMaxDepthDelay = 1.0;

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
  if (!last || timestamp > *last) return;
  throw std::invalid_argument(image +
                              ": its time stamp is not later than that of the previous image");
}

void CheckDepthDelay(int64_t id, double delay) {
  if (std::abs(delay) <= kMaxDepthDelay) return;
  throw std::invalid_argument("image " + std::to_string(id) +
                              ": depth_delay = " + std::to_string(delay) + " must be from -" +
                              std::to_string(kMaxDepthDelay) + " to " +
                              std::to_string(kMaxDepthDelay) + " seconds");
}

}  // namespace msc_vo
