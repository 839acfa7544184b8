// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace msc_vo {

/// Partners of each kind per line. Chosen by measurement, see docs/lab/structure.md.
constexpr int kMaxPartners = 4;

/// Keeps the pairs that are among the kMaxPartners most certain ones of either line, and sorts
/// them by their uncertainty. Pair: `sigma`, standard deviation of the angle between the lines;
/// `i` and `j`, indices of the lines below `num_lines`, which break ties.
template <typename Pair>
void SelectMostCertain(size_t num_lines, std::vector<Pair>* pairs) {
  std::sort(pairs->begin(), pairs->end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.sigma, a.i, a.j) < std::tie(b.sigma, b.i, b.j);
  });
  std::vector<int> num_partners(num_lines, 0);
  std::vector<Pair> selected;
  for (const Pair& pair : *pairs) {
    const bool by_i = num_partners[pair.i]++ < kMaxPartners;
    const bool by_j = num_partners[pair.j]++ < kMaxPartners;
    if (by_i || by_j) selected.push_back(pair);
  }
  *pairs = std::move(selected);
}

}  // namespace msc_vo
