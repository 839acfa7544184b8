// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_stamps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Times = std::vector<MessageTimes>;

// Position of the message at which one of the clocks was set back; none if it was not.
std::optional<size_t> FindStep(const Times& times, double MessageTimes::*clock) {
  std::vector<ListedImage> images;
  for (const MessageTimes& time : times) {
    images.push_back({time.*clock, std::to_string(images.size()), "", -1});
  }
  return FindClockStep(images);
}

// The messages whose headers have a stamp, in the order of the times of recording. These are not
// in order in a file that was merged from others, but if the clock of the recorder was set back,
// the order of the file is right.
Times StampedInOrder(Times times) {
  const bool is_ordered = FindStep(times, &MessageTimes::receive).has_value();
  EraseIf(&times, [](const MessageTimes& time) { return time.header == 0.0; });
  const auto earlier = [](const MessageTimes& a, const MessageTimes& b) {
    return a.receive < b.receive;
  };
  if (!is_ordered) std::stable_sort(times.begin(), times.end(), earlier);
  return times;
}

// Seconds by which the headers go back in time more than transport explains; 0: they do not.
double StepBack(const Times& stamped) {
  constexpr double kMaxDelay = 5.0;  // by which transport may change the order of messages
  const auto back = [&](size_t i) { return stamped[i - 1].header - stamped[i].header; };
  const std::optional<size_t> step = FindStep(stamped, &MessageTimes::header);
  if (step) return back(*step);
  for (size_t i = 1; i < stamped.size(); ++i) {
    if (back(i) > kMaxDelay) return back(i);
  }
  return 0.0;
}

// Why the stamps of the headers of one topic cannot be used; empty if they can.
std::string HeaderProblem(const Times& times) {
  const Times stamped = StampedInOrder(times);
  const std::vector<double> stamps = TimestampsOf(stamped, &MessageTimes::header);
  if (times.size() < 2) return "";
  if (2 * stamps.size() < times.size()) return "are zero";
  std::vector<double> sorted = stamps;
  std::sort(sorted.begin(), sorted.end());
  const auto num_different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  if (2 * static_cast<size_t>(num_different) < times.size()) return "repeat";
  const double step_back = StepBack(stamped);
  return step_back > 0.0 ? FormatText("go back by %.1f s", step_back) : "";
}

// Tests whether messages were recorded in order and at the rate of their images. A converted bag
// may have the times of its conversion.
bool IsRecordedLive(const Times& times) {
  constexpr double kMaxRatio = 2.0;
  const std::vector<double> received = TimestampsOf(times, &MessageTimes::receive);
  if (!std::is_sorted(received.begin(), received.end())) return false;
  const double recorded = MedianInterval(received);
  const double taken = MedianInterval(TimestampsOf(times, &MessageTimes::header));
  return recorded > 0.0 && taken > 0.0 && recorded < kMaxRatio * taken &&
         taken < kMaxRatio * recorded;
}

// Seconds from the header stamps to the recording of a colour and a depth message.
struct Delays {
  double color;
  double depth;
};

// The delays of each colour message that has a depth message recorded near it, with those of that.
std::vector<Delays> DelaysOfNeighbours(const Times& color, const Times& depth, double interval) {
  std::vector<Delays> delays;
  size_t nearest = 0;
  for (const MessageTimes& time : color) {
    const auto distance = [&](size_t i) { return std::abs(depth[i].receive - time.receive); };
    while (nearest + 1 < depth.size() && distance(nearest + 1) <= distance(nearest)) ++nearest;
    if (distance(nearest) > interval) continue;
    delays.push_back({time.receive - time.header, depth[nearest].receive - depth[nearest].header});
  }
  return delays;
}

// The difference of the clocks in the headers of both topics, by the times of recording.
struct ClockOffset {
  double seconds = 0.0;       // by which the stamps of depth are later than those of colour
  bool is_of_clocks = false;  // more than transport explains
};

constexpr double kUsualDelay = 0.1;  // seconds; of most drivers it is a few 10 ms

