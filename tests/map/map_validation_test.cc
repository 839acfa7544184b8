// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map_validation.h"

#include <limits>
#include <memory>

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<const Frame> MakeFrame(size_t num_points) {
  auto frame = std::make_shared<Frame>();
  frame->points.resize(num_points);
  frame->lines.resize(2);
  return frame;
}

class MapValidationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (KeyframeId& keyframe : keyframes_) keyframe = map_.AddKeyframe(MakeFrame(3), Rigid3());
    point_ = map_.Add<PointLandmark>(keyframes_[0], 1, {0.1, 0.0, 2.0});
    line_ = map_.Add<LineLandmark>(keyframes_[0], 0, {{0.0, 0.0, 2.0}, {0.0, 1.0, 2.0}});
    map_.Observe<PointLandmark>(point_, keyframes_[1], 2);
    map_.Observe<LineLandmark>(line_, keyframes_[1], 1);
    map_.Refresh<PointLandmark>(point_);
    map_.Refresh<LineLandmark>(line_);
  }
  Map map_;
  KeyframeId keyframes_[2] = {};
  LandmarkId point_ = kNoId, line_ = kNoId;
};

TEST_F(MapValidationTest, AcceptsMapAndItsChanges) {
  EXPECT_THAT(FirstViolation(Map()), IsEmpty());
  EXPECT_THAT(FirstViolation(map_), IsEmpty());
  map_.RemoveObservation<PointLandmark>(point_, keyframes_[0]);
  EXPECT_THAT(FirstViolation(map_), IsEmpty());
  map_.RemoveKeyframe(keyframes_[0], keyframes_[1]);
  EXPECT_THAT(FirstViolation(map_), IsEmpty());
}

TEST_F(MapValidationTest, FindsNumbersThatAreNotFinite) {
  Map map = map_.Share();
  map.SetGeometry<PointLandmark>(point_, {0.0, kNan, 1.0});
  EXPECT_THAT(FirstViolation(map), Names("point " + std::to_string(point_), "position", "finite"));
  map = map_.Share();
  map.SetGeometry<LineLandmark>(line_, {{0.0, 0.0, kNan}, {0.0, 1.0, 2.0}});
  EXPECT_THAT(FirstViolation(map), Names("line " + std::to_string(line_), "end points", "finite"));
  map = map_.Share();
  map.SetPose(keyframes_[1], Rigid3(Eigen::Quaterniond::Identity(), {kNan, 0.0, 0.0}));
  EXPECT_THAT(FirstViolation(map),
              Names("keyframe " + std::to_string(keyframes_[1]), "pose", "finite"));
}

TEST_F(MapValidationTest, FindsGeometryWithoutMeaning) {
  Map map = map_.Share();
  map.SetGeometry<LineLandmark>(line_, {{0.0, 1.0, 2.0}, {0.0, 1.0, 2.0}});
  EXPECT_THAT(FirstViolation(map), Names("line " + std::to_string(line_), "length"));
  map = map_.Share();
  map.SetNoise<PointLandmark>(point_, 0.0);
  EXPECT_THAT(FirstViolation(map), Names("point " + std::to_string(point_), "noise"));
  map = map_.Share();
  map.SetPose(keyframes_[0], Rigid3(Eigen::Quaterniond(2.0, 0.0, 0.0, 0.0), {0.0, 0.0, 0.0}));
  EXPECT_THAT(FirstViolation(map), Names("keyframe " + std::to_string(keyframes_[0]), "rotation"));
}

TEST_F(MapValidationTest, FindsFrameWithOtherFeatures) {
  map_.SetFrame(keyframes_[1], MakeFrame(4));
  EXPECT_THAT(FirstViolation(map_),
              Names("keyframe " + std::to_string(keyframes_[1]), "entry", "feature"));
}

}  // namespace
}  // namespace msc_vo
