// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/segment_start.h"

#include <algorithm>

namespace msc_vo {

namespace {

// Longest time that one frame counts as a search, seconds: a gap in the recording is none.
constexpr double kMaxInterval = 0.2;

}  // namespace

void SegmentStartPolicy::Started(double timestamp) {
  Tracked(timestamp);
  is_confirmed_ = false;
}

void SegmentStartPolicy::Tracked(double timestamp) {
  is_confirmed_ = true;
  last_timestamp_ = timestamp;
  search_seconds_ = 0.0;
  num_tried_keyframes_ = 0;
}

void SegmentStartPolicy::NotFound(double timestamp, bool is_searched, int num_keyframes) {
  if (is_searched) {
    search_seconds_ += std::min(timestamp - last_timestamp_, kMaxInterval);
    num_tried_keyframes_ += num_keyframes;
  }
  last_timestamp_ = timestamp;
}

bool SegmentStartPolicy::IsDue(int num_keyframes) const {
  if (!options_.enabled) return false;
  if (!is_confirmed_) return true;
  return search_seconds_ >= options_.min_search &&
         (num_tried_keyframes_ >= num_keyframes || search_seconds_ >= options_.max_search);
}

}  // namespace msc_vo
