// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_fusion.h"

#include <vector>

#include "tests/support/synthetic_frames.h"
#include <gmock/gmock.h>

#include "msc_vo/mapping/culling.h"

namespace msc_vo {
namespace {

// Two keyframes of the same world, each with its own landmarks for all features, and one shared
// landmark that makes them covisible.
class FusionTest : public ::testing::Test {
 protected:
  void SetUp() override { AddPair(0, 15); }
  // Images of the world by their index.
  void AddPair(int first, int second) {
    std::vector<KeyframeId> ids;
    for (const int index : {first, second}) {
      ids.push_back(
          map_.AddKeyframe(world_.MakeFrame(index), SyntheticFrames::CamFromWorld(index)));
      CreateLandmarks(ids.back(), &probation_, &map_);
    }
    MergeOnePoint(*map_.FindKeyframe(ids[0]), *map_.FindKeyframe(ids[1]));
  }
  void MergeOnePoint(const Keyframe& a, const Keyframe& b) {
    for (size_t i = 0; i < a.landmarks.points.size(); ++i) {
      for (size_t j = 0; j < b.landmarks.points.size(); ++j) {
        if (HammingDistance(a.frame->points[i].descriptor, b.frame->points[j].descriptor) > 40) {
          continue;
        }
        map_.MergeLandmarks<PointLandmark>(b.landmarks.points[j], a.landmarks.points[i]);
        return;
      }
    }
  }

  SyntheticFrames world_{SyntheticFrames::Options()};
  Map map_;
  Probation probation_;
};

TEST_F(FusionTest, MergesDuplicates) {
  const size_t points_before = map_.points().size();
  const size_t lines_before = map_.lines().size();
  FuseLandmarks(FusionOptions(), 1, &map_);
  // Nearly all points are visible in both frames; a few leave the image or fail to match.
  EXPECT_LT(map_.points().size(), 0.65 * points_before);
  EXPECT_LT(map_.lines().size(), 0.75 * lines_before);
  // Observations and associations of the merged landmarks are consistent.
  for (const auto& [id, point] : map_.points()) {
    for (const Observation& o : point.observations) {
      EXPECT_EQ(map_.FindKeyframe(o.keyframe)->landmarks.points[o.feature], id);
    }
  }
}

TEST_F(FusionTest, IgnoresDynamicFeatures) {
  Map map;
  SyntheticFrames world{SyntheticFrames::Options()};
  const KeyframeId first = map.AddKeyframe(world.MakeFrame(0), SyntheticFrames::CamFromWorld(0));
  CreateLandmarks(first, &probation_, &map);
  auto marked = std::make_shared<Frame>(*world.MakeFrame(15));
  for (size_t i = 1; i < marked->points.size(); ++i) marked->points[i].dynamic = i % 2 == 0;
  const KeyframeId second = map.AddKeyframe(marked, SyntheticFrames::CamFromWorld(15));
  // One shared landmark makes the keyframes covisible.
  for (const LandmarkId id : map.FindKeyframe(first)->landmarks.points) {
    if (HammingDistance(map.Find<PointLandmark>(id)->descriptor, marked->points[0].descriptor) > 40)
      continue;
    map.Observe<PointLandmark>(id, second, 0);
    break;
  }
  FuseLandmarks(FusionOptions(), second, &map);
  int num_observed = 0;
  for (size_t i = 0; i < marked->points.size(); ++i) {
    const bool is_observed = map.FindKeyframe(second)->landmarks.points[i] != kNoId;
    EXPECT_FALSE(is_observed && marked->points[i].dynamic) << i;
    num_observed += is_observed;
  }
  EXPECT_GT(num_observed, 0.3 * marked->points.size());  // of the static half
}

TEST_F(FusionTest, MergesDuplicatesOfAllKeyframes) {
  AddPair(30, 45);  // covisible with each other only
  const size_t points_before = map_.points().size();
  const size_t lines_before = map_.lines().size();
  FuseAllLandmarks(FusionOptions(), &map_);
  EXPECT_LT(map_.points().size(), 0.65 * points_before);
  EXPECT_LT(map_.lines().size(), 0.75 * lines_before);
}

TEST_F(FusionTest, KeepsDifferentLandmarksSeparate) {
  FuseLandmarks(FusionOptions(), 1, &map_);
  // At most 12 bits of a descriptor are flipped per observation, so that two observations of one
  // landmark differ in at most 24.
  size_t num_shared = 0;
  for (const auto& [id, point] : map_.points()) {
    if (point.observations.size() < 2) continue;
    ++num_shared;
    const Observation& a = point.observations[0];
    const Observation& b = point.observations[1];
    EXPECT_LE(HammingDistance(map_.FindKeyframe(a.keyframe)->frame->points[a.feature].descriptor,
                              map_.FindKeyframe(b.keyframe)->frame->points[b.feature].descriptor),
              24)
        << id;
  }
  EXPECT_GT(num_shared, map_.points().size() / 2);
}

}  // namespace
}  // namespace msc_vo
