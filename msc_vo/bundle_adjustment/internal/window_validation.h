// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_state.h"
#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

/// The ids of WindowData's measurements, resolved to positions in its vectors.
struct WindowIndex {
  struct Observation {
    int keyframe = 0;
    int landmark = 0;
  };
  std::vector<Observation> points;  ///< One per point observation.
  std::vector<Observation> lines;   ///< One per line observation.
  using Pair = std::array<int, 2>;
  std::vector<Pair> parallel;                  ///< Lines of each parallel pair.
  std::vector<Pair> perpendicular;             ///< Lines of each perpendicular pair.
  std::vector<std::array<int, 1>> alignments;  ///< Line of each axis alignment.
  std::vector<int> priors;                     ///< Keyframe of each pose prior.
  /// Parameter blocks of each custom factor.
  std::vector<std::vector<StateBlock>> custom_factors;
};

/// Validates the input of LocalBundleAdjustment and resolves its ids. Throws std::invalid_argument
/// that names the offending item.
WindowIndex ValidateWindow(const BundleAdjustmentOptions& options, const WindowData& data);

/// Tests whether ValidateWindow() would accept the keyframes and landmarks. Otherwise `error` names
/// the first one that is not valid.
bool HasValidState(const WindowData& data, std::string* error);

}  // namespace msc_vo
