// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/similar_name.h"

#include <algorithm>
#include <numeric>

namespace msc_vo {

int EditDistance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

int MaxTypingErrors(const std::string& name) { return static_cast<int>(name.size()) / 3; }

std::optional<std::string> FindSimilarName(const std::vector<std::string>& names,
                                           const std::string& name) {
  std::optional<std::string> nearest;
  int smallest = MaxTypingErrors(name) + 1;
  for (const std::string& known : names) {
    const int distance = EditDistance(name, known);
    if (distance >= smallest) continue;
    smallest = distance;
    nearest = known;
  }
  return nearest;
}

}  // namespace msc_vo
