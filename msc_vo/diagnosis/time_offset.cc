// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/time_offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "msc_vo/diagnosis/ground_truth_motion.h"
#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

constexpr double kStep = 0.01;     // seconds
constexpr double kInterval = 0.1;  // seconds, of the rotations that are compared
constexpr size_t kMinRotations = 20;
constexpr double kMinRotation = 0.004;  // radians, median over kInterval
constexpr double kMinScale = 1e-3;      // radians, of the rotation errors

struct Rotation {
  double begin;  // seconds
  double end;
  Eigen::Vector3d vector;  // of the later camera from the earlier one
};

std::vector<Rotation> Rotations(const MotionTrack& track) {
  std::vector<Rotation> rotations;
  const std::vector<MotionImage>& images = track.images;
  for (size_t i = 0; i < images.size(); ++i) {
    for (size_t j = i + 1; j < images.size() && images[j].segment == images[i].segment; ++j) {
      if (images[j].timestamp - images[i].timestamp < kInterval - 1e-3) continue;
      const Rigid3 motion = track.MotionOf({static_cast<int>(i), static_cast<int>(j)});
      rotations.push_back({images[i].timestamp, images[j].timestamp, LogSO3(motion.rotation())});
      break;
    }
  }
  return rotations;
}

// Errors of the rotations at an offset; infinite where the ground truth has no pose.
std::vector<double> Errors(const std::vector<Rotation>& rotations,
                           const std::vector<TimedPose>& truth,
                           const Eigen::Matrix3d& camera_from_body, double offset) {
  std::vector<double> errors;
  for (const Rotation& rotation : rotations) {
    const auto begin = InterpolatePose(truth, rotation.begin + offset);
    const auto end = InterpolatePose(truth, rotation.end + offset);
    if (!begin || !end) {
      errors.push_back(-1.0);
      continue;
    }
    const Rigid3 motion = end->Inverse() * *begin;
    const Eigen::Vector3d vector = LogSO3(Eigen::Quaterniond(motion.rotation()));
    errors.push_back((rotation.vector - camera_from_body * vector).norm());
  }
  return errors;
}

// Mean robust cost of the errors that exist.
double Cost(const std::vector<double>& errors, double scale) {
  double sum = 0.0;
  size_t count = 0;
  for (const double error : errors) {
    if (error < 0.0) continue;
    sum += std::log1p(error * error / (scale * scale));
    ++count;
  }
  return count >= kMinRotations ? sum / static_cast<double>(count) : 1e9;
}

}  // namespace

std::optional<TimeOffset> EstimateTimeOffset(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const Eigen::Matrix3d& camera_from_body,
                                             double reach) {
  const std::vector<Rotation> rotations = Rotations(track);
  if (rotations.size() < kMinRotations) return std::nullopt;
  std::vector<double> magnitudes;
  for (const Rotation& rotation : rotations) magnitudes.push_back(rotation.vector.norm());
  const double median_rotation = Median(std::move(magnitudes));
  if (median_rotation < kMinRotation) return std::nullopt;
  const int count = static_cast<int>(std::lround(2.0 * reach / kStep)) + 1;
  const double scale = std::max(kMinScale, 0.2 * median_rotation);
  std::vector<double> costs;
  for (int i = 0; i < count; ++i) {
    costs.push_back(Cost(Errors(rotations, truth, camera_from_body, i * kStep - reach), scale));
  }
  const auto best = std::min_element(costs.begin(), costs.end()) - costs.begin();
  if (costs[best] > 1e8) return std::nullopt;
  TimeOffset result;
  result.seconds = static_cast<double>(best) * kStep - reach;
  // A parabola over +-3 steps: the cost is smooth, and interpolated poses make it wavy at the
  // interval of the images.
  const std::ptrdiff_t wing = 3;
  const bool is_inside =
      best >= wing && best + wing < count && costs[best - wing] < 1e8 && costs[best + wing] < 1e8;
  double curvature = 0.0;
  if (is_inside) {
    curvature = costs[best - wing] - 2.0 * costs[best] + costs[best + wing];
    if (curvature > 0.0) {
      result.seconds += 0.5 * (costs[best - wing] - costs[best + wing]) / curvature * wing * kStep;
    }
  }
  std::vector<double> errors = Errors(rotations, truth, camera_from_body, result.seconds);
  errors.erase(std::remove(errors.begin(), errors.end(), -1.0), errors.end());
  result.disagreement = Median(std::move(errors)) / median_rotation;
  // Second derivative of the sum of the costs; consecutive rotations overlap threefold.
  const double second =
      curvature / (wing * kStep * wing * kStep) * static_cast<double>(rotations.size()) / 3.0;
  result.sigma = second > 0.0 ? 1.0 / std::sqrt(second) : reach;
  return result;
}

}  // namespace msc_vo
