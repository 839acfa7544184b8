// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/plane_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "msc_vo/factors/plane_manifold.h"
#include "msc_vo/factors/plane_observation.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/matching/plane_matcher.h"
#include "msc_vo/pose_estimation/plane_factors.h"

namespace msc_vo {

namespace {

// Median of chi-square with three degrees of freedom.
constexpr double kMedianChiSquare3 = 2.366;
// Weight of a window in the learnt noise: that of the last ten windows or so.
constexpr double kLearningRate = 0.1;
// Residuals that a window needs to tell the noise.
constexpr size_t kMinResiduals = 10;
// Bounds of the learnt scale of sigmas.
constexpr double kMinNoise = 0.1, kMaxNoise = 10.0;
// Vertices of an extent: a rectangle with cut corners, and some that further views add.
constexpr size_t kMaxVertices = 16;
// Largest gap between parts of one plane that are merged, metres: two cells of the extractor at
// 4 m, less than the width of a door.
constexpr double kMaxGap = 0.3;

BlockId BlockOf(LandmarkId plane) { return BlockId::Extra(PlaneMap::kFirstBlock - 1 - plane); }
LandmarkId PlaneOf(const ExtraBlock& block) { return PlaneMap::kFirstBlock - 1 - block.id; }
bool IsPlane(const ExtraBlock& block) { return block.id < PlaneMap::kFirstBlock; }

// The planes of a keyframe, of which two features may be parts of one.
std::set<LandmarkId> DistinctPlanes(const std::vector<PlaneMatch>& matches) {
  std::set<LandmarkId> planes;
  for (const PlaneMatch& match : matches) planes.insert(match.plane);
  return planes;
}

// Squared residual of a keyframe's observation, with the sigmas of the feature; infinite if it is
// not defined.
double SquaredResidual(const PlaneFeature& feature, const Rigid3& cam_from_world,
                       const Plane& plane) {
  Eigen::Vector3d residual;
  const PlaneObservation observation(feature.inverse_depth, feature.covariance);
  return observation(cam_from_world.params.data(), plane.params.data(), residual.data())
             ? residual.squaredNorm()
             : std::numeric_limits<double>::infinity();
}

Plane InCamera(const PlaneFeature& feature) { return {feature.Normal(), feature.Distance()}; }

// Extends a plane by an extent in another frame.
void ExtendBy(const PlaneExtent& extent, const Rigid3& host_from_extent, HostedPlane* plane) {
  PlaneExtent points = host_from_extent * extent;
  points.insert(points.end(), plane->extent.begin(), plane->extent.end());
  plane->extent = ConvexHull(plane->in_host, points, kMaxVertices);
}

}  // namespace

void PlaneMap::AddKeyframe(const Map& map, KeyframeId keyframe, const PoseCovariance& covariance) {
  const Keyframe& added = *map.FindKeyframe(keyframe);
  const std::vector<PlaneFeature>& features = added.frame->planes;
  if (features.empty()) return;
  std::vector<PlaneMatch> matches =
      MatchPlanes(features, InWorld(map), added.cam_from_world,
                  CovarianceForMatching(added.cam_from_world,
                                        CovarianceOfCamera(added.cam_from_world, covariance)));
  std::vector<bool> is_known(features.size(), false);
  for (const PlaneMatch& match : matches) is_known[match.feature] = true;
  for (size_t i = 0; i < features.size(); ++i) {
    if (is_known[i]) continue;
    planes_[next_] = {keyframe, InCamera(features[i])};
    matches.push_back({static_cast<int>(i), next_++});
  }
  for (const PlaneMatch& match : matches) Grow(map, added, match);
  keyframes_[keyframe] = std::move(matches);
  MergeDuplicates(map, keyframe);
}

// Extends a plane by what a keyframe shows of it.
void PlaneMap::Grow(const Map& map, const Keyframe& keyframe, const PlaneMatch& match) {
  HostedPlane& plane = planes_.at(match.plane);
  const Rigid3 host_from_cam = map.CamFromWorld(plane.host) * keyframe.cam_from_world.Inverse();
  ExtendBy(keyframe.frame->planes[match.feature].Extent(), host_from_cam, &plane);
}

void PlaneMap::MergeDuplicates(const Map& map, KeyframeId keyframe) {
  const auto observed = keyframes_.find(keyframe);
  if (observed == keyframes_.end()) return;
  const Keyframe& observer = *map.FindKeyframe(keyframe);
  for (size_t i = 0; i < observed->second.size(); ++i) {
    std::vector<LandmarkId> duplicates;
    for (const auto& [id, plane] : planes_) {
      if (AreSame(map, observer, observed->second[i], id)) duplicates.push_back(id);
    }
    for (const LandmarkId id : duplicates) {
      const LandmarkId own = observed->second[i].plane;
      Replace(map, std::max(own, id), std::min(own, id));
    }
  }
}

// Whether the plane of a match and another one differ by less than three sigmas of the
// observation, where it was made and at all vertices of their extents.
bool PlaneMap::AreSame(const Map& map, const Keyframe& keyframe, const PlaneMatch& match,
                       LandmarkId other) const {
  if (match.plane == other) return false;
  const PlaneFeature& feature = keyframe.frame->planes[match.feature];
  const auto in_cam = [&](LandmarkId id) -> PlaneLandmark {
    const HostedPlane& plane = planes_.at(id);
    const Rigid3 cam_from_host = keyframe.cam_from_world * map.CamFromWorld(plane.host).Inverse();
    return {id, cam_from_host * plane.in_host, cam_from_host * plane.extent};
  };
  const PlaneLandmark a = in_cam(match.plane), b = in_cam(other);
  return AreSamePlane(feature, a, b, noise_) && AreTouching(a.plane, a.extent, b.extent, kMaxGap);
}

// Gives the observations and the extent of a plane to another one.
void PlaneMap::Replace(const Map& map, LandmarkId replaced, LandmarkId kept) {
  HostedPlane& plane = planes_.at(kept);
  const HostedPlane& other = planes_.at(replaced);
  const Rigid3 host_from_other =
      map.CamFromWorld(plane.host) * map.CamFromWorld(other.host).Inverse();
  ExtendBy(other.extent, host_from_other, &plane);
  for (auto& [id, matches] : keyframes_) {
    for (PlaneMatch& match : matches) {
      if (match.plane == replaced) match.plane = kept;
    }
  }
  planes_.erase(replaced);
}

void PlaneMap::Renew(const Map& map) {
  std::set<LandmarkId> observed;
  for (auto keyframe = keyframes_.begin(); keyframe != keyframes_.end();) {
    if (map.FindKeyframe(keyframe->first) == nullptr) {
      keyframe = keyframes_.erase(keyframe);
      continue;
    }
    for (const PlaneMatch& match : keyframe->second) observed.insert(match.plane);
    ++keyframe;
  }
  for (auto plane = planes_.begin(); plane != planes_.end();) {
    plane = observed.count(plane->first) > 0 ? std::next(plane) : planes_.erase(plane);
  }
}

void PlaneMap::Join(PlaneMap other) {
  for (auto& [id, plane] : other.planes_) planes_[next_ + id] = plane;
  for (auto& [keyframe, matches] : other.keyframes_) {
    for (PlaneMatch& match : matches) match.plane += next_;
    keyframes_[keyframe] = std::move(matches);
  }
  next_ += other.next_;
  numbering_ += other.numbering_ + 1;
}

void PlaneMap::RemoveKeyframesOfThisRun(const Map& map) {
  const auto first = std::find_if(keyframes_.begin(), keyframes_.end(), [&map](const auto& entry) {
    return !map.IsOfEarlierSession(entry.first);
  });
  keyframes_.erase(first, keyframes_.end());
  Renew(map);
  noise_ = PlaneMap().noise_;
  planes_.clear();
  for (const auto& [id, matches] : keyframes_) {
    const Keyframe& observer = *map.FindKeyframe(id);
    for (const PlaneMatch& match : matches) {
      const Plane in_host = InCamera(observer.frame->planes[match.feature]);
      planes_.try_emplace(match.plane, HostedPlane{id, in_host});
      Grow(map, observer, match);
    }
  }
  *this = Fitted(map);
}

void PlaneMap::FollowFrames(const Map& map) {
  std::map<LandmarkId, int> num_observations = NumObservations();
  for (const auto& [id, matches] : keyframes_) {
    const Keyframe* keyframe = map.FindKeyframe(id);
    for (const PlaneMatch& match : matches) {
      HostedPlane& plane = planes_.at(match.plane);
      if (keyframe == nullptr || plane.host != id || num_observations[match.plane] > 1) continue;
      plane.in_host = InCamera(keyframe->frame->planes[match.feature]);
    }
  }
}

void PlaneMap::AddTo(const Map& map, WindowData* window) const {
  std::map<LandmarkId, int> num_observers;
  for (const WindowData::Keyframe& keyframe : window->keyframes) {
    const auto seen = keyframes_.find(keyframe.id);
    if (seen == keyframes_.end()) continue;
    for (const LandmarkId plane : DistinctPlanes(seen->second)) ++num_observers[plane];
  }
  static const auto manifold = std::make_shared<const PlaneManifold>();
  const MapPlanes in_world = InWorld(map);
  for (const WindowData::Keyframe& keyframe : window->keyframes) {
    const auto seen = keyframes_.find(keyframe.id);
    if (seen == keyframes_.end()) continue;
    const std::vector<PlaneFeature>& features = map.FindKeyframe(keyframe.id)->frame->planes;
    for (const PlaneMatch& match : seen->second) {
      const PlaneLandmark* plane = in_world.Find(match.plane);
      if (num_observers[match.plane] < 2 || plane == nullptr) continue;
      const PlaneFeature& feature = features[match.feature];
      if (!std::isfinite(SquaredResidual(feature, keyframe.cam_from_world, plane->plane))) continue;
      window->custom_factors.push_back(
          MakePlaneFactor(feature, noise_, BlockId::Pose(keyframe.id), BlockOf(match.plane)));
    }
  }
  for (const auto& [id, count] : num_observers) {
    const PlaneLandmark* plane = in_world.Find(id);
    if (count < 2 || plane == nullptr) continue;
    window->extra_blocks.push_back({BlockOf(id).id, plane->plane.params, manifold});
  }
}

PlaneMap PlaneMap::Fitted(const Map& map) const {
  std::map<LandmarkId, std::vector<PlaneView>> views;
  for (const auto& [id, matches] : keyframes_) {
    const Keyframe* keyframe = map.FindKeyframe(id);
    if (keyframe == nullptr) continue;
    for (const PlaneMatch& match : matches) {
      views[match.plane].push_back(
          {keyframe->cam_from_world, &keyframe->frame->planes[match.feature]});
    }
  }
  PlaneMap fitted = *this;
  std::map<LandmarkId, int> num_observations = NumObservations();
  for (auto& [id, plane] : fitted.planes_) {
    if (num_observations[id] < 2) continue;
    const Rigid3 host_from_world = map.CamFromWorld(plane.host);
    Plane in_world = host_from_world.Inverse() * plane.in_host;
    FitPlane(views[id], noise_, &in_world);
    plane.in_host = host_from_world * in_world;
  }
  return fitted;
}

void PlaneMap::Learn(const Map& map, const WindowData& window) {
  std::map<LandmarkId, Plane> estimates;
  for (const ExtraBlock& block : window.extra_blocks) {
    if (!IsPlane(block)) continue;
    Plane plane;
    plane.params = block.value;
    estimates[PlaneOf(block)] = plane;
    const auto known = planes_.find(PlaneOf(block));
    if (known == planes_.end()) continue;
    known->second.in_host = map.CamFromWorld(known->second.host) * plane;
  }
  std::map<LandmarkId, std::vector<double>> of_planes;
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    const auto seen = keyframes_.find(keyframe.id);
    if (seen == keyframes_.end()) continue;
    for (const PlaneMatch& match : seen->second) {
      const auto plane = estimates.find(match.plane);
      if (plane == estimates.end()) continue;
      of_planes[match.plane].push_back(
          SquaredResidual(map.FindKeyframe(keyframe.id)->frame->planes[match.feature],
                          keyframe.cam_from_world, plane->second));
    }
  }
  // Each plane is fitted to its observations, which makes their residuals smaller.
  std::vector<double> squares;
  for (const auto& [id, of_plane] : of_planes) {
    const auto count = static_cast<double>(of_plane.size());
    for (const double square : of_plane) squares.push_back(square * count / (count - 1.0));
  }
  if (squares.size() < kMinResiduals) return;
  const double of_window = std::sqrt(UpperMedian(std::move(squares)) / kMedianChiSquare3);
  noise_ =
      std::clamp((1.0 - kLearningRate) * noise_ + kLearningRate * of_window, kMinNoise, kMaxNoise);
}

