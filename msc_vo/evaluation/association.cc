// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/association.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

namespace msc_vo {

namespace {

// Matches the closest pair repeatedly. Of the unmatched stamps of both lists, in ascending order,
// the closest reference and query are always neighbours; so only neighbours are candidates, and the
// stamps on both sides of a match become neighbours.
class StampAssociator {
 public:
  StampAssociator(const std::vector<double>& references, const std::vector<double>& queries,
                  double max_difference)
      : max_difference_(max_difference) {
    for (size_t i = 0; i < references.size(); ++i) {
      stamps_.push_back({references[i], static_cast<int>(i), true});
    }
    for (size_t i = 0; i < queries.size(); ++i) {
      stamps_.push_back({queries[i], static_cast<int>(i), false});
    }
    std::stable_sort(stamps_.begin(), stamps_.end(),
                     [](const Stamp& a, const Stamp& b) { return a.time < b.time; });
    for (int i = 0; i < static_cast<int>(stamps_.size()); ++i) {
      stamps_[i].previous = i - 1;
      stamps_[i].next = i + 1;
      AddCandidate(i - 1, i);
    }
  }

  // The matches are in no particular order.
  std::vector<StampMatch> Associate() {
    std::vector<StampMatch> matches;
    while (!candidates_.empty()) {
      const auto [difference, reference, query, left, right] = candidates_.top();
      candidates_.pop();
      if (stamps_[left].matched || stamps_[right].matched) continue;
      matches.push_back({reference, query});
      Remove(left, right);
    }
    return matches;
  }

 private:
  struct Stamp {
    double time;  // seconds
    int index;    // in its list
    bool is_reference;
    bool matched = false;
    int previous = 0;  // neighbours among the unmatched stamps
    int next = 0;
  };
  // Difference, reference, query, positions of the two in stamps_; the order resolves ties.
  using Candidate = std::tuple<double, int, int, int, int>;

  void AddCandidate(int left, int right) {
    if (left < 0 || right >= static_cast<int>(stamps_.size())) return;
    const Stamp &a = stamps_[left], &b = stamps_[right];
    if (a.is_reference == b.is_reference) return;
    const double difference = b.time - a.time;
    if (!(difference <= max_difference_)) return;
    candidates_.emplace(difference, a.is_reference ? a.index : b.index,
                        a.is_reference ? b.index : a.index, left, right);
  }

  void Remove(int left, int right) {
    stamps_[left].matched = stamps_[right].matched = true;
    const int before = stamps_[left].previous, after = stamps_[right].next;
    if (before >= 0) stamps_[before].next = after;
    if (after < static_cast<int>(stamps_.size())) stamps_[after].previous = before;
    AddCandidate(before, after);
  }

  double max_difference_;
  std::vector<Stamp> stamps_;  // of both lists, in ascending order
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates_;
};

// Matches the first of several equal stamps of a list, in their order. `matches` must be in order
// of `stamps`.
void MatchEqualStampsInOrder(const std::vector<double>& stamps, int StampMatch::*index,
                             std::vector<StampMatch>* matches) {
  int next = 0;
  for (StampMatch& match : *matches) {
    const double stamp = stamps[match.*index];
    if (next == 0 || stamps[next - 1] != stamp) {
      next =
          static_cast<int>(std::lower_bound(stamps.begin(), stamps.end(), stamp) - stamps.begin());
    }
    match.*index = next++;
  }
}

}  // namespace

std::vector<StampMatch> AssociateStamps(const std::vector<double>& reference_stamps,
                                        const std::vector<double>& query_stamps,
                                        double max_difference) {
  std::vector<StampMatch> matches =
      StampAssociator(reference_stamps, query_stamps, max_difference).Associate();
  std::stable_sort(matches.begin(), matches.end(), [&](const StampMatch& a, const StampMatch& b) {
    return std::pair(query_stamps[a.query], reference_stamps[a.reference]) <
           std::pair(query_stamps[b.query], reference_stamps[b.reference]);
  });
  MatchEqualStampsInOrder(query_stamps, &StampMatch::query, &matches);
  std::stable_sort(matches.begin(), matches.end(), [&](const StampMatch& a, const StampMatch& b) {
    return std::pair(reference_stamps[a.reference], a.query) <
           std::pair(reference_stamps[b.reference], b.query);
  });
  MatchEqualStampsInOrder(reference_stamps, &StampMatch::reference, &matches);
  return matches;
}

}  // namespace msc_vo
