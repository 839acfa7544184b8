// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/evaluation/association.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr double kMinInterval = 0.001, kMaxInterval = 5.0;  // seconds, of RGB-D cameras
// The error of a motion at constant velocity grows with the time that it is extrapolated over: from
// about this time on, seconds, a hand-held camera leaves the search radius of tracking. Between
// multiples of usual intervals, so that rounding decides nothing.
constexpr double kMaxGap = 0.118;
// A sequence of a low rate is recorded with slower motion: an interval is a gap if images are
// missing in it. In median intervals.
constexpr double kMissingImage = 1.5;
// Frames per second below which motion between frames is often too large for tracking.
constexpr double kMinRate = 4.0;

std::vector<double> Intervals(const std::vector<SequenceEntry>& entries) {
  std::vector<double> intervals;
  for (size_t i = 1; i < entries.size(); ++i) {
    intervals.push_back(entries[i].timestamp - entries[i - 1].timestamp);
  }
  return intervals;
}

void AddGaps(const std::vector<double>& intervals, double median, Findings* findings) {
  const double max_interval = std::max(kMaxGap, kMissingImage * median);
  const auto gaps = std::count_if(intervals.begin(), intervals.end(),
                                  [&](double interval) { return interval > max_interval; });
  if (gaps == 0) return;
  const double longest = *std::max_element(intervals.begin(), intervals.end());
  findings->push_back(
      Warning("stamps.gaps",
              FormatText("%d %s of more than %.3f s, the longest %.3f s", static_cast<int>(gaps),
                         gaps == 1 ? "gap" : "gaps", max_interval, longest),
              "tracking may be lost there; record without dropped frames (faster disk, no "
              "compression while recording)",
              Measurement{longest, "s"}));
}

void AddRate(const SequenceIndex& index, Findings* findings) {
  const std::vector<SequenceEntry>& entries = index.entries;
  const double duration = entries.back().timestamp - entries.front().timestamp;
  const std::vector<double> intervals = Intervals(entries);
  if (intervals.empty()) {
    findings->push_back(Warning("stamps.rate", "there is one image only",
                                "check the lists: odometry needs a sequence"));
    return;
  }
  const double median = Median(intervals);
  const Measurement rate{1.0 / median, "Hz"};
  const std::string text = FormatText("%zu image pairs in %.1f s, %.1f per second", entries.size(),
                                      duration, rate.value);
  if (median < kMinInterval || median > kMaxInterval) {
    findings->push_back(
        Warning("stamps.rate",
                FormatText("the median interval between images is %g s: are the stamps in seconds?",
                           median),
                "write the stamps of the lists in seconds", Measurement{median, "s"}));
  } else if (rate.value < kMinRate) {
    findings->push_back(Warning("stamps.rate", text,
                                "tracking needs slow motion at this rate; record at 15 to 30 "
                                "frames per second",
                                rate));
  } else {
    findings->push_back(Good("stamps.rate", text, rate));
  }
  AddGaps(intervals, median, findings);
}

void AddDelays(const SequenceIndex& index, Findings* findings) {
  const auto [first, last] = std::minmax_element(
      index.entries.begin(), index.entries.end(),
      [](const auto& a, const auto& b) { return a.depth_delay < b.depth_delay; });
  if (first->depth_delay == 0.0 && last->depth_delay == 0.0) return;
  findings->push_back(
      Good("stamps.depth_delay",
           FormatText("depth images are %.1f to %.1f ms later than their colour images; replay "
                      "compensates for the motion of the camera in that time",
                      1e3 * first->depth_delay, 1e3 * last->depth_delay),
           Measurement{last->depth_delay, "s"}));
}

}  // namespace

void AddStampFindings(const SequenceIndex& index, Findings* findings) {
  AddRate(index, findings);
  AddDelays(index, findings);
}

void AddGroundTruthStampFindings(const SequenceIndex& index, Findings* findings) {
  const std::vector<TimedPose>& truth = index.ground_truth;
  if (truth.empty()) {
    findings->push_back(
        Good("ground_truth.overlap", "no ground truth: replay will not report errors"));
    return;
  }
  const std::vector<double> truth_stamps = TimestampsOf(truth, &TimedPose::timestamp);
  const std::vector<double> image_stamps = TimestampsOf(index.entries, &SequenceEntry::timestamp);
  const double max_difference = EvaluationOptions().max_time_difference;
  const size_t num_matched = AssociateStamps(truth_stamps, image_stamps, max_difference).size();
  const double ratio = static_cast<double>(num_matched) / static_cast<double>(image_stamps.size());
  const std::string text =
      TruthName(index) + FormatText(": %zu poses, %zu of %zu images have one within %.0f ms",
                                    truth.size(), num_matched, image_stamps.size(),
                                    1e3 * max_difference);
  if (ratio >= 0.5) {
    findings->push_back(Good("ground_truth.overlap", text, Measurement{ratio, "ratio"}));
    return;
  }
  const double start = truth_stamps.front() - image_stamps.front();
  findings->push_back(
      Warning("ground_truth.overlap",
              text + FormatText("; its stamps begin %.3f s %s those of the images: is it on "
                                "another clock, in another unit, or of another sequence?",
                                std::abs(start), start < 0.0 ? "before" : "after"),
              "give the ground truth of these images, in seconds of their clock",
              Measurement{ratio, "ratio"}));
}

}  // namespace msc_vo
