// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_pairing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/evaluation/association.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Adds the pair of images at these positions of the lists. `delay`: seconds from the colour image
// to the depth image.
void AddPair(const ImageLists& images, size_t color_position, size_t depth_position, double delay,
             SequenceIndex* index) {
  const ListedImage& color = images.color[color_position];
  const ListedImage& depth = images.depth[depth_position];
  const bool same_row = color.origin == depth.origin;
  index->entries.push_back({color.stamp, color.path, depth.path,
                            same_row ? color.origin : color.origin + " and " + depth.origin, delay,
                            color.index, depth.index, static_cast<int>(color_position),
                            static_cast<int>(depth_position)});
}

// Warns if one list begins and ends later than the other by the same time. Recordings may differ at
// either end, but hardly by the same time at both ends.
void CheckOffset(const ImageLists& images, double max_difference, SequenceIndex* index) {
  const std::vector<ListedImage>&color = images.color, &depth = images.depth;
  if (color.size() < 2 || depth.size() < 2) return;
  const double at_begin = depth.front().stamp - color.front().stamp;
  const double at_end = depth.back().stamp - color.back().stamp;
  if (std::min(std::abs(at_begin), std::abs(at_end)) <= max_difference) return;
  if (std::abs(at_begin - at_end) > max_difference) return;
  const double offset = 0.5 * (at_begin + at_end);
  const std::string advice = index->container ? "correct its stamps in a copy of the recording"
                             : offset > 0.0   ? "subtract it in the list of depth images"
                                              : "add it in the list of depth images";
  index->warnings.push_back(FormatText(
      "the stamps of the depth images begin and end %.3f s %s than those of the colour images; if "
      "the clock of the depth camera is off by that, %s",
      std::abs(offset), offset > 0.0 ? "later" : "earlier", advice.c_str()));
}

}  // namespace

double MaxPairDifference(double interval) {
  constexpr double kSmallest = 0.02, kLargest = 0.15;  // seconds
  constexpr double kRatio = 0.55;                      // of the interval
  return std::clamp(kRatio * interval, kSmallest, kLargest);
}

double MaxPairDifference(const ImageLists& images) {
  return MaxPairDifference(
      std::min(MedianInterval(TimestampsOf(images.color, &ListedImage::stamp)),
               MedianInterval(TimestampsOf(images.depth, &ListedImage::stamp))));
}

void PairByTime(const ImageLists& images, double max_difference, SequenceIndex* index) {
  const std::vector<StampMatch> matches =
      AssociateStamps(TimestampsOf(images.color, &ListedImage::stamp),
                      TimestampsOf(images.depth, &ListedImage::stamp), max_difference);
  for (const StampMatch& match : matches) {
    const double delay = images.depth[match.query].stamp - images.color[match.reference].stamp;
    AddPair(images, match.reference, match.query, delay, index);
  }
  index->num_color = images.color.size();
  index->num_depth = images.depth.size();
  index->num_listed = std::min(images.color.size(), images.depth.size());
  const size_t num_unpaired = images.color.size() - matches.size();
  if (matches.empty() && index->num_listed > 0) {
    index->warnings.push_back(FormatText(
        "the stamps of the colour images are from %.3f to %.3f s, those of the depth images from "
        "%.3f to %.3f s; if their clocks differ, %s",
        images.color.front().stamp, images.color.back().stamp, images.depth.front().stamp,
        images.depth.back().stamp,
        index->container ? "correct the stamps in a copy of the recording"
                         : "write associations.txt with 'time colour time depth' rows"));
  } else if (num_unpaired > 0) {
    index->warnings.push_back(
        FormatText("%zu of %zu colour images have no depth image within %.0f ms and are left out",
                   num_unpaired, images.color.size(), 1e3 * max_difference));
  }
  CheckOffset(images, max_difference, index);
}

void PairByRow(const ImageLists& images, SequenceIndex* index) {
  constexpr double kRounding = 1e-6;  // seconds, of stamps since 1970
  const double max_difference = MaxPairDifference(images);
  const size_t num_rows = images.color.size();
  index->num_listed = index->num_color = index->num_depth = num_rows;
  const auto delay = [&](size_t i) { return images.depth[i].stamp - images.color[i].stamp; };
  std::vector<double> agreeing;  // delays
  for (size_t i = 0; i < num_rows; ++i) {
    if (std::abs(delay(i)) <= max_difference + kRounding) agreeing.push_back(delay(i));
  }
  const bool same_clock = !agreeing.empty() && 4 * agreeing.size() >= num_rows;
  // The delay of a sensor may scatter about the limit.
  const double usual = same_clock ? UpperMedian(agreeing) : 0.0;
  std::vector<size_t> apart;  // rows
  for (size_t i = 0; i < num_rows; ++i) {
    const bool is_apart = std::abs(delay(i) - usual) > max_difference + kRounding;
    if (is_apart) apart.push_back(i);
    if (same_clock && is_apart) continue;
    AddPair(images, i, i, same_clock ? delay(i) : 0.0, index);
  }
  if (!apart.empty() && apart.size() < num_rows) {
    const size_t first = apart.front();
    index->warnings.push_back(FormatText(
        "%s: the stamps of colour and depth differ by %.3f s, in %zu of %zu rows by more than %.0f "
        "ms%s",
        images.color[first].origin.c_str(), std::abs(delay(first)), apart.size(), num_rows,
        1e3 * max_difference,
        same_clock ? " from the usual delay: these rows are left out; if their images belong "
                     "together, write the stamp of the colour image for both"
                   : ": the clocks are taken for different ones and all rows are used; check the "
                     "pairs"));
  }
  if (!same_clock) CheckOffset(images, max_difference, index);
}

}  // namespace msc_vo
