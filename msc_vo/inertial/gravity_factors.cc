// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/inertial/gravity_factors.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <ceres/loss_function.h>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/factors/direction_prior.h"
#include "msc_vo/factors/gravity_direction.h"
#include "msc_vo/factors/unit_vector_manifold.h"
#include "msc_vo/inertial/vertical_measurement.h"

namespace msc_vo {

namespace {

// Least time between the keyframes from which the acceleration of the camera is computed, seconds.
// The error of the acceleration decreases with its square.
constexpr double kMinInterval = 1.0;
// Measurements without scatter that are added to those of a window. A plain choice: they limit what
// the scatter of two or three measurements, a matter of chance, adds to sigma; in return the
// scatter counts for 0.45 of its value with 2 measurements, and for 0.83 with 10.
constexpr double kPriorMeasurements = 3.0;

std::vector<TimedPose> PosesOf(const WindowContext& window) {
  std::vector<TimedPose> poses;
  for (const WindowContext::Keyframe& keyframe : window.keyframes) {
    poses.push_back({keyframe.timestamp, keyframe.cam_from_world.Inverse()});
  }
  return poses;
}

// Standard deviation of one component of the measured directions, radians: the root mean square of
// the relative deviations of the lengths from their mean, and `min_sigma`.
double SigmaOf(const std::vector<VerticalMeasurement>& measurements, double min_sigma) {
  double mean = 0.0, squares = 0.0;
  for (const VerticalMeasurement& m : measurements) mean += m.up_in_cam.norm();
  mean /= static_cast<double>(measurements.size());
  for (const VerticalMeasurement& m : measurements) {
    squares += std::pow(m.up_in_cam.norm() / mean - 1.0, 2);
  }
  const double count = static_cast<double>(measurements.size()) + kPriorMeasurements;
  return std::hypot(min_sigma, std::sqrt(squares / count));
}

}  // namespace

GravityFactors::GravityFactors(std::vector<TimedAcceleration> readings,
                               const GravityOptions& options)
    : readings_(std::move(readings)), options_(options) {
  if (!(options.min_sigma > 0.0)) {
    throw std::invalid_argument("gravity: min_sigma must be positive");
  }
}

WindowFactors GravityFactors::operator()(const WindowContext& window) {
  const std::vector<VerticalMeasurement> measurements =
      MeasureVertical(readings_, PosesOf(window), kMinInterval);
  MeasuredVertical& mean = verticals_[window.world];
  if (measurements.empty() && mean.information == 0.0) return {};
  const double sigma =
      measurements.empty() ? options_.min_sigma : SigmaOf(measurements, options_.min_sigma);
  const BlockId vertical = BlockId::Extra(options_.block + window.world);
  const auto loss = std::make_shared<ceres::HuberLoss>(kHuberThreshold[2]);
  WindowFactors result;
  for (const VerticalMeasurement& m : measurements) {
    const WindowContext::Keyframe& keyframe = window.keyframes[m.pose];
    const double sigma_m = sigma / std::sqrt(m.independence);
    const auto position =
        std::lower_bound(mean.keyframes.begin(), mean.keyframes.end(), keyframe.id);
    if (position == mean.keyframes.end() || *position != keyframe.id) {
      mean.keyframes.insert(position, keyframe.id);
      const double information = 1.0 / (sigma_m * sigma_m);
      mean.sum +=
          information * (keyframe.cam_from_world.rotation().conjugate() * m.up_in_cam.normalized());
      mean.information += information;
    }
    if (keyframe.fixed) continue;
    result.factors.push_back({"gravity direction",
                              GravityDirection::CreateShared(m.up_in_cam, sigma_m),
                              loss,
                              {BlockId::Pose(keyframe.id), vertical}});
  }
  result.factors.push_back(
      {"prior of the vertical",
       DirectionPrior::CreateShared(mean.sum, 1.0 / std::sqrt(mean.information)),
       nullptr,
       {vertical}});
  result.extra_blocks.push_back(
      {vertical.id, mean.sum.normalized(), std::make_shared<UnitVectorManifold>()});
  return result;
}

bool GravityFactors::HasMeasured() const {
  return std::any_of(verticals_.begin(), verticals_.end(),
                     [](const auto& vertical) { return vertical.second.information > 0.0; });
}

}  // namespace msc_vo
