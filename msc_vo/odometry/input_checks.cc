// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/input_checks.h"

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/text/format_text.h"

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
                              FormatText(": depth_delay = %g must be from -%g to %g seconds", delay,
                                         kMaxDepthDelay, kMaxDepthDelay));
}

void CheckRecordedDepth(int64_t id, const cv::Mat& recorded_depth) {
  if (recorded_depth.empty() || recorded_depth.type() == CV_32FC1) return;
  throw std::invalid_argument("image " + std::to_string(id) +
                              ": recorded_depth must be float (CV_32FC1, metres) or empty");
}

void CheckDepthUnits(int64_t id, const cv::Mat& depth) {
  constexpr int kStride = 8;           // pixels, along rows and columns
  constexpr float kFarthest = 100.0f;  // metres, beyond all surfaces of an indoor scene
  constexpr size_t kEnough = 10;       // one value may stand for pixels without a measurement
  std::set<float> values;
  for (int y = 0; y < depth.rows; y += kStride) {
    const float* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; x += kStride) {
      const float z = row[x];
      if (!(z > 0.0f) || !std::isfinite(z)) continue;
      if (z != std::floor(z)) return;  // metres are no whole numbers
      values.insert(z);
    }
  }
  if (values.size() < kEnough || *values.rbegin() <= kFarthest) return;
  throw std::invalid_argument(
      "image " + std::to_string(id) +
      FormatText(": depth is in metres, but all of it is whole numbers up to %g: divide it by the "
                 "units per metre (1000 for millimetres)",
                 static_cast<double>(*values.rbegin())));
}

}  // namespace msc_vo
