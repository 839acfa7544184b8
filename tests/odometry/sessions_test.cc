// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/map/map_validation.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/odometry/localizer.h"
#include "msc_vo/odometry/map_merge.h"

namespace msc_vo {
namespace {

// A map of one run, and a second run in it.
class SessionsTest : public RoomTest {
 protected:
  static constexpr int kFirst = 10;  // image of the second session

  static OdometryOptions Options() {
    OdometryOptions options;
    options.threads = 1;
    return options;
  }

  static void SetUpTestSuite() {
    RoomTest::SetUpTestSuite();
    Odometry odometry(Options(), camera_, LensDistortion());
    for (const RgbdImage& image : *images_) odometry.Process(image);
    MapContents contents = *odometry.ShareMaps("first");
    first_ = new MapContents(std::move(contents));
    first_result_ = new OdometryResult(odometry.Finish());
  }
  static void TearDownTestSuite() {
    delete first_;
    delete first_result_;
    RoomTest::TearDownTestSuite();
  }
  static MapContents Map() {
    MapContents copy;
    copy.sessions = first_->sessions;
    for (SavedSubMap& submap : first_->submaps) {
      copy.submaps.push_back({submap.id, submap.map.Share(), submap.axes, submap.noise_scale});
    }
    return copy;
  }

  // Runs over the images in the map of the first run, beginning at `time` (seconds).
  static OdometryResult Run(double time, Odometry* odometry) {
    odometry->SetMap(Map());
    for (int i = kFirst; i < kNumFrames; ++i) {
      RgbdImage image = (*images_)[i];
      image.id = i - kFirst;
      image.timestamp = time + image.id / 30.0;
      odometry->Process(image);
    }
    return odometry->Finish();
  }
  // Largest distance of a camera to that of the first run, metres.
  static double LargestDistance(const OdometryResult& result, size_t first = 0) {
    double largest = 0.0;
    for (size_t i = first; i < result.frames.size(); ++i) {
      const Rigid3& then = first_result_->frames[i + kFirst].cam_from_world;
      const Rigid3& now = result.frames[i].cam_from_world;
      largest = std::max(largest, (then.OriginInSource() - now.OriginInSource()).norm());
    }
    return largest;
  }

