// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <type_traits>
#include <vector>

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

/// The member for a kind of a struct that has one for each: `points`, `lines`. The struct may be
/// const.
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

  bool operator==(const PerKind& other) const {
    return points == other.points && lines == other.lines;
  }
};

/// One T<L> for each kind L.
template <template <typename L> class T>
struct ByKind {
  T<PointLandmark> points;
  T<LineLandmark> lines;

  template <typename L>
  T<L>& Of() {
    return OfKind<L>(*this);
  }
  template <typename L>
  const T<L>& Of() const {
    return OfKind<L>(*this);
  }
};

/// The features of a kind in a frame.
template <typename L>
const std::vector<typename L::Feature>& FeaturesOf(const Frame& frame) {
  return OfKind<L>(frame);
}

/// Numbers of elements of a struct that has a vector for each kind.
template <typename Kinds>
PerKind<int> SizesOf(const Kinds& kinds) {
  PerKind<int> sizes;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    sizes.Of<L>() = static_cast<int>(OfKind<L>(kinds).size());
  });
  return sizes;
}

/// Sum over the kinds.
inline int Sum(const PerKind<int>& counts) {
  int sum = 0;
  ForEachLandmarkKind([&](auto kind) { sum += counts.Of<typename decltype(kind)::Landmark>(); });
  return sum;
}

/// Number of points that support a pose as well as these landmarks do.
inline int Support(const PerKind<int>& counts) {
  int support = 0;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    support += L::kSupport * counts.Of<L>();
  });
  return support;
}

}  // namespace msc_vo
