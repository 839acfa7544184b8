// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/false_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/mapping/depth_excess.h"

namespace msc_vo {

namespace {

// The image is divided into parts. Chosen by measurement, see docs/lab/depth.md.
constexpr int kColumns = 6, kRows = 4;
// Points that a part needs, and parts that an image needs.
constexpr size_t kMinPoints = 3, kMinParts = 6;
// Ratio of false depths, and their largest excess.
constexpr double kPrior = 0.02, kMaxExcess = 0.5;
// Standard deviation of an excess that still tells something.
constexpr double kMaxSigma = 0.1;
// Least standard deviation of the excess of a surface: its depth and the poses err as well.
constexpr double kMinSpread = 0.003;

template <typename L>
struct LandmarkExcess {
  LandmarkId id = kNoId;
  DepthExcess excess;
};

// What is in a part of the image.
struct Part {
  std::vector<LandmarkExcess<PointLandmark>> points;
  std::vector<LandmarkExcess<LineLandmark>> lines;

  // The weighted median of its points, since some matches are wrong; std::nullopt with too few.
  std::optional<DepthExcess> Summary() const {
    if (points.size() < kMinPoints) return std::nullopt;
    std::vector<DepthExcess> ascending;
    double weights = 0.0;
    for (const auto& [id, excess] : points) {
      ascending.push_back(excess);
      weights += 1.0 / excess.variance;
    }
    std::sort(ascending.begin(), ascending.end(),
              [](const DepthExcess& a, const DepthExcess& b) { return a.value < b.value; });
    size_t middle = 0;
    for (double sum = 1.0 / ascending[0].variance;
         sum < 0.5 * weights && middle + 1 < points.size();
         sum += 1.0 / ascending[middle].variance) {
      ++middle;
    }
    constexpr double kVarianceOfMedian = M_PI / 2.0;  // relative to that of the mean
    return DepthExcess{ascending[middle].value, kVarianceOfMedian / weights};
  }
};
using Parts = std::array<Part, kColumns * kRows>;

// The part of the image in which a keyframe shows a point of the world.
std::optional<size_t> PartOf(const Keyframe& keyframe, const Eigen::Vector3d& position) {
  const PinholeCamera& camera = keyframe.frame->camera;
  const Eigen::Vector3d in_cam = keyframe.cam_from_world * position;
  if (!IsInFront(in_cam)) return std::nullopt;
  const Eigen::Vector2d pixel = camera.Project(in_cam);
  const double column = std::floor(pixel.x() * kColumns / camera.width);
  const double row = std::floor(pixel.y() * kRows / camera.height);
  if (!(column >= 0.0 && column < kColumns && row >= 0.0 && row < kRows)) return std::nullopt;
  return static_cast<size_t>(row * kColumns + column);
}

template <typename L>
void AddLandmarks(const Map& map, const WindowData& window, const Keyframe& newest,
                  const NoiseScale& scale, Parts* parts) {
  for (const auto& in_window : OfKind<L>(window)) {
    const L* landmark = map.Find<L>(in_window.id);
    if (landmark == nullptr) continue;
    const std::optional<size_t> part = PartOf(newest, landmark->Center());
    if (!part) continue;
    const std::optional<DepthExcess> excess = MeasureDepthExcess(map, *landmark, scale);
    if (!excess || std::abs(excess->value) > kMaxExcess) continue;
    if (excess->variance < kMaxSigma * kMaxSigma) {
      OfKind<L>((*parts)[*part]).push_back({landmark->id, *excess});
    }
  }
}

// The excess of measurements that are not false.
class TrueDepths {
 public:
  // The shortest interval that contains half of the parts, since false ones lie to one side.
  explicit TrueDepths(const std::vector<DepthExcess>& parts) {
    constexpr double kSigmaPerHalfWidth = 1.4826;  // of a normal distribution
    std::vector<double> values, variances;
    for (const DepthExcess& part : parts) {
      values.push_back(part.value);
      variances.push_back(part.variance);
    }
    std::sort(values.begin(), values.end());
    std::sort(variances.begin(), variances.end());
    const size_t half = values.size() / 2;
    size_t best = 0;
    for (size_t i = 0; i + half < values.size(); ++i) {
      if (values[i + half] - values[i] < values[best + half] - values[best]) best = i;
    }
    common_ = 0.5 * (values[best] + values[best + half]);
    const double sigma = kSigmaPerHalfWidth * 0.5 * (values[best + half] - values[best]);
    variance_ = std::max(sigma * sigma - variances[half], kMinSpread * kMinSpread);
  }

  // Whether an excess that may have any value up to the largest is likelier than one of these.
  bool Exclude(const DepthExcess& excess) const {
    const double difference = excess.value - common_;
    const double variance = variance_ + excess.variance;
    if (difference <= 0.0) return false;
    const double log_true =
        -0.5 * difference * difference / variance - 0.5 * std::log(2.0 * M_PI * variance);
    return std::log(kPrior / (1.0 - kPrior)) - std::log(kMaxExcess) > log_true;
  }

 private:
  double common_ = 0.0;    // of all: a wrong length of the motion
  double variance_ = 0.0;  // of surfaces
};

}  // namespace

void FindFalseDepths(const WindowData& window, KeyframeId newest, const NoiseScale& scale,
                     Map* map) {
  const Keyframe& keyframe = *map->FindKeyframe(newest);
  Parts parts;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    AddLandmarks<L>(*map, window, keyframe, scale, &parts);
  });
  std::vector<DepthExcess> summaries;
  for (const Part& part : parts) {
    if (const auto summary = part.Summary()) summaries.push_back(*summary);
  }
  if (summaries.size() < kMinParts) return;
  const TrueDepths true_depths(summaries);
  for (const Part& part : parts) {
    const std::optional<DepthExcess> summary = part.Summary();
    const bool is_false = summary && true_depths.Exclude(*summary);
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      for (const auto& [id, excess] : OfKind<L>(part)) {
        map->SetHasFalseDepth<L>(id, is_false || true_depths.Exclude(excess));
      }
    });
  }
}

}  // namespace msc_vo