  static inline MapContents* first_ = nullptr;
  static inline OdometryResult* first_result_ = nullptr;
};

// At the same time stamps as the first run, but at the other end of its path: nothing can be
// concluded from that.
TEST_F(SessionsTest, MayBeElsewhereAtTheTimesOfTheFirstRun) {
  for (const double offset : {0.0, 0.011, 0.022}) {
    Odometry odometry(Options(), camera_, LensDistortion());
    odometry.SetMap(Map());
    for (int i = 0; i < kNumFrames; ++i) {
      RgbdImage image = (*images_)[kNumFrames - 1 - i];
      image.id = i;
      image.timestamp = (*images_)[i].timestamp + offset;
      odometry.Process(image);
    }
    const OdometryResult result = odometry.Finish();
    ASSERT_EQ(result.segments.size(), 2u);
    EXPECT_EQ(result.segments[1].world, 0) << offset;
  }
}

// Time stamps of another session mean nothing: earlier, the same ones, later.
TEST_F(SessionsTest, FindsItselfInTheMapWhateverTheClockSays) {
  for (const double time : {-1000.0, 0.0, 0.33, 1e9}) {
    Odometry odometry(Options(), camera_, LensDistortion());
    const OdometryResult result = Run(time, &odometry);
    ASSERT_EQ(result.segments.size(), 2u) << time;
    EXPECT_TRUE(result.segments[0].is_earlier_session);
    EXPECT_FALSE(result.segments[1].is_earlier_session);
    EXPECT_EQ(result.segments[0].num_estimated, 0);
    EXPECT_EQ(result.segments[1].num_estimated, kNumFrames - kFirst);
    EXPECT_EQ(result.segments[1].world, 0) << time;
    EXPECT_EQ(result.map_world, 0);
    ASSERT_TRUE(FirstLocalizedFrame(result)) << time;
    EXPECT_LT(*FirstLocalizedFrame(result), 25);
    EXPECT_LT(LargestDistance(result), 0.01) << time;  // measured: 4 mm
    ASSERT_EQ(result.earlier_sessions.size(), 1u);
    EXPECT_EQ(result.earlier_sessions[0].name, "first");
    EXPECT_EQ(result.earlier_sessions[0].world, 0);
    ASSERT_FALSE(result.earlier_sessions[0].world_from_cam.empty());
    EXPECT_LE(result.earlier_sessions[0].world_from_cam.size(),
              first_->submaps[0].map.keyframes().size());
    for (const TimedPose& keyframe : result.keyframes) {
      EXPECT_GE(keyframe.timestamp, time);
      EXPECT_LE(keyframe.timestamp, time + 2.0);
    }
  }
}

TEST_F(SessionsTest, FindsItselfWithinThreeTenthsOfASecond) {
  for (const int stride : {1, 2}) {  // 30 and 15 Hz
    Odometry odometry(Options(), camera_, LensDistortion());
    odometry.SetMap(Map());
    std::optional<double> found;  // seconds after the first image
    for (int i = kFirst; i < kNumFrames && !found; i += stride) {
      RgbdImage image = (*images_)[i];
      image.id = (i - kFirst) / stride;
      image.timestamp = 100.0 + (i - kFirst) / 30.0;
      if (odometry.Process(image).world == 0) found = image.timestamp - 100.0;
    }
    ASSERT_TRUE(found) << stride;
    EXPECT_LT(*found, 0.3) << stride;
  }
}

TEST_F(SessionsTest, ExtendsTheMap) {
  Odometry odometry(Options(), camera_, LensDistortion());
  Run(100.0, &odometry);
  const std::optional<MapContents> both = odometry.ShareMaps("second");
  ASSERT_TRUE(both);
  ASSERT_EQ(both->sessions.size(), 2u);
  EXPECT_EQ(both->sessions[0].name, "first");
  EXPECT_EQ(both->sessions[1].first_keyframe, first_->submaps[0].map.next_keyframe());
  ASSERT_EQ(both->submaps.size(), 1u);
  const msc_vo::Map& map = both->submaps[0].map;
  EXPECT_EQ(FirstViolation(map), "");
  bool observes_old_landmark = false;
  for (const auto& [id, point] : map.points()) {
    observes_old_landmark |= map.IsOfEarlierSession(point.observations.front().keyframe) &&
                             !map.IsOfEarlierSession(point.observations.back().keyframe);
  }
  EXPECT_TRUE(observes_old_landmark);
  EXPECT_FALSE(map.IsOfEarlierSession(map.keyframes().back().first));
}

// Two runs with planes over the same images, the second in the map of the first.
class PlaneSessionsTest : public SessionsTest {
 protected:
  static MapContents FirstMap() {
    Odometry odometry(Options(), camera_, LensDistortion());
    for (const RgbdImage& image : *images_) odometry.Process(image);
    return *odometry.ShareMaps("first");
  }
  // Expects that hosts and observations name keyframes, features and planes that exist, and that
  // every plane is observed.
  static void ExpectValidPlanes(const SavedSubMap& submap) {
    std::set<LandmarkId> observed;
    for (const auto& [id, matches] : submap.planes.observations) {
      const Keyframe* const keyframe = submap.map.FindKeyframe(id);
      ASSERT_NE(keyframe, nullptr);
      for (const PlaneMatch& match : matches) {
        EXPECT_LT(static_cast<size_t>(match.feature), keyframe->frame->planes.size());
        EXPECT_EQ(submap.planes.planes.count(match.plane), 1u);
        observed.insert(match.plane);
      }
    }
    for (const auto& [id, plane] : submap.planes.planes) {
      EXPECT_NE(submap.map.FindKeyframe(plane.host), nullptr);
      EXPECT_EQ(observed.count(id), 1u);
      EXPECT_GE(plane.extent.size(), 3u);
    }
  }
  // The number of planes that keyframes before and after `first` observe.
  static int NumShared(const SavedSubMap& submap, KeyframeId first) {
    std::set<LandmarkId> before, shared;
    for (const auto& [id, matches] : submap.planes.observations) {  // by ascending id
      for (const PlaneMatch& match : matches) {
        if (id < first) before.insert(match.plane);
        if (id >= first && before.count(match.plane) > 0) shared.insert(match.plane);
      }
    }
    return static_cast<int>(shared.size());
  }
};

TEST_F(PlaneSessionsTest, UseThePlanesOfTheMap) {
  MapContents first = FirstMap();
  ExpectValidPlanes(first.submaps[0]);
  const size_t num_first = first.submaps[0].planes.planes.size();
  EXPECT_GE(num_first, 4u);
  Odometry odometry(Options(), camera_, LensDistortion());
  odometry.SetMap(std::move(first));
  for (int i = kFirst; i < kNumFrames; ++i) {
    RgbdImage image = (*images_)[i];
    image.id = i - kFirst;
    image.timestamp += 100.0;
    odometry.Process(image);
  }
  const OdometryResult result = odometry.Finish();
  EXPECT_EQ(result.segments[1].world, 0);
  EXPECT_LT(LargestDistance(result), 0.01);
  const MapContents both = *odometry.ShareMaps("second");
  ASSERT_EQ(both.submaps.size(), 1u);
  ExpectValidPlanes(both.submaps[0]);
  EXPECT_GE(NumShared(both.submaps[0], both.sessions[1].first_keyframe), 2);
  // Duplicates from before the join become one.
  EXPECT_LT(both.submaps[0].planes.planes.size(), 2 * num_first);
}

TEST_F(PlaneSessionsTest, MergedMapsShareTheirPlanes) {
  MapContents first = FirstMap(), second = FirstMap();
  const size_t num_first = first.submaps[0].planes.planes.size();
  second.submaps[0].map.Transform(
      {Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY())), {3.0, -1.0, 2.0}});
  const MapMerge merge = MergeMaps(Options(), std::move(first), std::move(second));
  ASSERT_EQ(merge.contents.submaps.size(), 1u);
  ExpectValidPlanes(merge.contents.submaps[0]);
  EXPECT_GE(NumShared(merge.contents.submaps[0], merge.contents.sessions[1].first_keyframe), 2);
  EXPECT_LT(merge.contents.submaps[0].planes.planes.size(), 2 * num_first);
}

