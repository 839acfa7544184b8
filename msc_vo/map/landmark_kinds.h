// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <type_traits>
#include <vector>

#include "msc_vo/map/keyframe.h"
#include "msc_vo/map/line_landmark.h"
#include "msc_vo/map/point_landmark.h"

namespace msc_vo {

/// A kind of landmarks, by its landmark type.
template <typename L>
struct LandmarkKind {
  using Landmark = L;
};

/// Calls visit(LandmarkKind<L>()) for every kind L, always in the same order.
template <typename Visit>
void ForEachLandmarkKind(const Visit& visit) {
  visit(LandmarkKind<PointLandmark>());
  visit(LandmarkKind<LineLandmark>());
}

/// The member for a kind of a struct that has one for each. The struct may be const.
template <typename L, typename Kinds>
auto& OfKind(Kinds& kinds) {
  if constexpr (std::is_same_v<L, PointLandmark>) {
    return kinds.points;
  } else {
    static_assert(std::is_same_v<L, LineLandmark>);
    return kinds.lines;
  }
}

/// One value for each kind.
template <typename T>
struct PerKind {
  T points{};
  T lines{};

  template <typename L>
  T& Of() {
    return OfKind<L>(*this);
  }
  template <typename L>
  const T& Of() const {
    return OfKind<L>(*this);
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, points, lines);
  }
};

/// The features of a kind in a frame.
template <typename L>
const std::vector<typename L::Feature>& FeaturesOf(const Frame& frame) {
  return OfKind<L>(frame);
}

/// The landmarks that a keyframe observes, one per feature; kNoId: none.
template <typename L>
const std::vector<LandmarkId>& SlotsOf(const Keyframe& keyframe) {
  return OfKind<L>(keyframe);
}

}  // namespace msc_vo
