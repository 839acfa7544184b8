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

// The ratio by which the depth of a landmark by parallax exceeds the measured one: 0 if they are
// equal, 0.05 if it is 5 % farther away.
struct DepthExcess {
  double value = 0.0;
  double variance = 0.0;
};

Eigen::Vector3d Scaled(const Eigen::Vector3d& point, const Eigen::Vector3d& center, double factor) {
  return center + factor * (point - center);
}
LineSegment3 Scaled(const LineSegment3& line, const Eigen::Vector3d& center, double factor) {
  return {Scaled(line.start, center, factor), Scaled(line.end, center, factor)};
}

// Error in the image, in sigmas of the feature; std::nullopt behind the camera.
std::optional<Eigen::Vector2d> PixelError(const PinholeCamera& camera, const PointFeature& feature,
                                          const Eigen::Vector3d& in_cam) {
  if (!IsInFront(in_cam)) return std::nullopt;
  return (camera.Project(in_cam) - feature.pixel) / feature.sigma;
}
std::optional<Eigen::Vector2d> PixelError(const PinholeCamera& camera, const LineFeature& feature,
                                          const LineSegment3& in_cam) {
  const std::optional<LinePart> part = ObservedPart(camera, feature.segment, in_cam);
  if (!part) return std::nullopt;
  return LineResidual(camera, feature.segment, feature.sigma, part->Of(in_cam));
}

// Depth of a landmark at the centre of a feature, metres; std::nullopt behind the camera.
std::optional<double> DepthAt(const PinholeCamera& /*camera*/, const PointFeature& /*feature*/,
                              const Eigen::Vector3d& in_cam) {
  return IsInFront(in_cam) ? std::optional(in_cam.z()) : std::nullopt;
}
std::optional<double> DepthAt(const PinholeCamera& camera, const LineFeature& feature,
                              const LineSegment3& in_cam) {
  const std::optional<LinePart> part = ObservedPart(camera, feature.segment, in_cam);
  if (!part) return std::nullopt;
  const std::optional<double> inverse =
      InverseDepthAt(camera, feature.segment, part->Of(in_cam), 0.5);
  return inverse && *inverse > 0.0 ? std::optional(1.0 / *inverse) : std::nullopt;
}

// Noise of a kind of features relative to their sigmas.
struct FeatureNoise {
  double pixel = 1.0;
  double depth = 1.0;
};
FeatureNoise NoiseOf(LandmarkKind<PointLandmark> /*kind*/, const NoiseScale& scale) {
  return {1.0, scale.point_depth};
}
FeatureNoise NoiseOf(LandmarkKind<LineLandmark> /*kind*/, const NoiseScale& scale) {
  return {scale.line_pixel, scale.line_depth};
}

// A landmark and the keyframes that observe it.
template <typename L>
class ObservedLandmark {
 public:
  ObservedLandmark(const Map& map, const L& landmark) : landmark_(landmark) {
    for (const Observation& observation : landmark.observations) {
      const Keyframe& keyframe = *map.FindKeyframe(observation.keyframe);
      views_.push_back({&keyframe, &OfKind<L>(*keyframe.frame)[observation.feature]});
      center_ += keyframe.cam_from_world.OriginInSource();
    }
    center_ /= static_cast<double>(views_.size());
  }

  // Moves the landmark along the rays from the centre of the cameras to where it fits the images
  // best.
  bool FitDistance() {
    constexpr int kIterations = 2;
    constexpr double kStep = 1e-3;  // of a difference quotient
    if (views_.size() < 2) return false;
    for (int i = 0; i < kIterations; ++i) {
      double gradient = 0.0, information = 0.0;
      for (const View& view : views_) {
        const auto nearer = ErrorAt(view, factor_ * (1.0 - kStep));
        const auto farther = ErrorAt(view, factor_ * (1.0 + kStep));
        if (!nearer || !farther) return false;
        const Eigen::Vector2d jacobian = (*farther - *nearer) / (2.0 * kStep);
        gradient += jacobian.dot(*nearer + *farther) / 2.0;
        information += jacobian.squaredNorm();
      }
      if (!(information > 0.0)) return false;
      factor_ *= std::exp(std::clamp(-gradient / information, -1.0, 1.0));
      variance_ = 1.0 / information;
    }
    return true;
  }

  std::optional<DepthExcess> CompareDepth(const FeatureNoise& noise) const {
    double sum = 0.0, weights = 0.0;
    for (const View& view : views_) {
      if (!view.feature->HasDepth()) continue;
      const std::optional<double> z =
          DepthAt(view.keyframe->frame->camera, *view.feature, InCamera(view, factor_));
      if (!z) continue;
      const double sigma = noise.depth * view.feature->CenterInverseDepthSigma() * *z;
      const double weight = 1.0 / (sigma * sigma);
      sum += weight * (view.feature->CenterInverseDepth() * *z - 1.0);
      weights += weight;
    }
    if (!(weights > 0.0)) return std::nullopt;
    return DepthExcess{sum / weights, noise.pixel * noise.pixel * variance_ + 1.0 / weights};
  }

 private:
  struct View {
    const Keyframe* keyframe;
    const typename L::Feature* feature;
  };

  // The landmark at `factor` times its distance from the centre of the cameras.
  auto InCamera(const View& view, double factor) const {
    return view.keyframe->cam_from_world * Scaled(landmark_.geometry(), center_, factor);
  }
  std::optional<Eigen::Vector2d> ErrorAt(const View& view, double factor) const {
    return PixelError(view.keyframe->frame->camera, *view.feature, InCamera(view, factor));
  }

  const L& landmark_;
  std::vector<View> views_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double factor_ = 1.0;    // of the distance from the centre
  double variance_ = 0.0;  // of its logarithm, by the sigmas of the features
};

// Triangulates the distance of a landmark from the centre of all cameras that observe it, at their
// poses in the map, without depth, and compares it with the weighted mean of the measured depths,
// LineLandmark::depth_offset not subtracted. `scale`: factors on the sigmas of the features.
// std::nullopt with one keyframe, without a measured depth, or if the landmark is not in front of
// all cameras.
template <typename L>
std::optional<DepthExcess> MeasureDepthExcess(const Map& map, const L& landmark,
                                              const NoiseScale& scale) {
  ObservedLandmark<L> observed(map, landmark);
  if (!observed.FitDistance()) return std::nullopt;
  FeatureNoise noise = NoiseOf(LandmarkKind<L>(), scale);
  noise.pixel *= landmark.noise;
  noise.depth *= landmark.noise;
  return observed.CompareDepth(noise);
}

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
