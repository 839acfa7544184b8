// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/place_verification.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "msc_vo/geometry/plane.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/free_space.h"

namespace msc_vo {

namespace {

using Positions = std::vector<Eigen::Vector3d>;  // of landmarks, metres, world

Positions MatchedPositions(const FrameMatches& matches, const Map& map) {
  Positions positions;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const auto& match : OfKind<L>(matches)) {
      if (const L* landmark = map.Find<L>(match.id)) positions.push_back(landmark->Center());
    }
  });
  return positions;
}

bool IsOffPlane(const Plane& plane, const Eigen::Vector3d& camera,
                const Eigen::Vector3d& position) {
  // Relative to the distance from the camera: three sigmas of depth (2e-3 1/m) at 5 m.
  constexpr double kTolerance = 0.03;
  return std::abs(plane.normal().dot(position) + plane.offset()) >
         kTolerance * (position - camera).norm();
}

int NumOffPlane(const Plane& plane, const Eigen::Vector3d& camera, const Positions& positions) {
  const auto is_off = [&](const Eigen::Vector3d& x) { return IsOffPlane(plane, camera, x); };
  return static_cast<int>(std::count_if(positions.begin(), positions.end(), is_off));
}

// Whether a map has at least `num` landmarks off a plane.
bool ExtendsBeyond(const Plane& plane, const Eigen::Vector3d& camera, const Map& map, int num) {
  int num_off = 0;
  ForEachLandmarkKind([&](auto kind) {
    for (const auto& [id, landmark] : map.landmarks<typename decltype(kind)::Landmark>()) {
      if (num_off >= num) return;
      if (IsOffPlane(plane, camera, landmark.Center())) ++num_off;
    }
  });
  return num_off >= num;
}

// The plane through three of the positions that has the fewest of them off it, and their number.
struct DominantPlane {
  Plane plane;
  int num_off = 0;
};

// None if no three of the drawn positions span a plane. They must not be empty.
std::optional<DominantPlane> FindDominantPlane(const Positions& positions,
                                               const Eigen::Vector3d& camera) {
  constexpr int kNumTrials = 20;  // one is nearly enough if nearly all are coplanar
  std::mt19937 random(1);
  const auto draw = [&]() -> const Eigen::Vector3d& {
    return positions[random() % positions.size()];
  };
  std::optional<DominantPlane> best;
  for (int trial = 0; trial < kNumTrials; ++trial) {
    const Eigen::Vector3d &a = draw(), &b = draw(), &c = draw();
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    if (!(normal.norm() > 0.0)) continue;  // collinear
    const Plane plane(normal, -normal.dot(a));
    const int num = NumOffPlane(plane, camera, positions);
    if (!best || num < best->num_off) best = {plane, num};
  }
  return best;
}

struct View {
  const Frame* frame = nullptr;
  Rigid3 cam_from_world;
};

// Appends a keyframe and those that share landmarks with it, most first.
void AppendViewsAround(const Map& map, KeyframeId reference, std::vector<View>* views) {
  constexpr size_t kMaxViews = 10;  // bounds the cost
  const auto append = [&](KeyframeId id) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    views->push_back({keyframe.frame.get(), keyframe.cam_from_world});
  };
  append(reference);
  for (const Map::Covisible& covisible : map.FindCovisible(reference)) {
    if (views->size() >= kMaxViews) return;
    append(covisible.keyframe);
  }
}

// Orders views by their similarity: the angle between them, and their distance relative to that of
// surfaces in a room.
double Difference(const View& a, const View& b) {
  constexpr double kSurfaceDistance = 2.0;  // metres
  const Rigid3 b_from_a = b.cam_from_world * a.cam_from_world.Inverse();
  return LogSO3(b_from_a.rotation()).norm() + b_from_a.translation().norm() / kSurfaceDistance;
}

}  // namespace

bool IsCoplanar(const Revisit& found, const Map& map, int min_matches) {
  // With few matches, fewer than min_matches are off any plane through three of them. Of random
  // positions in a room, less than a quarter are off the dominant plane in 6 % of the cases with
  // six positions, and in less than 1 % with eight or more.
  constexpr double kMaxOffRatio = 0.25;
  const Positions positions = MatchedPositions(found.matches, map);
  if (positions.empty()) return false;
  const Rigid3 cam_from_world = found.cam_from_reference * map.CamFromWorld(found.reference);
  const Eigen::Vector3d camera = cam_from_world.OriginInSource();
  const std::optional<DominantPlane> found_plane = FindDominantPlane(positions, camera);
  if (!found_plane) return true;  // collinear
  const auto& [plane, num_off] = *found_plane;
  const bool is_coplanar =
      num_off < min_matches && num_off < kMaxOffRatio * static_cast<double>(positions.size());
  return is_coplanar && ExtendsBeyond(plane, camera, map, min_matches);
}

bool ContradictsSurfaces(const TrackedFrame& tracked, const Map& own, const Revisit& found,
                         const Map& map) {
  // Twice the largest ratio of true revisits, in both directions (docs/lab/loops.md).
  constexpr double kMaxRatio = 0.01;
  constexpr int kMinViolations = 10;  // of all views; matters where few cells can be compared
  std::vector<View> views{{tracked.frame.get(), tracked.cam_from_world}}, place;
  if (own.FindKeyframe(tracked.reference) != nullptr) {
    AppendViewsAround(own, tracked.reference, &views);
  }
  AppendViewsAround(map, found.reference, &place);
  const Rigid3 found_from_world = found.cam_from_reference * map.CamFromWorld(found.reference);
  const Rigid3 own_from_world = tracked.cam_from_world.Inverse() * found_from_world;
  SurfaceAgreement sum;
  for (View view : views) {
    view.cam_from_world = view.cam_from_world * own_from_world;
    const View& nearest = *std::min_element(
        place.begin(), place.end(),
        [&](const View& a, const View& b) { return Difference(a, view) < Difference(b, view); });
    const SurfaceAgreement agreement = CompareSurfaces(
        *nearest.frame, *view.frame, view.cam_from_world * nearest.cam_from_world.Inverse());
    sum.num_same += agreement.num_same;
    sum.num_violations += agreement.num_violations;
  }
  return sum.num_violations >= kMinViolations &&
         sum.num_violations > kMaxRatio * (sum.num_same + sum.num_violations);
}

}  // namespace msc_vo
