// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/self_calibration/noise_estimator.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Displacement from image to image, as a fraction of the width, that tracking bridges easily.
constexpr double kMaxDisplacement = 0.08;
constexpr double kMinTrackedRatio = 0.8;

// Latency that warrants a warning, seconds, and the standard deviations that it must exceed.
constexpr double kMaxLatency = 0.03;
constexpr double kMaxLatencySigma = 0.02;
constexpr double kFindingSigmas = 4.0;
constexpr int kMinEdges = 100;
constexpr double kMinAgreement = 0.2;
constexpr size_t kMinImages = 15;
// Ratio by which the agreement of the edges must grow.
constexpr double kMinGain = 1.1;

struct Latency {
  double seconds = 0.0;
  double sigma = 0.0;
  double agreement = 0.0;   // of the edges at this latency
  double gain = 0.0;        // over the agreement without latency
  double least_gain = 0.0;  // over the agreement at the latencies far from it, on the worse side
};

// Estimates latency and shift of the depth images together: in uniform motion, one is as good an
// explanation as the other.
class LatencyEstimator {
 public:
  explicit LatencyEstimator(const MotionTrack& track) {
    std::vector<const MotionImage*> images;
    std::vector<Eigen::Vector2d> velocities;  // pixels/second
    for (size_t i = 0; i + 1 < track.images.size(); ++i) {
      const MotionImage& image = track.images[i];
      const MotionImage& next = track.images[i + 1];
      if (!image.linked || !next.linked || image.edges.coarse.num_edges < kMinEdges) continue;
      images.push_back(&image);
      velocities.push_back(0.5 * (image.velocity + next.velocity));
    }
    num_images_ = images.size();
    for (size_t i = 0; i < images.size(); ++i) {
      const EdgeScore& edges = images[i]->edges.coarse;
      const cv::Mat sum = edges.Sum();
      num_edges_ += edges.num_edges;
      for (int l = 0; l < kNumLatencies; ++l) {
        // Depth that is taken later shows the scene further along: its edges must be moved back.
        const double delay = LatencyAt(l) + images[i]->depth_delay;
        AddTo(MovedScore(sum, -delay / edges.step * velocities[i]),
              &sums_[i * kGroups / images.size()][l]);
      }
    }
  }

  size_t size() const { return num_images_; }

  Latency Estimate() const {
    const std::vector<double> agreements = Agreements(-1);
    const int best = Best(agreements);
    Latency latency;
    latency.seconds = LatencyAt(best);
    latency.agreement = agreements[best];
    const auto gain_over = [&](int l) {
      return agreements[best] / std::max(1e-3, agreements[std::clamp(l, 0, kNumLatencies - 1)]);
    };
    latency.gain = gain_over(kNumLatencies / 2);
    latency.least_gain = std::min(gain_over(best - kFar), gain_over(best + kFar));
    // Jackknife over groups of consecutive images, which see the same edges.
    double squares = 0.0;
    for (int group = 0; group < kGroups; ++group) {
      const double difference = LatencyAt(Best(Agreements(group))) - latency.seconds;
      squares += difference * difference;
    }
    latency.sigma = std::hypot(std::sqrt(squares * (kGroups - 1.0) / kGroups), 0.5 * kStep);
    return latency;
  }

 private:
  static constexpr int kGroups = 8;
  static constexpr double kStep = 0.005;     // seconds
  static constexpr int kNumLatencies = 101;  // symmetric about 0
  static constexpr int kFar = 20;            // steps

  static double LatencyAt(int l) { return (l - kNumLatencies / 2) * kStep; }

  static void AddTo(const cv::Mat& score, cv::Mat* sum) {
    if (sum->empty()) {
      *sum = score;
    } else {
      *sum += score;
    }
  }

  // Agreement of the edges at each latency and the best shift for it, without a group of images.
  std::vector<double> Agreements(int left_out) const {
    std::vector<double> agreements;
    for (int l = 0; l < kNumLatencies; ++l) {
      cv::Mat sum;
      for (int group = 0; group < kGroups; ++group) {
        if (group != left_out) AddTo(sums_[group][l].clone(), &sum);
      }
      double largest = 0.0;
      cv::minMaxLoc(sum, nullptr, &largest);
      agreements.push_back(largest / num_edges_);
    }
    return agreements;
  }

  // The latency with the highest agreement, the smallest one on ties.
  static int Best(const std::vector<double>& agreements) {
    int best = kNumLatencies / 2;
    for (int i = 1; i <= kNumLatencies / 2; ++i) {
      for (const int l : {kNumLatencies / 2 - i, kNumLatencies / 2 + i}) {
        if (agreements[l] > agreements[best] + 1e-9) best = l;
      }
    }
    return best;
  }

  size_t num_images_ = 0;
  double num_edges_ = 0.0;
  // Sums of the scores of each group of images at each latency.
  std::array<std::array<cv::Mat, kNumLatencies>, kGroups> sums_;
};

