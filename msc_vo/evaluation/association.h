// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

// Indices of two stamps that belong together.
struct StampMatch {
  int reference = 0;
  int query = 0;
};

// The nearest reference stamp of every query stamp, if it is at most `max_difference` seconds away.
// One to one: of several queries with the same nearest reference the closest wins (the first, of
// equals) and the others stay without a match. Both inputs ascend; the answer ascends too.
std::vector<StampMatch> MatchNearest(const std::vector<double>& reference_stamps,
                                     const std::vector<double>& query_stamps,
                                     double max_difference);

}  // namespace msc_vo
