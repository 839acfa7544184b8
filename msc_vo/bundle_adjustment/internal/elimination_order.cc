// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace msc_vo {

std::vector<bool> LinesInReducedSystem(int num_lines, const std::vector<WindowIndex::Pair>& pairs) {
  // The partners of line i are partners[begins[i]] to partners[begins[i + 1] - 1].
  std::vector<int> begins(num_lines + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++begins[a + 1];
    ++begins[b + 1];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<int> partners(begins.back());
  std::vector<int> ends = begins;
  for (const auto& [a, b] : pairs) {
    partners[ends[a]++] = b;
    partners[ends[b]++] = a;
  }
  std::vector<std::pair<int, int>> by_degree;
  by_degree.reserve(num_lines);
  for (int i = 0; i < num_lines; ++i) by_degree.emplace_back(begins[i + 1] - begins[i], i);
  std::sort(by_degree.begin(), by_degree.end());
  std::vector<bool> in_reduced_system(num_lines, false);
  for (const auto& [degree, line] : by_degree) {
    if (in_reduced_system[line]) continue;
    for (int k = begins[line]; k < begins[line + 1]; ++k) in_reduced_system[partners[k]] = true;
  }
  return in_reduced_system;
}

}  // namespace msc_vo
