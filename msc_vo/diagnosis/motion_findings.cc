// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_findings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/diagnosis/quantile.h"
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
  double gain = 0.0;  // agreement of the edges at this latency over that at none
};

// Score of an image for a shift in pixels, bilinear; the border value outside.
double ScoreAt(const EdgeScore& edges, const Eigen::Vector2d& shift) {
  const double limit = 2.0 * edges.reach - 1e-3;
  const double x = std::clamp(shift.x() / edges.step + edges.reach, 0.0, limit);
  const double y = std::clamp(shift.y() / edges.step + edges.reach, 0.0, limit);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double a = x - column, b = y - row;
  const auto at = [&](int dx, int dy) { return edges.sum.at<double>(row + dy, column + dx); };
  return (1.0 - b) * ((1.0 - a) * at(0, 0) + a * at(1, 0)) +
         b * ((1.0 - a) * at(0, 1) + a * at(1, 1));
}

class LatencyEstimator {
 public:
  explicit LatencyEstimator(const MotionTrack& track) {
    for (size_t i = 0; i + 1 < track.images.size(); ++i) {
      const MotionImage& image = track.images[i];
      const MotionImage& next = track.images[i + 1];
      if (!image.linked || !next.linked || image.edges.coarse.num_edges < kMinEdges) continue;
      samples_.push_back({&image.edges, 0.5 * (image.velocity + next.velocity), image.depth_delay});
      num_edges_ += image.edges.coarse.num_edges;
    }
  }

  size_t size() const { return samples_.size(); }

  // Of the peak at the best shift and latency.
  double Agreement() const { return agreement_; }

  Latency Estimate() {
    Latency latency;
    latency.seconds = Best(-1, &latency.gain);
    // Jackknife over groups of consecutive images, which see the same edges.
    double squares = 0.0;
    for (int group = 0; group < kGroups; ++group) {
      double unused = 0.0;
      const double difference = Best(group, &unused) - latency.seconds;
      squares += difference * difference;
    }
    latency.sigma = std::hypot(std::sqrt(squares * (kGroups - 1.0) / kGroups), 0.5 * kStep);
    return latency;
  }

 private:
  struct Sample {
    const EdgeAlignment* edges;
    Eigen::Vector2d velocity;  // pixels/second
    double delay;              // seconds, as the stamps say
  };

  static constexpr int kGroups = 8;
  static constexpr double kStep = 0.005, kReach = 0.25;  // seconds

  double Total(int left_out, double latency, const Eigen::Vector2d& shift) const {
    double sum = 0.0;
    for (size_t i = 0; i < samples_.size(); ++i) {
      if (static_cast<int>(i * kGroups / samples_.size()) == left_out) continue;
      const Sample& sample = samples_[i];
      // Depth that is taken later shows the scene further along: its edges must be moved back.
      sum += ScoreAt(sample.edges->coarse, shift - (latency + sample.delay) * sample.velocity);
    }
    return sum / num_edges_;
  }

  // The peak of the sum of all scores without latency.
  Eigen::Vector2d CommonShift() const {
    EdgeAlignment sum;
    for (const Sample& sample : samples_) Add(*sample.edges, &sum);
    return FindPeak(sum).shift;
  }

  // Climbs from `shift` to the best shift, given the latency.
  Eigen::Vector2d Climb(double latency, Eigen::Vector2d shift) const {
    for (const double step : {4.0, 2.0, 1.0}) {
      for (bool improves = true; improves;) {
        improves = false;
        for (const Eigen::Vector2d& move :
             {Eigen::Vector2d(step, 0.0), Eigen::Vector2d(-step, 0.0), Eigen::Vector2d(0.0, step),
              Eigen::Vector2d(0.0, -step)}) {
          if (Total(-1, latency, shift + move) <= Total(-1, latency, shift) + 1e-9) continue;
          shift += move;
          improves = true;
        }
      }
    }
    return shift;
  }

  // The best latency. Of all images, both explanations are tried first: a shift of its own, and a
  // latency alone. In uniform motion the two are alike.
  double Best(int left_out, double* gain) {
    if (left_out >= 0) return Scan(left_out);
    const Eigen::Vector2d common = CommonShift();
    const double none = Total(-1, 0.0, common);
    double best = 0.0;
    agreement_ = -1e9;
    for (const Eigen::Vector2d& start : {common, Eigen::Vector2d(0.0, 0.0)}) {
      shift_ = start;
      shift_ = Climb(Scan(-1), start);
      const double latency = Scan(-1);
      const double agreement = Total(-1, latency, shift_);
      if (agreement <= agreement_) continue;
      agreement_ = agreement;
      best = latency;
      best_shift_ = shift_;
    }
    shift_ = best_shift_;
    *gain = agreement_ / std::max(1e-3, none);
    return best;
  }

