// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/association.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

// Index of the stamp nearest to `stamp`, the earlier one of two at the same distance.
int NearestIndex(const std::vector<double>& stamps, double stamp) {
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  if (after == stamps.begin()) return 0;
  const int index = static_cast<int>(after - stamps.begin());
  if (after == stamps.end()) return index - 1;
  return std::abs(stamps[index - 1] - stamp) <= std::abs(stamps[index] - stamp) ? index - 1 : index;
}

}  // namespace

std::vector<StampMatch> MatchNearest(const std::vector<double>& reference_stamps,
                                     const std::vector<double>& query_stamps,
                                     double max_difference) {
  if (reference_stamps.empty()) return {};
  constexpr int kNone = -1;
  std::vector<int> query_of_reference(reference_stamps.size(), kNone);
  for (int query = 0; query < static_cast<int>(query_stamps.size()); ++query) {
    const int reference = NearestIndex(reference_stamps, query_stamps[query]);
    const double difference = std::abs(reference_stamps[reference] - query_stamps[query]);
    if (!(difference <= max_difference)) continue;
    int& best = query_of_reference[reference];
    if (best == kNone || difference < std::abs(reference_stamps[reference] - query_stamps[best])) {
      best = query;
    }
  }
  std::vector<StampMatch> matches;
  for (int reference = 0; reference < static_cast<int>(query_of_reference.size()); ++reference) {
    if (query_of_reference[reference] != kNone) {
      matches.push_back({reference, query_of_reference[reference]});
    }
  }
  return matches;
}

}  // namespace msc_vo
