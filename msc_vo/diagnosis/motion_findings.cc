// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_findings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Displacement from image to image, as a fraction of the width, that tracking bridges easily.
constexpr double kMaxDisplacement = 0.06;
constexpr double kMinLinkedRatio = 0.8;

// Latency that warrants a warning, seconds, and the standard deviations that it must exceed.
constexpr double kMaxLatency = 0.02;
constexpr double kMaxLatencySigma = 0.02;
constexpr double kSigmas = 4.0;
constexpr int kMinEdges = 100;
constexpr double kMinAgreement = 0.2;
constexpr size_t kMinImages = 15;

// One component of the shift of an image, and the velocity of the image along it.
struct ShiftSample {
  double velocity;  // pixels/second
  double shift;     // pixels
  int axis;         // 0: x, 1: y
};

struct Latency {
  double seconds = 0.0;
  double sigma = 0.0;
};

// Fits shift = offset of the axis + latency * velocity with Cauchy weights.
Latency FitLatency(const std::vector<ShiftSample>& samples) {
  Eigen::Vector3d solution = Eigen::Vector3d::Zero();
  Eigen::Matrix3d matrix;
  double scale = 1.0;
  for (int iteration = 0; iteration < 20; ++iteration) {
    std::vector<double> errors;
    for (const ShiftSample& s : samples) {
      errors.push_back(std::abs(s.shift - solution(s.axis) - solution(2) * s.velocity));
    }
    scale = std::max(0.3, 1.48 * Median(errors));
    matrix = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < samples.size(); ++i) {
      const double relative = errors[i] / (2.0 * scale);
      const double weight = 1.0 / (1.0 + relative * relative);
      Eigen::Vector3d row = Eigen::Vector3d::Zero();
      row(samples[i].axis) = 1.0;
      row(2) = samples[i].velocity;
      matrix += weight * row * row.transpose();
      right += weight * samples[i].shift * row;
    }
    solution = matrix.ldlt().solve(right);
  }
  const Eigen::Vector3d column = matrix.ldlt().solve(Eigen::Vector3d::UnitZ());
  // Consecutive images see the same edges: count about three of them as one.
  return {solution(2), 1.7 * scale * std::sqrt(std::max(0.0, column(2)))};
}

}  // namespace

void AddFrameMotionFindings(const MotionTrack& track, int width, Findings* findings) {
  if (track.num_pairs == 0) return;
  std::vector<double> displacements;
  for (const TrackedImage& image : track.images) {
    if (image.linked) displacements.push_back(image.displacement);
  }
  const double linked = static_cast<double>(track.num_linked) / track.num_pairs;
  if (linked < kMinLinkedRatio) {
    findings->push_back(Warning(
        "motion.matching",
        FormatText("only %d of %d consecutive images match by points", track.num_linked,
                   track.num_pairs),
        "slower motion, a higher frame rate, more light or more texture; lines (mode msc-vo) "
        "help where points are rare",
        Measurement{linked, "ratio"}));
  }
  if (displacements.empty()) return;
  const double median = Median(displacements);
  const double high = Quantile(0.9, displacements);
  const std::string text =
      FormatText("motion: features move by %.1f px from image to image (median; %.1f px in one of "
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
  std::vector<ShiftSample> samples;
  for (size_t i = 0; i + 1 < track.images.size(); ++i) {
    const TrackedImage& image = track.images[i];
    const TrackedImage& next = track.images[i + 1];
    if (!image.linked || !next.linked || image.num_edges < kMinEdges ||
        image.shift.peak - image.shift.background < kMinAgreement) {
      continue;
    }
    const Eigen::Vector2d velocity = 0.5 * (image.velocity + next.velocity);
    for (int axis = 0; axis < 2; ++axis) {
      samples.push_back({velocity(axis), image.shift.shift(axis), axis});
    }
  }
  const std::string check = "stamps.depth_latency";
  if (samples.size() < 2 * kMinImages) {
    findings->push_back(Good(check, "latency of depth: not tested, too few common edges"));
    return;
  }
  const Latency latency = FitLatency(samples);
  // Depth that is taken later shows the scene further along: its edges must be moved back.
  const double seconds = -latency.seconds;
  if (latency.sigma > kMaxLatencySigma) {
    findings->push_back(Good(check,
                             FormatText("latency of depth: not tested, the camera moves too little "
                                        "(+- %.0f ms)",
                                        1e3 * latency.sigma)));
    return;
  }
  const std::string text =
      FormatText("depth is taken %.0f +- %.0f ms %s than the colour image of its pair",
                 1e3 * std::abs(seconds), 1e3 * latency.sigma, seconds > 0.0 ? "later" : "earlier");
  const Measurement measurement{seconds, "s"};
  if (std::abs(seconds) <= kMaxLatency || std::abs(seconds) <= kSigmas * latency.sigma) {
    findings->push_back(Good(check, text, measurement));
    return;
  }
  findings->push_back(
      Warning(check, text,
              FormatText("%s %.3f s %s the stamps in the list of depth images and pair anew (remove "
                         "associations.txt)",
                         seconds > 0.0 ? "add" : "subtract", std::abs(seconds),
                         seconds > 0.0 ? "to" : "from"),
              measurement));
}

}  // namespace msc_vo
