// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/clock_step.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace msc_vo {

namespace {

// A part of a list with ascending stamps.
struct AscendingRun {
  size_t begin = 0;  // position of its first image in the list
  std::vector<double> stamps;
};

std::vector<AscendingRun> AscendingRuns(const std::vector<ListedImage>& images) {
  std::vector<AscendingRun> runs;
  std::set<std::pair<double, std::string>> known;
  for (size_t i = 0; i < images.size(); ++i) {
    const double stamp = images[i].stamp;
    if (!known.emplace(stamp, images[i].path).second) continue;  // a repeated row
    if (runs.empty() || stamp < runs.back().stamps.back()) runs.push_back({i, {}});
    runs.back().stamps.push_back(stamp);
  }
  return runs;
}

// Tests whether sorting would interleave two runs: each image of one between two of the other.
// Parts in another order, and a block of images that is listed late, change runs three times.
bool AreMixedBySorting(const AscendingRun& a, const AscendingRun& b) {
  constexpr int kMinChanges = 5;
  int num_changes = 0;
  bool in_a = a.stamps.front() <= b.stamps.front();
  size_t i = 0, j = 0;
  while (i < a.stamps.size() && j < b.stamps.size()) {
    const bool takes_a = a.stamps[i] <= b.stamps[j];
    if (takes_a != in_a) ++num_changes;
    in_a = takes_a;
    ++(takes_a ? i : j);
  }
  return num_changes >= kMinChanges;
}

}  // namespace

std::optional<size_t> FindClockStep(const std::vector<ListedImage>& images) {
  // A clock is set back once or twice in a recording; lists with more descents have no order.
  constexpr size_t kMinImages = 10;
  constexpr size_t kMinImagesPerStep = 5;
  const std::vector<AscendingRun> runs = AscendingRuns(images);
  if (images.size() < kMinImages || kMinImagesPerStep * (runs.size() - 1) > images.size()) {
    return std::nullopt;
  }
  for (size_t i = 1; i < runs.size(); ++i) {
    if (AreMixedBySorting(runs[i - 1], runs[i])) return runs[i].begin;
  }
  return std::nullopt;
}

}  // namespace msc_vo
