// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Self-calibration of the readout time of the camera's rolling shutter, which datasets rarely
/// provide. It accumulates the estimates of keyframe pairs (EstimateReadoutTime). The shutter
/// counts as global (readout time 0) until a rolling shutter is sufficiently more likely.
class ReadoutTimeEstimator {
 public:
  /// `known` is the readout time in seconds, which is then kept; std::nullopt: it is estimated.
  explicit ReadoutTimeEstimator(const std::optional<double>& known)
      : estimates_(!known), readout_time_(known.value_or(0.0)) {}

  /// Updates the estimate with the pairs of keyframe `newest` and its most covisible keyframes.
  /// `frame_interval` is the time between this keyframe and the image before it, seconds, if there
  /// is one. Call it after local bundle adjustment.
  void Update(const Map& map, KeyframeId newest, const std::optional<double>& frame_interval);
  /// The same without a map: `partners` show much of what `newest` shows.
  void Update(const Keyframe& newest, const std::vector<const Keyframe*>& partners,
              const std::optional<double>& frame_interval);

  /// Seconds; negative if the rows are read from the bottom to the top.
  double readout_time() const { return readout_time_; }
  /// Uncertainty of readout_time(), seconds; 0 if it was given. For a shutter that counts as
  /// global, it contains the estimate from the images.
  double sigma() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [estimates, seconds, frame_interval, information, weighted_sum] =
        *this;  // all members, or it does not compile
    archive(seconds, frame_interval, information, weighted_sum);
  }

 private:
  // Upper bound of the readout time, seconds.
  double Bound() const;
  // Adds an estimate (seconds) with its information (1/seconds^2).
  void AddEstimate(double estimate, double information);
  // Decides between global and rolling shutter, and updates the readout time.
  void UpdateDecision();

  bool estimates_;
  double readout_time_;
  double frame_interval_ = 1.0 / 30.0;  // seconds, exponential average
  double information_ = 0.0;            // 1/seconds^2
  double weighted_sum_ = 0.0;           // sum of the estimates, weighted by their information
};

}  // namespace msc_vo
