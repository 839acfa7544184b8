// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_stamps.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Times = std::vector<MessageTimes>;

// The stamps of the headers that have one.
std::vector<double> HeaderStamps(const Times& times) {
  std::vector<double> stamps;
  for (const MessageTimes& time : times) {
    if (time.header != 0.0) stamps.push_back(time.header);
  }
  return stamps;
}

std::vector<double> ReceiveTimes(const Times& times) {
  std::vector<double> stamps;
  for (const MessageTimes& time : times) stamps.push_back(time.receive);
  return stamps;
}

// Largest step back in time; 0 if the stamps ascend.
double LargestStepBack(const std::vector<double>& stamps) {
  double largest = 0.0;
  for (size_t i = 1; i < stamps.size(); ++i) {
    largest = std::max(largest, stamps[i - 1] - stamps[i]);
  }
  return largest;
}

// Why the stamps of the headers of one topic cannot be used; empty if they can.
std::string HeaderProblem(const Times& times) {
  constexpr double kMaxDelay = 5.0;  // seconds by which transport may change the order of messages
  const std::vector<double> stamps = HeaderStamps(times);
  if (times.size() < 2) return "";
  if (2 * stamps.size() < times.size()) return "are zero";
  std::vector<double> sorted = stamps;
  std::sort(sorted.begin(), sorted.end());
  const auto num_different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  if (2 * static_cast<size_t>(num_different) < times.size()) return "repeat";
  const double step_back = LargestStepBack(stamps);
  if (step_back > kMaxDelay) return FormatText("go back by %.1f s", step_back);
  return "";
}

// Whether the time ranges of both topics overlap.
bool HaveSameClock(const std::vector<double>& color, const std::vector<double>& depth) {
  if (color.empty() || depth.empty()) return true;
  const TimeRange a = RangeOf(color, TimeUnit::kSeconds), b = RangeOf(depth, TimeUnit::kSeconds);
  const double tolerance =
      MaxPairDifference(std::min(MedianInterval(color), MedianInterval(depth)));
  return std::min(a.end, b.end) - std::max(a.begin, b.begin) >= -tolerance;
}

// Why the times of recording are used; empty if those of the headers are.
std::string ReasonForReceiveTimes(const TopicTimes& times) {
  const std::string color = HeaderProblem(times.color), depth = HeaderProblem(times.depth);
  if (!color.empty()) return "the header stamps of the colour images " + color;
  if (!depth.empty()) return "the header stamps of the depth images " + depth;
  const bool differ = !HaveSameClock(HeaderStamps(times.color), HeaderStamps(times.depth)) &&
                      HaveSameClock(ReceiveTimes(times.color), ReceiveTimes(times.depth));
  return differ ? "the header stamps of the colour and the depth images are of different clocks"
                : "";
}

void SetStamps(const Times& times, bool use_receive_times, const char* what,
               std::vector<ListedImage>* images, std::vector<std::string>* warnings) {
  std::vector<ListedImage> stamped;
  for (size_t i = 0; i < times.size(); ++i) {
    ListedImage image = (*images)[i];
    image.stamp = use_receive_times ? times[i].receive : times[i].header;
    if (image.stamp != 0.0 || times.size() == 1) stamped.push_back(std::move(image));
  }
  if (stamped.size() < images->size()) {
    warnings->push_back(
        FormatText("%zu of %zu %s images are left out, because their headers have "
                   "no stamp",
                   images->size() - stamped.size(), images->size(), what));
  }
  std::stable_sort(stamped.begin(), stamped.end(),
                   [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; });
  *images = std::move(stamped);
}

}  // namespace

void StampImages(const TopicTimes& times, ImageLists* images, std::vector<std::string>* warnings) {
  const std::string reason = ReasonForReceiveTimes(times);
  if (!reason.empty()) {
    warnings->push_back(reason +
                        "; the times at which the messages were recorded are used, which "
                        "are later and less even");
  }
  SetStamps(times.color, !reason.empty(), "colour", &images->color, warnings);
  SetStamps(times.depth, !reason.empty(), "depth", &images->depth, warnings);
}

}  // namespace msc_vo
