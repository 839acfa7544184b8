// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <type_traits>
#include <vector>

#include "msc_vo/map/keyframe.h"
#include "msc_vo/map/line_landmark.h"
#include "msc_vo/map/point_landmark.h"

namespace msc_vo {

/// The list of the kinds of landmarks: where each has its features in a frame and its landmarks in
/// a keyframe.
template <typename L>
struct LandmarkKind;

template <>
struct LandmarkKind<PointLandmark> {
  using Landmark = PointLandmark;
  static constexpr auto kFeatures = &Frame::points;
  static constexpr auto kSlots = &Keyframe::points;
};

template <>
struct LandmarkKind<LineLandmark> {
  using Landmark = LineLandmark;
  static constexpr auto kFeatures = &Frame::lines;
  static constexpr auto kSlots = &Keyframe::lines;
};

/// Calls visit(LandmarkKind<L>()) for every kind L, always in the same order.
template <typename Visit>
void ForEachLandmarkKind(const Visit& visit) {
  visit(LandmarkKind<PointLandmark>());
  visit(LandmarkKind<LineLandmark>());
}

/// One value for each kind.
template <typename T>
struct PerKind {
  T points{};
  T lines{};

  template <typename L>
  T& Of() {
    if constexpr (std::is_same_v<L, PointLandmark>) {
      return points;
    } else {
      static_assert(std::is_same_v<L, LineLandmark>);
      return lines;
    }
  }
  template <typename L>
  const T& Of() const {
    return const_cast<PerKind*>(this)->template Of<L>();
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, points, lines);
  }
};

/// The features of a kind in a frame.
template <typename L>
const std::vector<typename L::Feature>& FeaturesOf(const Frame& frame) {
  return frame.*LandmarkKind<L>::kFeatures;
}

/// The landmarks that a keyframe observes, one per feature; kNoId: none.
template <typename L>
const std::vector<LandmarkId>& SlotsOf(const Keyframe& keyframe) {
  return keyframe.*LandmarkKind<L>::kSlots;
}

}  // namespace msc_vo
