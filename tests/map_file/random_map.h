// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <random>
#include <utility>

#include "msc_vo/map/map_contents.h"

namespace msc_vo {

// A map with random features, landmarks and poses. Every keyframe observes landmarks of the one
// before, and has features that observe none.
class RandomMap {
 public:
  explicit RandomMap(uint32_t seed = 1) : random_(seed) {
    CameraIntrinsics intrinsics;
    intrinsics.distortion.k = {0.1, -0.2, 1e-3, 2e-3, 0.05};
    intrinsics_ = std::make_shared<const CameraIntrinsics>(intrinsics);
  }

  double Uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  Eigen::Vector2d Pixel() { return {Uniform(0.0, 639.0), Uniform(0.0, 479.0)}; }
  Eigen::Vector3d Position() { return {Uniform(-2.0, 2.0), Uniform(-2.0, 2.0), Uniform(1.0, 5.0)}; }
  Rigid3 Pose() {
    const Eigen::Vector4d q(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
    return {Eigen::Quaterniond(q.normalized()), 10.0 * Position()};
  }

  std::shared_ptr<const Frame> MakeFrame() {
    auto frame = std::make_shared<Frame>();
    frame->id = next_frame_++;
    frame->timestamp = 1.5e9 + Uniform(0.0, 1.0);
    frame->intrinsics = intrinsics_;
    frame->camera = intrinsics_->camera;
    for (int i = 0; i < kPoints; ++i) frame->points.push_back(Point());
    for (int i = 0; i < kLines; ++i) frame->lines.push_back(Line());
    frame->depth_ranges.cells.resize(DepthRanges::kColumns * DepthRanges::kRows);
    frame->depth_ranges.cells[5] = {0.25f, 0.5f};
    frame->grid = FeatureGrid(frame->camera, frame->points);
    return frame;
  }

  void AddKeyframe(Map* map) {
    const bool is_first = map->keyframes().empty();
    const KeyframeId last = is_first ? kNoId : map->keyframes().back().first;
    const KeyframeId id = map->AddKeyframe(MakeFrame(), Pose());
    map->SetStepCovariance(id, Uniform(1e-6, 1e-4) * PoseCovariance::Identity());
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      const int num = static_cast<int>(SlotsOf<L>(*map->FindKeyframe(id)).size());
      for (int i = 0; i < num - 2; ++i) {
        const LandmarkId old = is_first ? kNoId : SlotsOf<L>(*map->FindKeyframe(last))[i];
        if (i % 2 == 1 && old != kNoId) {
          map->Observe<L>(old, id, i);
          map->Refresh<L>(old);
        } else if (i % 3 != 0) {
          const LandmarkId landmark = map->Add<L>(id, i, Geometry<L>());
          map->SetNoise<L>(landmark, Uniform(1.0, 3.0));
          map->SetHasFalseDepth<L>(landmark, i % 4 == 2);
        }
      }
    });
  }

  template <typename L>
  typename L::Geometry Geometry() {
    if constexpr (std::is_same_v<L, PointLandmark>) {
      return Position();
    } else {
      return {Position(), Position()};
    }
  }

  Map Make(int num_keyframes, const Map& before = {}) {
    Map map = before.Next();
    for (int i = 0; i < num_keyframes; ++i) AddKeyframe(&map);
    return map;
  }

 private:
  static constexpr int kPoints = 20;
  static constexpr int kLines = 8;

  Descriptor MakeDescriptor() {
    Descriptor descriptor;
    for (uint8_t& byte : descriptor) byte = static_cast<uint8_t>(random_());
    return descriptor;
  }
  PointFeature Point() {
    PointFeature point;
    point.pixel = Pixel();
    point.sigma = Uniform(0.5, 3.0);
    point.level = static_cast<int>(Uniform(-64.9, 63.9));
    point.dynamic = Uniform(0.0, 1.0) < 0.1;
    point.angle = Uniform(0.0, 6.28);
    if (Uniform(0.0, 1.0) < 0.8) {
      point.inverse_depth = Uniform(0.1, 2.0);
      point.inverse_depth_sigma = Uniform(1e-5, 0.05);
    }
    point.descriptor = MakeDescriptor();
    return point;
  }
  LineFeature Line() {
    LineFeature line;
    line.segment = {Pixel(), Pixel()};
    line.sigma = Uniform(0.1, 1.0);
    if (Uniform(0.0, 1.0) < 0.8) {
      LineDepth depth;
      depth.start = Uniform(0.1, 2.0);
      depth.end = Uniform(0.1, 2.0);
      depth.covariance << 4e-6, -1e-6, -1e-6, 1e-6;
      depth.num_inliers = 40;
      depth.inlier_ratio = 0.75;
      line.depth = depth;
    }
    line.descriptor = MakeDescriptor();
    return line;
  }

  std::mt19937 random_;
  int64_t next_frame_ = 0;
  std::shared_ptr<const CameraIntrinsics> intrinsics_;
};

// The map as the only submap of a file.
inline MapContents AsContents(Map map) {
  MapContents contents;
  contents.sessions.push_back({0, "first"});
  contents.submaps.push_back({0, std::move(map), {}, {}});
  return contents;
}

// A random plane of a frame.
inline PlaneFeature RandomPlane(std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(0.1, 0.5);
  PlaneFeature plane;
  for (double& x : plane.inverse_depth) x = uniform(*random);
  plane.covariance = Eigen::Vector3d(1e-6, 2e-6, 3e-6).asDiagonal();
  plane.covariance(0, 1) = plane.covariance(1, 0) = 5e-7;
  plane.mean_square_ray = Eigen::Vector3d(0.1, 0.06, 1.0).asDiagonal();
  plane.num_pixels = 20000;
  plane.hull = {{-0.2, -0.1}, {uniform(*random), -0.1}, {0.1, uniform(*random)}};
  return plane;
}

// The map with planes: each keyframe observes plane 3 and one of its own, from a frame that has
// three planes.
inline SavedSubMap WithPlanes(Map map) {
  std::mt19937 random(7);
  SavedSubMap submap;
  std::vector<KeyframeId> keyframes;
  for (const auto& [id, keyframe] : map.keyframes()) keyframes.push_back(id);
  for (const KeyframeId id : keyframes) {
    const auto frame = std::make_shared<Frame>(*map.FindKeyframe(id)->frame);
    for (int i = 0; i < 3; ++i) frame->planes.push_back(RandomPlane(&random));
    map.SetFrame(id, frame);
    for (const LandmarkId plane : {LandmarkId{3}, 10 + id}) {
      HostedPlane& hosted = submap.planes.planes[plane];
      hosted.host = id;
      hosted.in_host = Plane({0.6, 0.0, -0.8}, 1.5 + 0.1 * static_cast<double>(id));
      hosted.extent = {{0.0, 0.0, 1.0}, {0.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};
      for (Eigen::Vector3d& vertex : hosted.extent) vertex = Project(hosted.in_host, vertex);
    }
    submap.planes.observations[id] = {{2, 3}, {0, 10 + id}};
  }
  submap.planes.noise = 0.4;
  submap.map = std::move(map);
  return submap;
}

}  // namespace msc_vo
