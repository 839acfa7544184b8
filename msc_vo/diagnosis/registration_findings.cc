// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <string>

#include "msc_vo/diagnosis/edge_alignment.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/text/enum_names.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Edge pixels in all images that a verdict on a shift needs.
constexpr int kMinEdges = 2000;
// Height of the peak over the background for one distinct edge, standard deviations of the
// gradient; it falls with the square root of their number. Below this the scene has depth edges
// that the colour does not show. Chosen by measurement, see docs/lab/depth.md.
constexpr double kMinPeakOfOneEdge = 25.0;
// Largest usual shift, pixels at an image width of 640.
constexpr double kMaxShift = 5.0;
// Ratio of the agreement without a shift to that at the peak up to which the shift is certain:
// along parallel edges the peak is broad.
constexpr double kMaxZeroRatio = 0.75;
// Largest delay of depth, seconds: during a longer one, the motion of the camera shifts depth
// edges.
constexpr double kMaxDelay = 0.02;
// Ratio of the peaks of mirrored and unmirrored images from which on the images are mirrored.
constexpr double kMirroredGain = 1.5;

// Ratio of the agreement of depth with the colour images of another time, without a shift, to that
// with its own images at the best shift, from which on depth is delayed. Unregistered depth does
// not reach 1: it agrees best with its own images. The shared sequences reach 0.4 to 0.94 as they
// are. Delayed by 1 to 3 images, six of seven reach 1.1 to 2.9, except fr1_rpy early by one image
// (0.9); kitchen, which is not registered, stays below 0.7.
constexpr double kMinDelayGain = 1.1;

const char* Name(Mirroring mirroring) {
  return EnumName<Mirroring::kBoth>(
      mirroring, {"not mirrored", "mirrored left to right", "mirrored top to bottom",
                  "rotated by 180 degrees"});
}

double MinPeak(int num_distinct_edges) {
  return kMinPeakOfOneEdge / std::sqrt(std::max(1, num_distinct_edges));
}

// Returns true if the images are mirrored.
bool AddMirroring(const EdgeAlignment& sum, Findings* findings) {
  const EdgeShift peak = FindPeak(sum);
  int best = 0;
  for (int m = 1; m < kNumMirrorings; ++m) {
    if (sum.mirrored_score[m] > sum.mirrored_score[best]) best = m;
  }
  const double mirrored = sum.mirrored_score[best] / std::max(1, sum.coarse.num_edges);
  if (best == 0 || mirrored < MinPeak(NumDistinctEdges(sum)) ||
      mirrored < kMirroredGain * peak.peak) {
    return false;
  }
  findings->push_back(
      Error("registration.mirrored",
            FormatText("the colour images are %s with respect to the depth images: depth edges "
                       "agree with the edges of the mirrored image %.1f times as well",
                       Name(static_cast<Mirroring>(best)), mirrored / std::max(0.05, peak.peak)),
            "mirror the colour or the depth images (and the principal point with them)",
            Measurement{mirrored / std::max(0.05, peak.peak), "ratio"}));
  return true;
}

// Median distance of the peaks of single images from the common one, pixels.
double Scatter(const std::vector<EdgeAlignment>& images, const Eigen::Vector2d& shift) {
  std::vector<double> distances;
  for (const EdgeAlignment& image : images) {
    if (image.coarse.num_edges > 200) distances.push_back((FindPeak(image).shift - shift).norm());
  }
  return Median(std::move(distances));
}

// Rounds to tenths, without a negative zero.
double Tenths(double value) { return std::round(10.0 * value) / 10.0 + 0.0; }

}  // namespace

