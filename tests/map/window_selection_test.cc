// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/window_selection.h"

#include <map>
#include <memory>
#include <set>

#include "tests/support/synthetic_frames.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// Keyframes 10 frames apart in one world, with the true associations.
class WindowSelectionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    SyntheticFrames::Options options;
    options.pixel_noise = 0.0;
    options.inverse_depth_noise = 0.0;
    options.flipped_bits = 0;
    SyntheticFrames world(options);
    for (int i = 0; i < 6; ++i)
      Insert(world.MakeFrame(10 * i), SyntheticFrames::CamFromWorld(10 * i));
  }

  // Matches features with landmarks by their descriptors, which are unique.
  void Insert(const std::shared_ptr<const Frame>& frame, const Rigid3& cam_from_world) {
    const KeyframeId id = map_.AddKeyframe(frame, cam_from_world);
    for (size_t i = 0; i < frame->points.size(); ++i) {
      const auto [known, is_new] = point_of_.emplace(frame->points[i].descriptor, kNoId);
      const int feature = static_cast<int>(i);
      if (!is_new && map_.Observe<PointLandmark>(known->second, id, feature)) continue;
      known->second = map_.Add<PointLandmark>(
          id, feature, cam_from_world.Inverse() * frame->PointInCamera(feature));
    }
    for (size_t i = 0; i < frame->lines.size(); ++i) {
      const auto [known, is_new] = line_of_.emplace(frame->lines[i].descriptor, kNoId);
      const int feature = static_cast<int>(i);
      if (!is_new && map_.Observe<LineLandmark>(known->second, id, feature)) continue;
      known->second = map_.Add<LineLandmark>(
          id, feature, cam_from_world.Inverse() * frame->LineInCamera(feature));
    }
  }

  Map map_;
  std::map<Descriptor, LandmarkId> point_of_;
  std::map<Descriptor, LandmarkId> line_of_;
};

TEST_F(WindowSelectionTest, LimitsFreeAndFixedKeyframes) {
  WindowSelectionOptions options;
  options.max_keyframes = 3;
  options.max_fixed_keyframes = 2;
  const WindowData window = SelectWindow(options, map_, 5);
  int num_free = 0;
  int num_fixed = 0;
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    ++(keyframe.fixed ? num_fixed : num_free);
  }
  EXPECT_EQ(num_free, 3);
  EXPECT_EQ(num_fixed, 2);
  EXPECT_GT(window.points.size(), 100u);
  EXPECT_GT(window.lines.size(), 10u);
}

TEST_F(WindowSelectionTest, FixesTheFirstKeyframeIfAllAreSelected) {
  const WindowData window = SelectWindow(WindowSelectionOptions(), map_, 5);
  ASSERT_EQ(window.keyframes.size(), 6u);
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    EXPECT_EQ(keyframe.fixed, keyframe.id == 0) << keyframe.id;
  }
}

std::vector<KeyframeId> IdsOf(const WindowData& window) {
  std::vector<KeyframeId> ids;
  for (const WindowData::Keyframe& keyframe : window.keyframes) ids.push_back(keyframe.id);
  return ids;
}

// A keyframe of another world follows keyframe 5, and two more follow that one.
TEST_F(WindowSelectionTest, LinksInTimeAddTheKeyframeBeforeAGap) {
  SyntheticFrames::Options options;
  options.seed = 5;
  SyntheticFrames other(options);
  for (int i = 6; i < 9; ++i) {
    Insert(other.MakeFrame(10 * i), SyntheticFrames::CamFromWorld(10 * i));
  }
  // Descriptors are disturbed, so that keyframes of that world share no landmarks either.
  WindowSelectionOptions limited;
  limited.max_fixed_keyframes = 0;
  EXPECT_THAT(IdsOf(SelectWindow(limited, map_, 6)), testing::ElementsAre(6));
  EXPECT_THAT(IdsOf(SelectWindow(limited, map_, 6, WindowLinks::kLandmarksAndTime)),
              testing::ElementsAre(5, 6));
  EXPECT_THAT(IdsOf(SelectWindow(limited, map_, 8, WindowLinks::kLandmarksAndTime)),
              testing::ElementsAre(7, 8));
  // The keyframe before keyframe 3 shares landmarks with it, and is not added for its time.
  limited.max_keyframes = 1;
  EXPECT_THAT(IdsOf(SelectWindow(limited, map_, 3, WindowLinks::kLandmarksAndTime)),
              testing::ElementsAre(3));
  EXPECT_THAT(IdsOf(SelectWindow(limited, map_, 0, WindowLinks::kLandmarksAndTime)),
              testing::ElementsAre(0));
}

