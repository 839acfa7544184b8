// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/map/map.h"

namespace msc_vo {

// The readout time of the camera's rolling shutter, which hardly a file format tells: learnt from
// pairs of keyframes (see EstimateReadoutTime). A shutter is global until the contrary is certain.
class ReadoutTimeEstimator {
 public:
  // known: the readout time, seconds, to be kept; none: it shall be learnt.
  explicit ReadoutTimeEstimator(const std::optional<double>& known)
      : learns_(!known), readout_time_(known.value_or(0.0)) {}

  // Learns from `newest` and the keyframes that see most of the same, after the window was solved
  // if it was due.
  void Update(const Map& map, KeyframeId newest);

  // Seconds.
  double readout_time() const { return readout_time_; }

 private:
  // One more estimate (seconds), with its information (1/seconds^2).
  void Remember(double estimate, double information);
  void Decide();

  bool learns_;
  double readout_time_;
  double information_ = 0.0;   // 1/seconds^2
  double weighted_sum_ = 0.0;  // of estimates, each times its information
};

}  // namespace msc_vo
