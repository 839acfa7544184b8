// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/relocalizer.h"

#include <cmath>
#include <random>
#include <vector>

#include "msc_vo/geometry/rigid_alignment.h"

namespace msc_vo {

namespace {

// Matches every feature of `frame` that has a depth with the nearest landmark of `keyframe` by
// descriptor.
std::vector<PointMatch> MatchDescriptors(const RelocalizerOptions& options, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe) {
  std::vector<const PointLandmark*> landmarks;
  for (const LandmarkId id : keyframe.points) {
    if (id != kNoId) landmarks.push_back(map.FindPoint(id));
  }
  std::vector<PointMatch> matches;
  for (size_t feature = 0; feature < frame.points.size(); ++feature) {
    if (!frame.points[feature].HasDepth()) continue;
    const PointLandmark* best = nullptr;
    // Larger than any distance between descriptors of 256 bits.
    int best_distance = 257;
    int second_distance = 257;
    for (const PointLandmark* landmark : landmarks) {
      const int distance = HammingDistance(landmark->descriptor, frame.points[feature].descriptor);
      if (distance < best_distance) {
        second_distance = best_distance;
        best_distance = distance;
        best = landmark;
      } else if (distance < second_distance) {
        second_distance = distance;
      }
    }
    if (best == nullptr || best_distance > options.max_distance) continue;
    if (best_distance > options.max_ratio * second_distance) continue;
    matches.push_back({static_cast<int>(feature), best->id, best->position, true});
  }
  return matches;
}

int MarkInliers(const RelocalizerOptions& options, const Frame& frame, const Rigid3& cam_from_world,
                std::vector<PointMatch>* matches) {
  int num_inliers = 0;
  for (PointMatch& match : *matches) {
    const PointFeature& feature = frame.points[match.feature];
    const Eigen::Vector3d in_cam = cam_from_world * match.position;
    match.inlier = in_cam.z() > 0.0 && (frame.camera.Project(in_cam) - feature.pixel).norm() <
                                           options.inlier_sigmas * feature.sigma;
    num_inliers += match.inlier ? 1 : 0;
  }
  return num_inliers;
}

Rigid3 AlignPairs(const Frame& frame, const std::vector<PointMatch>& matches,
                  const std::vector<int>& chosen) {
  std::vector<Eigen::Vector3d> in_world;
  std::vector<Eigen::Vector3d> in_cam;
  for (const int i : chosen) {
    in_world.push_back(matches[i].position);
    in_cam.push_back(frame.PointInCamera(matches[i].feature));
  }
  return AlignRigid(in_world, in_cam);
}

// Draws three distinct indices below `size`.
std::vector<int> DrawTriple(int size, std::mt19937* random) {
  std::vector<int> triple;
  while (triple.size() < 3) {
    const int i = static_cast<int>((*random)() % static_cast<unsigned>(size));
    bool is_new = true;
    for (const int other : triple) is_new = is_new && other != i;
    if (is_new) triple.push_back(i);
  }
  return triple;
}

}  // namespace

bool RelocalizerOptions::IsValid(std::string* error) const {
  if (max_distance < 0 || max_distance > 256) {
    *error = "relocalizer: max_distance must be between 0 and 256 bits";
  } else if (!(max_ratio > 0.0 && max_ratio <= 1.0)) {
    *error = "relocalizer: max_ratio must be in (0, 1]";
  } else if (max_iterations < 1 || min_inliers < 3) {
    *error = "relocalizer: max_iterations >= 1 and min_inliers >= 3 must hold";
  } else if (!(inlier_sigmas > 0.0)) {
    *error = "relocalizer: inlier_sigmas must be positive";
  } else {
    return true;
  }
  return false;
}

std::optional<Relocalization> Relocalize(const RelocalizerOptions& options, const Frame& frame,
                                         const Map& map, const Keyframe& keyframe) {
  std::vector<PointMatch> matches = MatchDescriptors(options, frame, map, keyframe);
  if (static_cast<int>(matches.size()) < options.min_inliers) return std::nullopt;

  std::mt19937 random(static_cast<uint32_t>(frame.id));
  Relocalization best;
  int best_inliers = 0;
  for (int i = 0; i < options.max_iterations; ++i) {
    const Rigid3 pose =
        AlignPairs(frame, matches, DrawTriple(static_cast<int>(matches.size()), &random));
    const int num_inliers = MarkInliers(options, frame, pose, &matches);
    if (num_inliers <= best_inliers) continue;
    best_inliers = num_inliers;
    best.cam_from_world = pose;
  }
  if (best_inliers < options.min_inliers) return std::nullopt;
  MarkInliers(options, frame, best.cam_from_world, &matches);
  for (const PointMatch& match : matches) {
    if (match.inlier) best.matches.points.push_back(match);
  }
  return best;
}

}  // namespace msc_vo