// A third run in the map of two, which share a world, or have one each.
TEST_F(SessionsTest, NamesTheKeyframesOfEarlierSessions) {
  for (const bool is_elsewhere : {false, true}) {
    Odometry second(Options(), camera_, LensDistortion());
    SyntheticSequenceOptions other = RoomOptions();
    other.seed = 7;
    if (is_elsewhere) {
      second.SetMap(Map());
      for (const RgbdImage& image : RenderImages(other, 30)) second.Process(image);
      EXPECT_EQ(second.Finish().earlier_sessions.size(), 1u);
    } else {
      Run(100.0, &second);
    }
    MapContents both = *second.ShareMaps("second");
    ASSERT_EQ(both.submaps.size(), is_elsewhere ? 2u : 1u);
    const Rigid3 last_pose = both.submaps.back().map.keyframes().back().second.cam_from_world;
    Odometry third(Options(), camera_, LensDistortion());
    third.SetMap(std::move(both));
    third.Process((*images_)[0]);
    const std::vector<SessionPath> sessions = third.Finish().earlier_sessions;
    ASSERT_EQ(sessions.size(), 2u);
    EXPECT_EQ(sessions[0].name, "first");
    EXPECT_EQ(sessions[1].name, "second");
    EXPECT_EQ(sessions[1].world, is_elsewhere ? 1 : 0);
    EXPECT_LT((sessions[1].world_from_cam.back().translation() - last_pose.OriginInSource()).norm(),
              1e-9);
  }
}

