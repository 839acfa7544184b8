// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/inertial/vertical_measurement.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace msc_vo {

namespace {

// The following three are plain choices, each between poses without a measurement and measurements
// with larger errors.

// Longest time between two poses of a triple, in units of min_interval. The nearest pose at
// min_interval is as far away only if the trajectory has no pose for two intervals, over which the
// rotation of the readings would be interpolated.
constexpr double kMaxIntervals = 3.0;
// Least part of the integral of the weight that readings must cover. Their mean stands for the
// missing part too: if the acceleration of the camera differs there by 0.2 m/s^2, as that of a
// hand, the measured vertical is off by 0.1 * 0.2 m/s^2, which is 0.12 degrees.
constexpr double kMinCoverage = 0.9;
// Longest time between two readings that counts as covered, in units of the span of the triple.
// Ten readings per span resolve the weight; with kMinCoverage, a sensor needs nine.
constexpr double kMaxStep = 0.1;

// Three poses of a trajectory and the weight of the readings between them.
struct Triple {
  const TimedPose* before;
  const TimedPose* middle;
  const TimedPose* after;

  double Weight(double time) const {
    const double outer = time < middle->timestamp ? before->timestamp : after->timestamp;
    return std::max(0.0, 1.0 - (time - middle->timestamp) / (outer - middle->timestamp));
  }
  // Integral of the weight over time, seconds.
  double Span() const { return 0.5 * (after->timestamp - before->timestamp); }
  // Mean acceleration of the camera with this weight, metres/second^2, world.
  Eigen::Vector3d Acceleration() const {
    return (Velocity(*middle, *after) - Velocity(*before, *middle)) / Span();
  }

 private:
  static Eigen::Vector3d Velocity(const TimedPose& a, const TimedPose& b) {
    return (b.world_from_cam.translation() - a.world_from_cam.translation()) /
           (b.timestamp - a.timestamp);
  }
};

// The triple around pose i; none if there is no pose at the required distance on both sides.
std::optional<Triple> TripleAround(const std::vector<TimedPose>& poses, size_t i,
                                   double min_interval) {
  const double time = poses[i].timestamp;
  size_t before = i, after = i;
  while (before > 0 && time - poses[before].timestamp < min_interval) --before;
  while (after + 1 < poses.size() && poses[after].timestamp - time < min_interval) ++after;
  const auto fits = [&](double interval) {
    return interval >= min_interval && interval <= kMaxIntervals * min_interval;
  };
  if (!fits(time - poses[before].timestamp) || !fits(poses[after].timestamp - time)) {
    return std::nullopt;
  }
  return Triple{&poses[before], &poses[i], &poses[after]};
}

// Rotation from the camera to the world at a time between the outer poses of the triple.
Eigen::Quaterniond RotationAt(const Triple& triple, double time) {
  const TimedPose* after =
      std::upper_bound(triple.before + 1, triple.after, time,
                       [](double value, const TimedPose& pose) { return value < pose.timestamp; });
  const TimedPose& a = *(after - 1);
  const double ratio = (time - a.timestamp) / (after->timestamp - a.timestamp);
  return Eigen::Quaterniond(a.world_from_cam.rotation())
      .slerp(ratio, Eigen::Quaterniond(after->world_from_cam.rotation()));
}

// Weighted mean of the readings, rotated to the world; none if readings are missing.
std::optional<Eigen::Vector3d> MeanReading(const std::vector<TimedAcceleration>& readings,
                                           const Triple& triple) {
  const auto earlier = [](const TimedAcceleration& reading, double time) {
    return reading.timestamp < time;
  };
  const auto begin =
      std::lower_bound(readings.begin(), readings.end(), triple.before->timestamp, earlier);
  const auto end = std::lower_bound(begin, readings.end(), triple.after->timestamp, earlier);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double sum_of_weights = 0.0;
  // Trapezoidal rule, for readings at irregular times. Over a gap in the readings nothing is added.
  const double max_step = kMaxStep * triple.Span();
  for (auto reading = begin; reading < end; ++reading) {
    const double last = reading == begin ? triple.before->timestamp : (reading - 1)->timestamp;
    const double next = reading + 1 == end ? triple.after->timestamp : (reading + 1)->timestamp;
    const double step = 0.5 * (std::min(next - reading->timestamp, max_step) +
                               std::min(reading->timestamp - last, max_step));
    const double weight = step * triple.Weight(reading->timestamp);
    sum += weight * (RotationAt(triple, reading->timestamp) * reading->acceleration);
    sum_of_weights += weight;
  }
  if (sum_of_weights < kMinCoverage * triple.Span()) return std::nullopt;
  return sum / sum_of_weights;
}

}  // namespace

std::vector<VerticalMeasurement> MeasureVertical(const std::vector<TimedAcceleration>& readings,
                                                 const std::vector<TimedPose>& poses,
                                                 double min_interval) {
  std::vector<VerticalMeasurement> measurements;
  for (size_t i = 0; i < poses.size(); ++i) {
    const std::optional<Triple> triple = TripleAround(poses, i, min_interval);
    if (!triple) continue;
    const std::optional<Eigen::Vector3d> reading = MeanReading(readings, *triple);
    if (!reading) continue;
    const Eigen::Vector3d up = *reading - triple->Acceleration();
    const double own = 0.5 * (poses[i + 1].timestamp - poses[i - 1].timestamp);
    measurements.push_back({i, poses[i].world_from_cam.rotation().conjugate() * up,
                            std::min(1.0, own / triple->Span())});
  }
  return measurements;
}

}  // namespace msc_vo
