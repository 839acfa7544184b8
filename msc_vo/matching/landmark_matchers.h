// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <utility>
#include <vector>

#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/point_matcher.h"

namespace msc_vo {

/// The matchers of all kinds of landmarks.
struct MatcherOptions {
  PointMatcherOptions point_matcher;
  LineMatcherOptions line_matcher;
};

/// Matches candidates of one kind with the features of a frame (MatchPoints, MatchLines).
inline std::vector<PointMatch> MatchFeatures(const MatcherOptions& options, const Frame& frame,
                                             const std::vector<PointCandidate>& candidates,
                                             double radius, const std::vector<bool>& taken) {
  return MatchPoints(options.point_matcher, frame, candidates, radius, taken);
}
inline std::vector<LineMatch> MatchFeatures(const MatcherOptions& options, const Frame& frame,
                                            const std::vector<LineCandidate>& candidates,
                                            double radius, const std::vector<bool>& taken) {
  return MatchLines(options.line_matcher, frame, candidates, radius, taken);
}

/// The candidates and the matches of a kind L of landmarks.
template <typename L>
using Candidates = std::vector<decltype(CandidateOf(std::declval<const L&>()))>;
template <typename L>
using Matches = std::vector<typename Candidates<L>::value_type::Match>;

}  // namespace msc_vo