void AddRegistrationFindings(const std::vector<EdgeAlignment>& images, int width,
                             Findings* findings) {
  std::vector<EdgeAlignment> simultaneous;
  EdgeAlignment all, sum;
  for (const EdgeAlignment& image : images) {
    Add(image, &all);
    if (std::abs(image.depth_delay) > kMaxDelay) continue;
    Add(image, &sum);
    simultaneous.push_back(image);
  }
  if (AddMirroring(all, findings)) return;
  const EdgeShift peak = FindPeak(sum);
  const int num_edges = sum.coarse.num_edges;
  const int num_distinct = NumDistinctEdges(sum);
  const double min_peak = MinPeak(num_distinct);
  if (num_edges < kMinEdges) {
    findings->push_back(
        Good("registration.shift",
             FormatText("registration of depth to colour is not tested: %d depth edge pixels in "
                        "%zu images without a delay of depth, %d needed",
                        num_edges, simultaneous.size(), kMinEdges)));
    return;
  }
  if (peak.peak - peak.background < min_peak) {
    findings->push_back(Good(
        "registration.shift",
        FormatText("registration of depth to colour is not tested: too few common edges in %zu "
                   "images without a delay of depth (%d depth edge pixels, %d without "
                   "repeated ones; agreement %.2f, needed %.2f)",
                   simultaneous.size(), num_edges, num_distinct, peak.peak - peak.background,
                   min_peak)));
    return;
  }
  const double distance = peak.shift.norm();
  const double scatter = Scatter(simultaneous, peak.shift);
  const std::string narrower =
      peak.widening > 0.0 ? FormatText(", near surfaces %.0f px narrower", peak.widening) : "";
  const std::string text = FormatText(
      "depth edges agree best with the edges of the colour image if shifted by (%.1f, %.1f) px%s "
      "(agreement %.2f there, %.2f without a shift; scatter %.1f px)",
      Tenths(peak.shift.x()), Tenths(peak.shift.y()), narrower.c_str(), peak.peak, peak.at_zero,
      scatter);
  const Measurement measurement{distance, "px"};
  const bool is_certain =
      peak.at_zero - peak.background < kMaxZeroRatio * (peak.peak - peak.background);
  const bool is_good = distance <= kMaxShift * width / 640.0 || !is_certain;
  findings->push_back(
      MakeFinding(is_good ? Severity::kGood : Severity::kWarning, "registration.shift", text,
                  "the depth is not registered to the colour image: switch registration "
                  "on in the driver, or warp the depth with the calibration of both "
                  "cameras",
                  measurement));
}

void AddDelayFindings(const std::vector<EdgeAlignment>& by_offset, double interval,
                      Findings* findings) {
  if (by_offset.empty()) return;
  const int reach = static_cast<int>(by_offset.size()) / 2;
  const EdgeAlignment& own = by_offset[reach];
  const EdgeShift peak = FindPeak(own);
  if (own.coarse.num_edges < kMinEdges / 2) return;
  int best = 0;
  double agreement = 0.0;
  for (int offset = -reach; offset <= reach; ++offset) {
    const EdgeShift other = FindPeak(by_offset[reach + offset]);
    const bool is_known = other.peak - other.background >= MinPeak(NumDistinctEdges(own));
    if (!is_known || other.at_zero <= agreement) continue;
    best = offset;
    agreement = other.at_zero;
  }
  const double gain = agreement / std::max(0.05, peak.peak);
  if (best == 0 || gain < kMinDelayGain) return;
  const int num_images = std::abs(best);
  const double seconds = num_images * interval;
  const char* const side = best < 0 ? "before" : "after";
  const std::string images = num_images == 1 ? "1 image" : FormatText("%d images", num_images);
  // The camera's motion during the delay is what shifts the edges.
  EraseIf(findings, [](const Finding& finding) { return finding.check == "registration.shift"; });
  findings->push_back(Warning(
      "registration.delay",
      FormatText("the depth images show the scene %.3f s (%s) %s their colour images: depth "
                 "edges agree with the images of that time %.1f times as well as with their own at "
                 "any shift",
                 seconds, images.c_str(), side, gain),
      FormatText("pair each depth image with the colour image %s %s its present one; with "
                 "lists, %s %.3f s %s the stamps of the depth images and remove associations.txt",
                 images.c_str(), side, best < 0 ? "subtract" : "add", seconds,
                 best < 0 ? "from" : "to"),
      Measurement{best < 0 ? -seconds : seconds, "s"}));
}

}  // namespace msc_vo