ClockOffset OffsetOf(const std::vector<Delays>& delays, double interval) {
  // Compression of depth to PNG and registration by software delay images by up to 0.2 s, a full
  // queue by its usual length of ten images. Delays scatter, the offset of two clocks does not.
  constexpr double kMaxDelay = 0.3, kMaxIntervals = 10.0, kMaxSpreads = 3.0;
  std::vector<double> offsets;
  for (const Delays& delay : delays) offsets.push_back(delay.color - delay.depth);
  const double offset = Median(offsets);
  const double spread = Quantile(0.75, offsets) - Quantile(0.25, offsets);
  const auto [least, most] = std::minmax(
      {Median(TimestampsOf(delays, &Delays::color)), Median(TimestampsOf(delays, &Delays::depth))});
  // No image is recorded before it is taken.
  const bool is_early = least < -kUsualDelay && most >= 0.0;
  const double limit = is_early ? kUsualDelay : std::max(kMaxDelay, kMaxIntervals * interval);
  return {offset, std::abs(offset) > std::max(limit, kMaxSpreads * spread)};
}

// The largest offset in a part of the recording, as a clock may be set in the middle.
ClockOffset FindClockOffset(const TopicTimes& times) {
  constexpr size_t kMaxParts = 10, kMinPerPart = 15;
  const Times color = StampedInOrder(times.color), depth = StampedInOrder(times.depth);
  ClockOffset largest;
  if (!IsRecordedLive(color) || !IsRecordedLive(depth)) return largest;
  const double interval = std::max(MedianInterval(TimestampsOf(color, &MessageTimes::receive)),
                                   MedianInterval(TimestampsOf(depth, &MessageTimes::receive)));
  const std::vector<Delays> delays = DelaysOfNeighbours(color, depth, interval);
  const size_t num_parts = std::clamp<size_t>(delays.size() / kMinPerPart, 1, kMaxParts);
  const auto begin_of = [&](size_t part) {
    return delays.begin() + static_cast<std::ptrdiff_t>(part * delays.size() / num_parts);
  };
  for (size_t i = 0; i < num_parts; ++i) {
    const ClockOffset part = OffsetOf({begin_of(i), begin_of(i + 1)}, interval);
    if (std::pair(part.is_of_clocks, std::abs(part.seconds)) >
        std::pair(largest.is_of_clocks, std::abs(largest.seconds))) {
      largest = part;
    }
  }
  return largest;
}

std::string DescribeOffset(double seconds) {
  return FormatText(
      "the header stamps of the depth images are %.3f s %s than those of colour images that were "
      "recorded at the same time",
      std::abs(seconds), seconds > 0.0 ? "later" : "earlier");
}

// Why the times of recording are used; empty if those of the headers are.
std::string ReasonForReceiveTimes(const TopicTimes& times, std::vector<std::string>* warnings) {
  const std::string color = HeaderProblem(times.color), depth = HeaderProblem(times.depth);
  if (!color.empty()) return "the header stamps of the colour images " + color;
  if (!depth.empty()) return "the header stamps of the depth images " + depth;
  const ClockOffset offset = FindClockOffset(times);
  const std::string text = DescribeOffset(offset.seconds);
  if (offset.is_of_clocks) return text + ", more than transport explains: their clocks differ";
  if (std::abs(offset.seconds) > kUsualDelay) {
    warnings->push_back(text +
                        ", which is taken for a transport delay; if their clocks differ, correct "
                        "the header stamps in a copy of the bag");
  }
  return "";
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

// Throws if the clock of the recorder was set back.
void RequireOneReceiveClock(const Times& times, const std::vector<ListedImage>& images) {
  const std::optional<size_t> step = FindStep(times, &MessageTimes::receive);
  if (!step) return;
  throw std::runtime_error(
      images[*step].path +
      FormatText(
          ": the clock of the recorder goes back by %.3f s here, into a time that has images "
          "already, and the header stamps cannot be used; divide the bag there",
          times[*step - 1].receive - times[*step].receive));
}

}  // namespace

void StampImages(const TopicTimes& times, ImageLists* images, std::vector<std::string>* warnings) {
  const std::string reason = ReasonForReceiveTimes(times, warnings);
  if (!reason.empty()) {
    warnings->push_back(reason +
                        "; the times at which the messages were recorded are used, which "
                        "are later and less even");
    RequireOneReceiveClock(times.color, images->color);
    RequireOneReceiveClock(times.depth, images->depth);
  }
  SetStamps(times.color, !reason.empty(), "colour", &images->color, warnings);
  SetStamps(times.depth, !reason.empty(), "depth", &images->depth, warnings);
}

}  // namespace msc_vo