TEST_F(WindowSelectionTest, ObservationsReferToKeyframesOfTheWindow) {
  WindowSelectionOptions options;
  options.max_keyframes = 2;
  options.max_fixed_keyframes = 1;
  const WindowData window = SelectWindow(options, map_, 3);
  ASSERT_FALSE(window.points.empty());
  ASSERT_FALSE(window.lines.empty());
  std::set<int64_t> keyframes;
  for (const auto& keyframe : window.keyframes) keyframes.insert(keyframe.id);
  std::set<int64_t> observed;
  for (const auto& o : window.point_observations) {
    EXPECT_EQ(keyframes.count(o.keyframe), 1u);
    observed.insert(o.point);
  }
  for (const auto& o : window.line_observations) {
    EXPECT_EQ(keyframes.count(o.keyframe), 1u);
    observed.insert(o.line);
  }
  for (const auto& point : window.points) EXPECT_EQ(observed.count(point.id), 1u) << point.id;
  for (const auto& line : window.lines) EXPECT_EQ(observed.count(line.id), 1u) << line.id;
}

TEST_F(WindowSelectionTest, WriteBackUpdatesTheMapAndRemovesRejectedObservations) {
  WindowData window = SelectWindow(WindowSelectionOptions(), map_, 5);
  const size_t observations_before =
      map_.Find<PointLandmark>(window.point_observations[0].point)->observations.size();
  ASSERT_GE(observations_before, 2u);
  window.point_observations[0].rejected = true;
  const Eigen::Vector3d moved(9, 9, 9);
  window.points[0].position = moved;
  window.keyframes.back().cam_from_world.translation().x() += 0.25;
  const Rigid3 pose = window.keyframes.back().cam_from_world;
  WriteBack(window, &map_);
  EXPECT_EQ(map_.Find<PointLandmark>(window.points[0].id)->position, moved);
  EXPECT_EQ(map_.Find<PointLandmark>(window.point_observations[0].point)->observations.size(),
            observations_before - 1);
  EXPECT_EQ(map_.FindKeyframe(window.keyframes.back().id)->cam_from_world.params, pose.params);
}

// The positions of the landmarks that one keyframe alone observes, in its camera frame.
std::vector<Eigen::Vector3d> ObservedByItAlone(const Map& map, const Keyframe& keyframe) {
  std::vector<Eigen::Vector3d> positions;
  for (const LandmarkId id : keyframe.landmarks.points) {
    const PointLandmark* point = id == kNoId ? nullptr : map.Find<PointLandmark>(id);
    if (point == nullptr || point->observations.size() > 1) continue;
    positions.push_back(keyframe.cam_from_world * point->position);
  }
  for (const LandmarkId id : keyframe.landmarks.lines) {
    const LineLandmark* line = id == kNoId ? nullptr : map.Find<LineLandmark>(id);
    if (line == nullptr || line->observations.size() > 1) continue;
    positions.push_back(keyframe.cam_from_world * line->segment.start);
    positions.push_back(keyframe.cam_from_world * line->segment.end);
  }
  return positions;
}

TEST_F(WindowSelectionTest, LandmarksOfOneKeyframeMoveWithIt) {
  for (const KeyframeId other : {0, 1, 2, 3, 4}) {
    const Keyframe keyframe = *map_.FindKeyframe(other);
    for (const LandmarkId id : keyframe.landmarks.points)
      map_.RemoveObservation<PointLandmark>(id, other);
    for (size_t i = 0; i < keyframe.landmarks.lines.size(); i += 2) {
      map_.RemoveObservation<LineLandmark>(keyframe.landmarks.lines[i], other);
    }
  }
  WindowData window = SelectWindow(WindowSelectionOptions(), map_, 5);
  const std::vector<Eigen::Vector3d> before = ObservedByItAlone(map_, *map_.FindKeyframe(5));
  ASSERT_GT(before.size(), 20u);
  for (WindowData::Keyframe& keyframe : window.keyframes) {
    if (keyframe.id != 5) continue;
    keyframe.fixed = false;
    keyframe.cam_from_world.translation() += Eigen::Vector3d(0.3, -0.2, 0.1);
    keyframe.cam_from_world.rotation() = Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0);
  }
  WriteBack(window, &map_);
  const std::vector<Eigen::Vector3d> after = ObservedByItAlone(map_, *map_.FindKeyframe(5));
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < before.size(); ++i) EXPECT_LT((after[i] - before[i]).norm(), 1e-9) << i;
}

TEST_F(WindowSelectionTest, TrimsLinesToTheirObservations) {
  const LineLandmark& line = map_.lines().front().second;
  // The same infinite line with end points far along it.
  LineSegment3 shifted;
  shifted.start = line.segment.At(-3.0);
  shifted.end = line.segment.At(0.2);
  const LineSegment3 trimmed = TrimToObservations(map_, line, shifted);
  EXPECT_LT((trimmed.start - line.segment.start).norm(), 1e-6);
  EXPECT_LT((trimmed.end - line.segment.end).norm(), 1e-6);
}

}  // namespace
}  // namespace msc_vo
