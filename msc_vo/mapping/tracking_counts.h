// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <iterator>
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
  /// Counts the landmarks of a frame. `visible`: ascending ids; `found`: those of its matches, in
  /// any order, several for a landmark with several features. What was found was visible.
  void AddFrame(const std::vector<LandmarkId>& visible, std::vector<LandmarkId> found) {
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<LandmarkId> all;
    std::set_union(visible.begin(), visible.end(), found.begin(), found.end(),
                   std::back_inserter(all));
    Add(all, &TrackingCount::num_visible);
    Add(found, &TrackingCount::num_found);
  }

  std::vector<TrackingCount>::const_iterator begin() const { return counts_.begin(); }
  std::vector<TrackingCount>::const_iterator end() const { return counts_.end(); }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(counts_);
  }

 private:
  // Increases a count of landmarks, whose ids ascend.
  void Add(const std::vector<LandmarkId>& ids, int TrackingCount::*num) {
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
      ++(merged.back().*num);
    }
    merged.insert(merged.end(), count, counts_.end());
    counts_ = std::move(merged);
  }

  std::vector<TrackingCount> counts_;
};

}  // namespace msc_vo
