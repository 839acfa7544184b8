// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/elimination_order.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

std::vector<bool> LinesToKeep(int num_lines, const std::vector<WindowIndex::Pair>& pairs) {
  std::vector<std::vector<int>> partners(num_lines);
  for (const auto& [a, b] : pairs) {
    partners[a].push_back(b);
    partners[b].push_back(a);
  }
  std::vector<std::pair<size_t, int>> by_degree;
  for (int i = 0; i < num_lines; ++i) by_degree.emplace_back(partners[i].size(), i);
  std::sort(by_degree.begin(), by_degree.end());
  std::vector<bool> keep(num_lines, false);
  for (const auto& [degree, line] : by_degree) {
    if (keep[line]) continue;
    for (const int partner : partners[line]) keep[partner] = true;
  }
  return keep;
}

}  // namespace msc_vo