TEST_F(SessionsTest, KeepsPosesInTheMapOnly) {
  Odometry odometry(Options(), camera_, LensDistortion());
  const int first = FirstLocalizedFrame(Run(100.0, &odometry)).value();
  const OdometryResult result = odometry.Finish(true);
  EXPECT_GT(first, 0);
  for (int i = 0; i < kNumFrames - kFirst; ++i) {
    EXPECT_EQ(IsEstimated(result.frames[i].status), i >= first) << i;
    EXPECT_EQ(result.frames[i].world, i >= first ? 0 : kNoSegment) << i;
  }
  EXPECT_LT(LargestDistance(result, static_cast<size_t>(first)), 0.01);
  EXPECT_EQ(result.segments[1].num_estimated, kNumFrames - kFirst - first);
  EXPECT_GE(result.keyframes.at(0).timestamp, result.frames[first].timestamp);
}

TEST_F(SessionsTest, KeepsNoPoseOfAnUnknownPlace) {
  SyntheticSequenceOptions other = RoomOptions();
  other.seed = 7;
  Odometry odometry(Options(), camera_, LensDistortion());
  odometry.SetMap(Map());
  for (const RgbdImage& image : RenderImages(other, 30)) {
    const FrameResult frame = odometry.Process(image);
    EXPECT_EQ(frame.world, 1);
    EXPECT_FALSE(IsEstimated(KeepLocalizedPose(1, frame).status));
  }
  const OdometryResult result = odometry.Finish();
  EXPECT_EQ(result.map_world, 1);
  EXPECT_FALSE(FirstLocalizedFrame(result));
  EXPECT_FALSE(result.points.empty());
  const std::optional<MapContents> both = odometry.ShareMaps("second");
  ASSERT_TRUE(both);
  EXPECT_EQ(both->submaps.size(), 2u);
  const OdometryResult kept = odometry.Finish(true);
  for (const FrameResult& frame : kept.frames) EXPECT_FALSE(IsEstimated(frame.status));
  EXPECT_TRUE(kept.points.empty() && !result.planes.empty() && kept.planes.empty());
}

TEST_F(SessionsTest, LocalizerGivesPosesInTheMapOnly) {
  Localizer localizer(Options(), camera_, LensDistortion(), Map());
  int first = kNumFrames;
  for (int i = 0; i < kNumFrames; ++i) {
    const FrameResult frame = localizer.Process((*images_)[i]);
    if (IsEstimated(frame.status)) first = std::min(first, i);
    EXPECT_EQ(IsEstimated(frame.status), i >= first) << i;
    EXPECT_EQ(frame.world, i >= first ? 0 : kNoSegment) << i;
  }
  EXPECT_GT(first, 0);
  EXPECT_LT(first, 25);
  const OdometryResult result = localizer.Finish();
  EXPECT_TRUE(IsEstimated(result.frames[first].status));
  EXPECT_FALSE(IsEstimated(result.frames[0].status));
  EXPECT_THROW(Localizer(Options(), camera_, LensDistortion(), {}), std::invalid_argument);
}

