// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// Number of frames in which a landmark was predicted to be visible, and in which it was matched.
struct TrackingCount {
  LandmarkId id = kNoId;
  int num_visible = 0;
  int num_found = 0;
};

/// The counts of landmarks over several frames, by ascending id.
class TrackingCounts {
 public:
  /// Counts the landmarks of a frame; `ids` ascend.
  void AddVisible(const std::vector<LandmarkId>& ids) {
    std::vector<TrackingCount> merged;
    merged.reserve(counts_.size() + ids.size());
    auto count = counts_.begin();
    for (const LandmarkId id : ids) {
      while (count != counts_.end() && count->id < id) merged.push_back(*count++);
      if (count != counts_.end() && count->id == id) {
        merged.push_back(*count++);
      } else {
        merged.push_back({id, 0, 0});
      }
      ++merged.back().num_visible;
    }
    merged.insert(merged.end(), count, counts_.end());
    counts_ = std::move(merged);
  }

  /// Counts a match of a frame.
  void AddFound(LandmarkId id) {
    auto count = LowerBound(id);
    if (count == counts_.end() || count->id != id) count = counts_.insert(count, {id, 0, 0});
    ++count->num_found;
  }

  std::vector<TrackingCount>::const_iterator begin() const { return counts_.begin(); }
  std::vector<TrackingCount>::const_iterator end() const { return counts_.end(); }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(counts_);
  }

 private:
  std::vector<TrackingCount>::iterator LowerBound(LandmarkId id) {
    return std::lower_bound(
        counts_.begin(), counts_.end(), id,
        [](const TrackingCount& count, LandmarkId value) { return count.id < value; });
  }

  std::vector<TrackingCount> counts_;
};

}  // namespace msc_vo