MapPlanes PlaneMap::InWorld(const Map& map) const {
  MapPlanes result;
  result.noise = noise_;
  result.numbering = numbering_;
  for (const auto& [id, plane] : planes_) {
    const Rigid3 world_from_host = map.CamFromWorld(plane.host).Inverse();
    PlaneLandmark landmark{id, world_from_host * plane.in_host, world_from_host * plane.extent};
    for (Eigen::Vector3d& vertex : landmark.extent) vertex = Project(landmark.plane, vertex);
    result.planes.push_back(std::move(landmark));
  }
  return result;
}

std::map<LandmarkId, int> PlaneMap::NumObservations() const {
  std::map<LandmarkId, int> counts;
  for (const auto& [id, matches] : keyframes_) {
    for (const LandmarkId plane : DistinctPlanes(matches)) ++counts[plane];
  }
  return counts;
}

SavedPlanes PlaneMap::Save(const Map& map) const {
  const std::map<LandmarkId, HostedPlane> planes = Fitted(map).planes_;
  SavedPlanes saved;
  saved.noise = noise_;
  std::map<LandmarkId, KeyframeId> first_observers;
  for (const auto& [id, matches] : keyframes_) {
    if (map.FindKeyframe(id) == nullptr) continue;
    saved.observations[id] = matches;
    for (const PlaneMatch& match : matches) first_observers.emplace(match.plane, id);
  }
  for (const auto& [id, observer] : first_observers) {
    HostedPlane plane = planes.at(id);
    if (map.FindKeyframe(plane.host) == nullptr) {
      const Rigid3 host_from_old =
          map.CamFromWorld(observer) * map.CamFromWorld(plane.host).Inverse();
      plane = {observer, host_from_old * plane.in_host, host_from_old * plane.extent};
    }
    saved.planes[id] = std::move(plane);
  }
  return saved;
}

void PlaneMap::Restore(const SavedPlanes& saved) {
  planes_ = saved.planes;
  keyframes_ = saved.observations;
  noise_ = saved.noise;
  next_ = planes_.empty() ? 0 : planes_.rbegin()->first + 1;
}

}  // namespace msc_vo
