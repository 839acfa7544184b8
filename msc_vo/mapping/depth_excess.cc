// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/depth_excess.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {

namespace {

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

}  // namespace

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

template std::optional<DepthExcess> MeasureDepthExcess(const Map&, const PointLandmark&,
                                                       const NoiseScale&);
template std::optional<DepthExcess> MeasureDepthExcess(const Map&, const LineLandmark&,
                                                       const NoiseScale&);

}  // namespace msc_vo