// Both were made by the same images: the second one is where the first one is.
TEST_F(SessionsTest, MergesMapsOfTheSamePlace) {
  MapContents second = Map();
  second.submaps[0].noise_scale = {2.0, 2.0, 2.0};
  const Rigid3 moved(Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY())),
                     {3.0, -1.0, 2.0});
  second.submaps[0].map.Transform(moved);
  const msc_vo::Map& one = first_->submaps[0].map;
  const MapMerge merge = MergeMaps(Options(), Map(), std::move(second));
  ASSERT_EQ(merge.joins.size(), 1u);
  ASSERT_EQ(merge.contents.submaps.size(), 1u);
  ASSERT_EQ(merge.contents.sessions.size(), 2u);
  EXPECT_EQ(merge.contents.sessions[1].first_keyframe, one.next_keyframe());
  const Rigid3 error = merge.joins[0].moved_from_kept * moved.Inverse();
  EXPECT_LT(error.translation().norm(), 0.005);
  EXPECT_LT(error.rotation().angularDistance(Eigen::Quaterniond::Identity()), 0.002);
  EXPECT_NEAR(merge.contents.submaps[0].noise_scale.line_pixel,
              first_->submaps[0].noise_scale.line_pixel, 1e-9);
  const msc_vo::Map& both = merge.contents.submaps[0].map;
  EXPECT_EQ(FirstViolation(both), "");
  EXPECT_LT(both.points().size(), 1.1 * one.points().size());  // measured: 892 and 978
  for (const auto& [id, keyframe] : one.keyframes()) {
    if (both.FindKeyframe(id) == nullptr) continue;  // redundant now
    EXPECT_EQ(both.CamFromWorld(id).params, keyframe.cam_from_world.params);
  }
}

TEST_F(SessionsTest, MergesMapsWithoutKeyframes) {
  MapContents empty;
  empty.sessions = {{0, "empty"}};
  empty.submaps.emplace_back();
  const MapMerge after = MergeMaps(Options(), std::move(empty), Map());
  EXPECT_TRUE(after.joins.empty());
  ASSERT_EQ(after.contents.submaps.size(), 1u);
  EXPECT_EQ(after.contents.sessions.size(), 2u);
  MapContents again;
  again.submaps.emplace_back();
  const MapMerge before = MergeMaps(Options(), Map(), std::move(again));
  ASSERT_EQ(before.contents.submaps.size(), 1u);
  EXPECT_EQ(before.contents.submaps[0].map.points().size(), first_->submaps[0].map.points().size());
}

TEST_F(SessionsTest, MergesNothingOfAnotherPlace) {
  SyntheticSequenceOptions other = RoomOptions();
  other.seed = 7;
  Odometry odometry(Options(), camera_, LensDistortion());
  for (const RgbdImage& image : RenderImages(other, 30)) odometry.Process(image);
  const MapMerge merge = MergeMaps(Options(), Map(), *odometry.ShareMaps("elsewhere"));
  EXPECT_TRUE(merge.joins.empty());
  EXPECT_EQ(merge.contents.submaps.size(), 2u);
  EXPECT_EQ(merge.contents.submaps[1].id, 1);
}

// The same scene, seen with another focal length and image size.
TEST_F(SessionsTest, FindsItselfWithAnotherCamera) {
  SyntheticSequenceOptions other = RoomOptions();
  other.width = 400;
  other.height = 300;
  const SyntheticSequence sequence(other);
  Odometry odometry(Options(), sequence.camera(), LensDistortion());
  odometry.SetMap(Map());
  for (const RgbdImage& image : RenderImages(other, kNumFrames)) odometry.Process(image);
  const OdometryResult result = odometry.Finish();
  ASSERT_TRUE(FirstLocalizedFrame(result));
  double largest = 0.0;
  for (int i = 0; i < kNumFrames; ++i) {
    largest = std::max(largest, (first_result_->frames[i].cam_from_world.OriginInSource() -
                                 result.frames[i].cam_from_world.OriginInSource())
                                    .norm());
  }
  EXPECT_LT(largest, 0.02);
}

TEST_F(SessionsTest, RefusesAMapAfterTheFirstImage) {
  Odometry odometry(Options(), camera_, LensDistortion());
  odometry.Process(images_->front());
  EXPECT_THROW(odometry.SetMap(Map()), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
