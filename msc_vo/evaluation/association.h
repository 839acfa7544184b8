// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

namespace msc_vo {

/// Indices of two associated stamps.
struct StampMatch {
  int reference = 0;
  int query = 0;
};

/// Associates two lists of stamps one-to-one, closest pair first (as associate.py of the TUM RGB-D
/// benchmark): of all pairs that differ by at most `max_difference` seconds, the closest is
/// matched, then the closest of the remaining stamps, and so on. A stamp whose nearest partner is
/// taken gets the next one within `max_difference`. On ties the earlier reference is matched first,
/// then the earlier query. Both lists must be in ascending order. Equal stamps of a list are
/// matched in their order, the first of them if there are too many. The matches are in ascending
/// order of the reference.
std::vector<StampMatch> AssociateStamps(const std::vector<double>& reference_stamps,
                                        const std::vector<double>& query_stamps,
                                        double max_difference);

}  // namespace msc_vo