  double Scan(int left_out) const {
    const int steps = static_cast<int>(std::lround(kReach / kStep));
    double best = -1e9, best_latency = 0.0;
    for (int i = -steps; i <= steps; ++i) {
      const double score = Total(left_out, i * kStep, shift_);
      if (score > best) {
        best = score;
        best_latency = i * kStep;
      }
    }
    return best_latency;
  }

  std::vector<Sample> samples_;
  double num_edges_ = 0.0;
  Eigen::Vector2d shift_ = Eigen::Vector2d::Zero();       // pixels
  Eigen::Vector2d best_shift_ = Eigen::Vector2d::Zero();  // pixels
  double agreement_ = 0.0;
};

}  // namespace

void AddFrameMotionFindings(const MotionTrack& track, int width, Findings* findings) {
  if (track.num_images == 0) return;
  std::vector<double> displacements;
  for (const MotionImage& image : track.images) {
    if (image.linked) displacements.push_back(image.displacement);
  }
  const auto num_tracked = static_cast<int>(track.images.size());
  const double tracked = static_cast<double>(num_tracked) / track.num_images;
  if (tracked < kMinTrackedRatio) {
    findings->push_back(
        Warning("motion.matching",
                FormatText("only %d of %d images can be tracked", num_tracked, track.num_images),
                "slower motion, a higher frame rate, more light or more texture",
                Measurement{tracked, "ratio"}));
  }
  if (displacements.empty()) return;
  const double median = Median(displacements);
  const double high = Quantile(0.9, displacements);
  const std::string text = FormatText(
      "motion: features move by %.1f px from image to image (median; %.1f px in one of "
      "ten)",
      median, high);
  const Measurement measurement{high, "px"};
  if (high <= kMaxDisplacement * width) {
    findings->push_back(Good("motion.frame_rate", text, measurement));
    return;
  }
  findings->push_back(Warning("motion.frame_rate", text,
                              "the frame rate is low for this motion: record more frames per "
                              "second, move more slowly, or shorten the exposure",
                              measurement));
}

void AddLatencyFindings(const MotionTrack& track, Findings* findings) {
  LatencyEstimator estimator(track);
  const std::string check = "stamps.depth_latency";
  if (estimator.size() < kMinImages) {
    findings->push_back(Good(check, "latency of depth: not tested, too few common edges"));
    return;
  }
  const Latency latency = estimator.Estimate();
  const double seconds = latency.seconds;
  if (latency.sigma > kMaxLatencySigma || estimator.Agreement() < kMinAgreement) {
    findings->push_back(
        Good(check, FormatText("latency of depth: not tested, little motion or few common edges "
                               "(+- %.0f ms)",
                               1e3 * latency.sigma)));
    return;
  }
  const std::string text = FormatText(
      "depth is taken %.0f +- %.0f ms %s than its time stamps say (agreement of the edges %.2f "
      "times that without latency)",
      1e3 * std::abs(seconds), 1e3 * latency.sigma, seconds > 0.0 ? "later" : "earlier",
      latency.gain);
  const Measurement measurement{seconds, "s"};
  if (std::abs(seconds) <= kMaxLatency || std::abs(seconds) <= kFindingSigmas * latency.sigma ||
      latency.gain < kMinGain) {
    findings->push_back(Good(check, text, measurement));
    return;
  }
  findings->push_back(Warning(
      check, text,
      FormatText("%s %.3f s %s the stamps in the list of depth images and pair anew (remove "
                 "associations.txt)",
                 seconds > 0.0 ? "add" : "subtract", std::abs(seconds),
                 seconds > 0.0 ? "to" : "from"),
      measurement));
}

void AddNoiseFindings(const MotionTrack& track, Findings* findings) {
  const std::string check = "depth.noise";
  double largest = 0.0, smallest = NoiseEstimator::kMaxScale;
  for (const NoiseScale& scale : track.noise_scales) {
    largest = std::max({largest, scale.point_depth, scale.line_depth});
    smallest = std::min({smallest, scale.point_depth, scale.line_depth});
  }
  if (track.noise_scales.empty()) return;
  const std::string text = FormatText(
      "errors of depth are %.2f to %.2f times those that the options expect", smallest, largest);
  const Measurement measurement{largest, "ratio"};
  if (largest < NoiseEstimator::kMaxScale) {
    const bool at_bound = smallest <= 1.0 / NoiseEstimator::kMaxScale;
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
