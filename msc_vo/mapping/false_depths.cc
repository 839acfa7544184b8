// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/false_depths.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/mapping/depth_excess.h"
#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {

namespace {

// Cells of the image. Chosen by measurement, see docs/lab/depth.md.
constexpr int kColumns = 6, kRows = 4;
// Points of a cell, so that one wrong match does not decide, and cells of an image: a quarter.
constexpr size_t kMinPoints = 3, kMinCells = 6;
// Prior probability of a false depth, and the largest excess. Larger excesses than 0.5 were
// measured and add false alarms, see docs/lab/depth.md; the prior counts by its logarithm only.
constexpr double kPrior = 0.02, kMaxExcess = 0.5;
// Largest standard deviation of an excess that is used: beyond, the parallax is that of noise.
constexpr double kMaxSigma = 0.1;
// Least standard deviation of the excess of a surface: a centimetre at 3 m, as depth and poses err.
constexpr double kMinSpread = 0.003;

template <typename L>
struct LandmarkExcess {
  LandmarkId id = kNoId;
  DepthExcess excess;
};

// What is in a cell of the image.
struct Cell {
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
    std::sort(ascending.begin(), ascending.end(), [](const DepthExcess& a, const DepthExcess& b) {
      return std::tie(a.value, a.variance) < std::tie(b.value, b.variance);
    });
    size_t middle = 0;
    for (double sum = 1.0 / ascending[0].variance;
         sum < 0.5 * weights && middle + 1 < ascending.size();
         sum += 1.0 / ascending[middle].variance) {
      ++middle;
    }
    constexpr double kVarianceOfMedian = kPi / 2.0;  // relative to that of the mean
    return DepthExcess{ascending[middle].value, kVarianceOfMedian / weights};
  }
};

// Adds the landmarks of a kind that project into the image of a keyframe, observed there or not,
// and whose excess is known well enough.
template <typename L>
void AddLandmarks(const WindowData& window, const Keyframe& keyframe, const NoiseScale& scale,
                  const Map& map, std::vector<Cell>* cells) {
  const PinholeCamera& camera = keyframe.frame->camera;
  const ImageGrid grid(kColumns, kRows, camera);
  for (const auto& in_window : OfKind<L>(window)) {
    const L* landmark = map.Find<L>(in_window.id);
    if (landmark == nullptr) continue;
    const Eigen::Vector3d in_cam = keyframe.cam_from_world * landmark->Center();
    if (!IsInFront(in_cam)) continue;
    const Eigen::Vector2d pixel = camera.Project(in_cam);
    if (!(pixel.x() >= 0.0 && pixel.x() < camera.width)) continue;
    if (!(pixel.y() >= 0.0 && pixel.y() < camera.height)) continue;
    const std::optional<DepthExcess> excess = MeasureDepthExcess(map, *landmark, scale);
    if (!excess || !(std::abs(excess->value) < kMaxExcess)) continue;
    if (!(excess->variance < kMaxSigma * kMaxSigma)) continue;
    OfKind<L>((*cells)[grid.CellOf(pixel)]).push_back({landmark->id, *excess});
  }
}

// Normal distribution of the excess of true depths.
class TrueDepths {
 public:
  // Estimated by the shortest interval that contains more than half of the cells, since false
  // depths lie to one side.
  explicit TrueDepths(const std::vector<DepthExcess>& cells) {
    constexpr double kSigmaPerHalfWidth = 1.4826;  // of a normal distribution
    std::vector<double> values, variances;
    for (const DepthExcess& cell : cells) {
      values.push_back(cell.value);
      variances.push_back(cell.variance);
    }
    std::sort(values.begin(), values.end());
    std::sort(variances.begin(), variances.end());
    const size_t half = values.size() / 2;
    size_t best = 0;
    for (size_t i = 0; i + half < values.size(); ++i) {
      if (values[i + half] - values[i] < values[best + half] - values[best]) best = i;
    }
    mean_ = 0.5 * (values[best] + values[best + half]);
    const double sigma = kSigmaPerHalfWidth * 0.5 * (values[best + half] - values[best]);
    variance_ = std::max(sigma * sigma - variances[half], kMinSpread * kMinSpread);
  }

  // Whether the excess is likelier under a uniform density up to kMaxExcess than under that of true
  // depths.
  bool Exclude(const DepthExcess& excess) const {
    const double difference = excess.value - mean_;
    const double variance = variance_ + excess.variance;
    if (difference <= 0.0) return false;
    const double log_true =
        -0.5 * difference * difference / variance - 0.5 * std::log(2.0 * kPi * variance);
    return std::log(kPrior / (1.0 - kPrior)) - std::log(kMaxExcess) > log_true;
  }

 private:
  double mean_ = 0.0;      // the error of the scale of the translation
  double variance_ = 0.0;  // between surfaces
};

}  // namespace

void FindFalseDepths(const WindowData& window, KeyframeId newest, const NoiseScale& scale,
                     Map* map) {
  std::vector<Cell> cells(kColumns * kRows);
  ForEachLandmarkKind([&](auto kind) {
    AddLandmarks<typename decltype(kind)::Landmark>(window, *map->FindKeyframe(newest), scale, *map,
                                                    &cells);
  });
  std::vector<std::optional<DepthExcess>> summaries;
  std::vector<DepthExcess> known;
  for (const Cell& cell : cells) {
    summaries.push_back(cell.Summary());
    if (summaries.back()) known.push_back(*summaries.back());
  }
  if (known.size() < kMinCells) return;
  const TrueDepths true_depths(known);
  for (size_t i = 0; i < cells.size(); ++i) {
    const bool is_false = summaries[i] && true_depths.Exclude(*summaries[i]);
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      for (const auto& [id, excess] : OfKind<L>(cells[i])) {
        map->SetHasFalseDepth<L>(id, is_false || true_depths.Exclude(excess));
      }
    });
  }
}

}  // namespace msc_vo
