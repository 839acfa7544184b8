// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/keyframe_policy.h"

#include <algorithm>
#include <vector>

namespace msc_vo {

namespace {

// Longest time between two frames that counts towards the intervals of keyframes, seconds: the
// first frame after a gap, whose pose is uncertain, is no keyframe because of the gap alone.
constexpr double kMaxFrameInterval = 0.5;
// A point is close if the standard deviation of its depth is below this fraction of the depth
// (0.5 %: 3.5 m for a Kinect). Close points determine the translation, so that their ratio is
// tested separately too.
constexpr double kCloseRelativeSigma = 0.005;

bool IsClose(const PointFeature& point) {
  // Relative error of the depth z = 1/w: sigma_z / z = sigma_w / w.
  return point.HasDepth() && point.inverse_depth_sigma < kCloseRelativeSigma * point.inverse_depth;
}
// Features of other kinds have no close ones.
template <typename F>
bool IsClose(const F& /*feature*/) {
  return false;
}

}  // namespace

KeyframePolicy::TrackedRatios KeyframePolicy::ComputeRatios(const Frame& frame,
                                                            const FrameMatches& matches) const {
  struct Count {
    int tracked = 0;
    int creatable = 0;
    double Ratio() const {
      return tracked + creatable == 0 ? 1.0 : tracked / static_cast<double>(tracked + creatable);
    }
  };
  Count all;
  Count close;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const auto& features = FeaturesOf<L>(frame);
    std::vector<bool> is_tracked(features.size(), false);
    for (const auto& match : OfKind<L>(matches)) is_tracked[match.feature] = match.inlier;
    for (size_t i = 0; i < features.size(); ++i) {
      if (!features[i].HasDepth() && !is_tracked[i]) continue;
      ++(is_tracked[i] ? all.tracked : all.creatable);
      if (IsClose(features[i])) ++(is_tracked[i] ? close.tracked : close.creatable);
    }
  });
  return {all.Ratio(), close.Ratio()};
}

bool KeyframePolicy::IsDue(const Frame& frame, const FrameMatches& matches, bool certain) {
  const TrackedRatios ratios = ComputeRatios(frame, matches);
  best_.all = std::max(best_.all, ratios.all);
  best_.close = std::max(best_.close, ratios.close);
  seconds_since_keyframe_ += std::min(frame.timestamp - last_frame_time_, kMaxFrameInterval);
  last_frame_time_ = frame.timestamp;
  if (seconds_since_keyframe_ < options_.min_interval) return false;
  // The best ratio is zero as well if no frame since the last keyframe has a feature in the map.
  const bool is_new = !certain && ratios.all == 0.0;
  return is_new || (certain && seconds_since_keyframe_ >= options_.max_interval) ||
         ratios.all < options_.min_tracked_ratio * best_.all ||
         ratios.close < options_.min_tracked_ratio * best_.close;
}

void KeyframePolicy::Inserted(double timestamp) {
  last_frame_time_ = timestamp;
  seconds_since_keyframe_ = 0.0;
  best_ = {0.0, 0.0};
}

}  // namespace msc_vo
