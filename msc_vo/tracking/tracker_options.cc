// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

bool SegmentOptions::IsValid(std::string* error) const {
  if (!(min_search >= 0.0 && max_search >= 0.0)) {
    *error = "segments: min_search and max_search must not be negative";
  } else if (!(search_interval >= 0.0)) {
    *error = "segments: search_interval must not be negative";
  } else {
    return true;
  }
  return false;
}

bool TrackerOptions::IsValid(std::string* error) const {
  if (!matchers.IsValid(error) || !pose.IsValid(error) || !keyframes.IsValid(error) ||
      !relocalizer.IsValid(error) || !segments.IsValid(error)) {
    return false;
  }
  if (!(prediction_radius > 0.0 && wide_radius > 0.0 && local_map_radius > 0.0)) {
    *error = "tracker: search radii must be positive";
  } else if (max_local_keyframes < 1 || relocalization_keyframes < 1) {
    *error = "tracker: max_local_keyframes and relocalization_keyframes must be at least 1";
  } else if (min_matches < 3 || min_initial_features < min_matches) {
    *error = "tracker: 3 <= min_matches <= min_initial_features must hold";
  } else if (!(min_inlier_ratio >= 0.0 && min_inlier_ratio <= 1.0)) {
    *error = "tracker: min_inlier_ratio must be in [0, 1]";
  } else if (!(weak_translation_sigma > 0.0 && weak_rotation_sigma > 0.0)) {
    *error = "tracker: weak_translation_sigma and weak_rotation_sigma must be positive";
  } else if (!(max_prediction >= 0.0)) {
    *error = "tracker: max_prediction must not be negative";
  } else {
    return true;
  }
  return false;
}

}  // namespace msc_vo
