// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/plane_map.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

const Plane kWall({0.0, 0.0, -1.0}, 2.0), kFloor({0.0, -1.0, 0.0}, 1.4);

PlaneFeature FeatureOf(const Plane& in_cam) {
  PlaneFeature feature;
  feature.inverse_depth = -in_cam.normal() / in_cam.offset();
  feature.covariance = 1.6e-5 * Eigen::Matrix3d::Identity();
  feature.mean_square_ray = Eigen::Vector3d(0.1, 0.06, 1.0).asDiagonal();
  return feature;
}

// Three keyframes that see a wall and the floor.
class PlaneMapTest : public testing::Test {
 protected:
  PlaneMapTest() {
    for (int i = 0; i < 3; ++i) Add({ExpSO3({0.0, 0.1 * i, 0.0}), {0.1 * i, 0.0, 0.05 * i}});
  }
  void Add(const Rigid3& pose) {
    auto frame = std::make_shared<Frame>();
    frame->planes = {FeatureOf(pose * kWall), FeatureOf(pose * kFloor)};
    planes_.AddKeyframe(map_, map_.AddKeyframe(frame, pose));
  }
  // The largest difference of the parameters of the planes from those of wall and floor, moved.
  double Error(const Rigid3& moved) const {
    const MapPlanes found = planes_.InWorld(map_);
    if (found.planes.size() != 2) return std::numeric_limits<double>::infinity();
    return std::max((found.planes[0].plane.params - (moved * kWall).params).norm(),
                    (found.planes[1].plane.params - (moved * kFloor).params).norm());
  }

  Map map_;
  PlaneMap planes_;
};

TEST_F(PlaneMapTest, FindsThePlanesOfOneKeyframeInTheOthers) { EXPECT_LT(Error({}), 1e-9); }

TEST_F(PlaneMapTest, PlanesMoveWithTheMap) {
  const Rigid3 new_from_old(ExpSO3({0.2, 0.1, -0.3}), {1.0, -2.0, 0.5});
  map_.Transform(new_from_old);
  EXPECT_LT(Error(new_from_old), 1e-9);
}

TEST_F(PlaneMapTest, PlanesOutliveTheirFirstKeyframe) {
  map_.RemoveKeyframe(0, 1);
  planes_.Renew(map_);
  EXPECT_LT(Error({}), 1e-9);
}

TEST_F(PlaneMapTest, PlanesThatNoKeyframeObservesAreForgotten) {
  planes_.Renew(Map());
  EXPECT_TRUE(planes_.empty());
}

TEST_F(PlaneMapTest, WindowsTieKeyframesToThePlanesThatTwoObserve) {
  WindowData window;
  for (const auto& [id, keyframe] : map_.keyframes()) {
    window.keyframes.push_back({id, keyframe.cam_from_world});
  }
  planes_.AddTo(map_, &window);
  EXPECT_EQ(window.custom_factors.size(), 6u);
  ASSERT_EQ(window.extra_blocks.size(), 2u);
  for (const ExtraBlock& block : window.extra_blocks) EXPECT_LT(block.id, PlaneMap::kFirstBlock);
  window.keyframes.resize(1);
  window.custom_factors.clear();
  window.extra_blocks.clear();
  planes_.AddTo(map_, &window);
  EXPECT_TRUE(window.custom_factors.empty() && window.extra_blocks.empty());
}

TEST_F(PlaneMapTest, LearnsEstimatesOfWindows) {
  WindowData window;
  for (const auto& [id, keyframe] : map_.keyframes()) {
    window.keyframes.push_back({id, keyframe.cam_from_world});
  }
  planes_.AddTo(map_, &window);
  const Plane estimate(kFloor.normal(), kFloor.offset() + 0.01);
  for (ExtraBlock& block : window.extra_blocks) {
    if (block.value[3] < 1.5) block.value = estimate.params;
  }
  planes_.Learn(map_, window);
  EXPECT_LT((planes_.InWorld(map_).planes[1].plane.params - estimate.params).norm(), 1e-9);
}

TEST_F(PlaneMapTest, JoinsKeepThePlanesOfBothMaps) {
  PlaneMap other;
  auto frame = std::make_shared<Frame>();
  frame->planes = {FeatureOf(kWall)};
  Map other_map = map_.Next();
  const KeyframeId keyframe = other_map.AddKeyframe(frame, {}, 7);
  other.AddKeyframe(other_map, keyframe);
  map_.Merge(other_map);
  planes_.Join(std::move(other));
  EXPECT_EQ(planes_.InWorld(map_).planes.size(), 3u);
}

}  // namespace
}  // namespace msc_vo
