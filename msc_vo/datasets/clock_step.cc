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

// The number of images of the run within a range of time.
size_t CountWithin(double begin, double end, const AscendingRun& run) {
  const auto first = std::lower_bound(run.stamps.begin(), run.stamps.end(), begin);
  const auto last = std::upper_bound(run.stamps.begin(), run.stamps.end(), end);
  return first < last ? static_cast<size_t>(last - first) : 0;
}

// Tests whether both runs have more images in their common time than displaced ones.
bool AreMixedBySorting(const AscendingRun& a, const AscendingRun& b) {
  constexpr size_t kMaxDisplaced = 2;
  const double begin = std::max(a.stamps.front(), b.stamps.front());
  const double end = std::min(a.stamps.back(), b.stamps.back());
  return std::min(CountWithin(begin, end, a), CountWithin(begin, end, b)) > kMaxDisplaced;
}

}  // namespace

std::optional<size_t> FindClockStep(const std::vector<ListedImage>& images) {
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
