// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/scene_axes.h"

#include "tests/structure/evidence.h"
#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

#include "msc_vo/map/window_selection.h"

namespace msc_vo {
namespace {

// A map of `count` keyframes, ten frames apart, with the true poses relative to the first camera.
// Lines are matched by their descriptors, which are unique.
Map MakeMap(SyntheticFrames* world, int count) {
  Map map;
  for (int k = 0; k < count; ++k) {
    const int index = 10 * k;
    const Rigid3 cam_from_world =
        SyntheticFrames::CamFromWorld(index) * SyntheticFrames::CamFromWorld(0).Inverse();
    const KeyframeId id = map.AddKeyframe(world->MakeFrame(index), cam_from_world);
    const Frame& frame = *map.FindKeyframe(id)->frame;
    for (int i = 0; i < static_cast<int>(frame.lines.size()); ++i) {
      LandmarkId match = kNoId;
      for (const auto& [line_id, line] : map.lines()) {
        if (HammingDistance(line.descriptor, frame.lines[i].descriptor) < 40) match = line_id;
      }
      if (match != kNoId) {
        map.Observe<LineLandmark>(match, id, i);
        map.Refresh<LineLandmark>(match);
      } else if (frame.lines[i].depth) {
        map.Add<LineLandmark>(id, i, cam_from_world.Inverse() * frame.LineInCamera(i));
      }
    }
  }
  return map;
}

// Largest angle (degrees) between an axis and the nearest axis of the box.
double AxesError(const Eigen::Quaterniond& world_from_axes) {
  const Rigid3 cam_from_box = SyntheticFrames::CamFromWorld(0);
  return testing::AxesErrorInDegrees(Eigen::Quaterniond(cam_from_box.rotation()), world_from_axes);
}

// The window around the newest keyframe of the map.
WindowData MakeWindow(const Map& map) {
  return SelectWindow(WindowSelectionOptions(), map, map.keyframes().back().first);
}

TEST(SceneAxes, StartsWithOneKeyframeAndRefinesOverMany) {
  SyntheticFrames world{SyntheticFrames::Options()};
  SceneAxes axes{SceneAxesOptions()};
  axes.Update(MakeMap(&world, 1), 0, {});
  ASSERT_EQ(axes.estimator().state(), AxesState::kCoarse);
  EXPECT_LT(AxesError(axes.estimator().world_from_axes()), 1.5);
  const Map map = MakeMap(&world, 7);
  axes.Learn(map, MakeWindow(map));
  axes.Update(map, 6, {});
  ASSERT_EQ(axes.estimator().state(), AxesState::kRefined);
  EXPECT_LT(AxesError(axes.estimator().world_from_axes()), 0.2);
  EXPECT_LT(axes.estimator().sigma(), DegreesToRadians(0.2));
}

TEST(SceneAxes, AlignsTheLinesOfAWindowWithTheirAxes) {
  SyntheticFrames world{SyntheticFrames::Options()};
  SceneAxes axes{SceneAxesOptions()};
  const Map map = MakeMap(&world, 7);
  axes.Update(map, 6, {});
  WindowData window = MakeWindow(map);
  axes.AddAlignments(&window);
  EXPECT_TRUE(window.axis_alignments.empty()) << "coarse axes align nothing";
  axes.Learn(map, window);
  axes.Update(map, 6, {});
  axes.AddAlignments(&window);
  EXPECT_GT(window.axis_alignments.size(), 0.6 * window.lines.size());
  for (const WindowData::AxisAlignment& alignment : window.axis_alignments) {
    const LineLandmark& line = *map.Find<LineLandmark>(alignment.line);
    // The association takes the direction that all views determine, not that of the segment.
    EXPECT_LT(UndirectedAngle(line.segment.Direction(), alignment.axis),
              DegreesToRadians(5.0) + 3.0 * line.direction_sigma);
    EXPECT_GT(alignment.sigma, 0.0);
  }
}

TEST(SceneAxes, LearnsThatTheLinesOfABoxFollowItsAxes) {
  SyntheticFrames world{SyntheticFrames::Options()};
  SceneAxes axes{SceneAxesOptions()};
  const Map map = MakeMap(&world, 7);
  axes.Update(map, 6, {});
  for (int i = 0; i < 3; ++i) {
    axes.Learn(map, MakeWindow(map));
    axes.Update(map, 6, {});
  }
  // Its lines are exact, and known to some tenths of a degree.
  EXPECT_LT(axes.deviation().scale(), 0.5 * DeviationEstimator().scale());
}

TEST(SceneAxes, FindsNoAxesInTooFewLines) {
  SyntheticFrames::Options options;
  options.num_lines = 2;
  SyntheticFrames world{options};
  const Map map = MakeMap(&world, 3);
  SceneAxes axes{SceneAxesOptions()};
  axes.Update(map, 2, {});
  EXPECT_EQ(axes.estimator().state(), AxesState::kNone);
  WindowData window = SelectWindow(WindowSelectionOptions(), map, 2);
  axes.AddAlignments(&window);
  EXPECT_TRUE(window.axis_alignments.empty());
  for (const auto& [id, line] : map.lines()) EXPECT_FALSE(axes.AxisOf(line));
}

TEST(SceneAxes, CanBeDisabled) {
  SyntheticFrames world{SyntheticFrames::Options()};
  SceneAxesOptions options;
  options.enabled = false;
  SceneAxes axes(options);
  axes.Update(MakeMap(&world, 7), 6, {});
  EXPECT_EQ(axes.estimator().state(), AxesState::kNone);
  axes.Restore({Eigen::Quaterniond::Identity(), 0.001, 0.002});
  EXPECT_FALSE(axes.Estimate());
  ASSERT_TRUE(axes.Saved());
  EXPECT_EQ(axes.Saved()->sigma, 0.001);
}

TEST(SceneAxes, SavesTheAxesOfTheRunBeforeUntilItHasItsOwn) {
  SyntheticFrames world{SyntheticFrames::Options()};
  const Map map = MakeMap(&world, 7);
  const AxesEstimate earlier{Eigen::Quaterniond(SyntheticFrames::CamFromWorld(0).rotation()), 0.001,
                             0.002};
  SceneAxes axes{SceneAxesOptions()};
  axes.Restore(earlier);
  axes.Update(map, 6, {});
  EXPECT_EQ(axes.Saved()->deviation, 0.002);
  axes.Learn(map, MakeWindow(map));
  EXPECT_EQ(axes.Saved()->deviation, axes.deviation().scale());
  EXPECT_NE(axes.Saved()->deviation, 0.002);
  axes.Reset();
  EXPECT_EQ(axes.Saved()->deviation, 0.002);
  EXPECT_TRUE(axes.Estimate()->world_from_axes.isApprox(earlier.world_from_axes));
}

}  // namespace
}  // namespace msc_vo
