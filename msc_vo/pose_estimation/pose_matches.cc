// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_matches.h"

#include <algorithm>
#include <utility>

#include "msc_vo/geometry/quantile.h"

namespace msc_vo {

namespace {

template <typename Match>
InlierMask Classify(const PoseOptions& options, const PinholeCamera& camera, const Rigid3& pose,
                    const Match& match) {
  const auto in_cam = InCamera(pose, match);
  if (match.dynamic || !IsInFront(in_cam)) return {};
  const bool has_depth = HasDepth(options, match);
  const double pixels =
      HasReprojection(options, match) ? PixelChiSquare(camera, match, in_cam) : 0.0;
  const double depth = has_depth ? DepthChiSquare(camera, match, in_cam) : 0.0;
  InlierMask mask =
      TestChiSquare(pixels, depth, options.reject_chi2_2, LimitWithDepth(options, match));
  mask.depth = mask.depth && has_depth;
  return mask;
}

// Ratio of the median squared residual of the frame's points to its expectation, clamped to
// [1, max_frame_noise^2]: the variance inflation of a blurred image.
double SquaredFrameNoise(const PoseOptions& options, const PoseData& data, const Rigid3& pose) {
  std::vector<double> chi2;
  chi2.reserve(data.points.size());
  for (const PoseData::Point& p : data.points) {
    if (IsInFront(pose * p.position)) chi2.push_back(PixelChiSquare(data.camera, pose, p));
  }
  return std::clamp(MedianChiSquareRatio(std::move(chi2)), 1.0,
                    options.max_frame_noise * options.max_frame_noise);
}

}  // namespace

double MedianChiSquareRatio(std::vector<double> chi2) {
  constexpr size_t kMinValues = 10;
  constexpr double kChiSquareMedian2 = 1.386;
  if (chi2.size() < kMinValues) return 1.0;
  return UpperMedian(std::move(chi2)) / kChiSquareMedian2;
}

PoseInlierMask AllInFront(const PoseOptions& options, const PoseData& data, const Rigid3& pose) {
  PoseInlierMask all;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : OfKind<L>(data)) {
      const bool in_front = IsInFront(InCamera(pose, match));
      all.Of<L>().push_back({in_front, in_front && HasDepth(options, match)});
    }
  });
  return all;
}

PoseInlierMask ClassifyMatches(PoseOptions options, const PoseData& data, const Rigid3& pose) {
  const double noise2 = SquaredFrameNoise(options, data, pose);
  for (double* limit : {&options.reject_chi2_2, &options.reject_chi2_3, &options.reject_chi2_4}) {
    *limit *= noise2;
  }
  PoseInlierMask result;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : OfKind<L>(data)) {
      result.Of<L>().push_back(Classify(options, data.camera, pose, match));
    }
  });
  return result;
}

void SetLosses(const PoseOptions& options, PoseFactors* factors) {
  ForEachLandmarkKind([&](auto kind) { SetLosses(kind, options, factors); });
}

PoseFactors BuildFactors(const PoseOptions& options, const PoseData& data,
                         const PoseInlierMask& mask, const Rigid3& pose, bool robust) {
  PoseFactors factors;
  if (robust) SetLosses(options, &factors);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const auto& matches = OfKind<L>(data);
    for (size_t i = 0; i < matches.size(); ++i) {
      AddFactors(options, data.camera, matches[i], mask.Of<L>()[i], pose, &factors);
    }
  });
  factors.custom = data.custom_factors;
  return factors;
}

}  // namespace msc_vo