// Whether the images have poses, and whether these are certain.
void AddMatching(const MotionTrack& track, Findings* findings) {
  const auto num_tracked = static_cast<int>(track.images.size());
  const auto are_few = [&track](int count) { return count < kMinTrackedRatio * track.num_images; };
  if (!are_few(num_tracked)) return;
  std::string text =
      FormatText("only %d of %d images can be tracked", num_tracked, track.num_images);
  if (track.num_weak > 0) text += FormatText(", %d have a weak pose", track.num_weak);
  findings->push_back(
      Warning("motion.matching", text,
              are_few(num_tracked + track.num_weak)
                  ? "slower motion, a higher frame rate, more light or more texture"
                  : "view more texture, or planes in three directions",
              Measurement{static_cast<double>(num_tracked) / track.num_images, "ratio"}));
}

}  // namespace

void AddFrameMotionFindings(const MotionTrack& track, int width, Findings* findings) {
  if (track.num_images == 0) return;
  std::vector<double> displacements;
  for (const MotionImage& image : track.images) {
    if (image.linked) displacements.push_back(image.displacement);
  }
  AddMatching(track, findings);
  if (displacements.empty()) return;
  const double median = Median(displacements);
  const double high = Quantile(0.9, displacements);
  const std::string text = FormatText(
      "motion: features move by %.1f px from image to image (median; %.1f px in one of "
      "ten)",
      median, high);
  const Measurement measurement{high, "px"};
  const bool is_good = high <= kMaxDisplacement * width;
  findings->push_back(MakeFinding(is_good ? Severity::kGood : Severity::kWarning,
                                  "motion.frame_rate", text,
                                  "the frame rate is low for this motion: record more frames per "
                                  "second, move more slowly, or shorten the exposure",
                                  measurement));
}

void AddLatencyFindings(const MotionTrack& track, Findings* findings) {
  const LatencyEstimator estimator(track);
  const std::string check = "stamps.depth_latency";
  if (estimator.size() < kMinImages) {
    findings->push_back(Good(check, "latency of depth: not tested, too few common edges"));
    return;
  }
  const Latency latency = estimator.Estimate();
  const double seconds = latency.seconds;
  const bool is_significant = std::abs(seconds) > kFindingSigmas * latency.sigma;
  if (latency.sigma > kMaxLatencySigma || latency.agreement < kMinAgreement ||
      latency.least_gain < kMinGain || (is_significant && latency.gain < kMinGain)) {
    findings->push_back(
        Good(check, "latency of depth: not tested, little or uniform motion, or few common edges"));
    return;
  }
  const std::string text = FormatText(
      "depth is taken %.0f +- %.0f ms %s than its time stamps say (agreement of the edges %.2f "
      "times that without latency)",
      1e3 * std::abs(seconds), 1e3 * latency.sigma, seconds > 0.0 ? "later" : "earlier",
      latency.gain);
  const Measurement measurement{seconds, "s"};
  const bool is_good = std::abs(seconds) <= kMaxLatency || !is_significant;
  findings->push_back(MakeFinding(
      is_good ? Severity::kGood : Severity::kWarning, check, text,
      FormatText("%s %.3f s %s the stamps in the list of depth images and pair anew (remove "
                 "associations.txt)",
                 seconds > 0.0 ? "add" : "subtract", std::abs(seconds),
                 seconds > 0.0 ? "to" : "from"),
      measurement));
}

void AddNoiseFindings(const MotionTrack& track, Findings* findings) {
  const std::string check = "depth.noise";
  if (track.noise_scales.empty()) return;
  std::vector<double> scales;
  for (const NoiseScale& scale : track.noise_scales) {
    for (const double of_depth : {scale.point_depth, scale.line_depth}) {
      if (of_depth != 1.0) scales.push_back(of_depth);  // 1 until it is estimated
    }
  }
  if (scales.empty()) {
    findings->push_back(Good(check, "errors of depth: not tested, too few keyframes"));
    return;
  }
  const auto [smallest, largest] = std::minmax_element(scales.begin(), scales.end());
  const std::string text = FormatText(
      "errors of depth are %.2f to %.2f times those that the options expect", *smallest, *largest);
  const Measurement measurement{*largest, "ratio"};
  if (*largest < NoiseEstimator::kMaxScale) {
    const bool at_bound = *smallest <= 1.0 / NoiseEstimator::kMaxScale;
    findings->push_back(
        Good(check, text + (at_bound ? "; the smallest factor, so depth is nearly exact" : ""),
             measurement));
    return;
  }
  const std::string at_largest = text + "; the largest factor: depth contradicts the images";
  const auto is_good = [](const Finding& f) { return f.severity == Severity::kGood; };
  if (!std::all_of(findings->begin(), findings->end(), is_good)) {
    findings->push_back(Good(check, at_largest, measurement));
    return;
  }
  findings->push_back(Warning(check, at_largest,
                              "check depth scale, registration and time stamps of depth; if they "
                              "are right, set features.noise.inverse_depth_sigma to the error of "
                              "the sensor",
                              measurement));
}

}  // namespace msc_vo
