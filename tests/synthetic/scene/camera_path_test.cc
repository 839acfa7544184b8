// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

constexpr double kFrame = 1.0 / 30.0;  // seconds

struct Case {
  SceneKind kind;
  uint64_t seed;
};

class CameraPathTest : public ::testing::TestWithParam<Case> {
 protected:
  CameraPathTest()
      : scene_(MakeScene(GetParam().kind, GetParam().seed)), path_(scene_, Options()) {}

  static PathOptions Options() {
    PathOptions options;
    options.seed = GetParam().seed;
    return options;
  }
  int NumFrames() const { return static_cast<int>(1.1 * path_.LoopSeconds() / kFrame); }

  Scene scene_;
  CameraPath path_;
};

TEST_P(CameraPathTest, StaysInFreeSpace) {
  for (int i = 0; i < NumFrames(); i += 3) {
    const Vec center = path_.CamFromWorld(i * kFrame).OriginInSource();
    ASSERT_GT(scene_.Clearance(center), 0.3) << "frame " << i;
  }
}

TEST_P(CameraPathTest, DoesNotCrossSurfaces) {
  // There is no surface between successive positions, visible from either of them.
  Vec last = path_.CamFromWorld(0.0).OriginInSource();
  for (int i = 10; i < NumFrames(); i += 10) {
    const Vec here = path_.CamFromWorld(i * kFrame).OriginInSource();
    const auto forth = scene_.CastRay(last, here - last), back = scene_.CastRay(here, last - here);
    ASSERT_TRUE(!forth || *forth > 1.0) << "frame " << i;
    ASSERT_TRUE(!back || *back > 1.0) << "frame " << i;
    last = here;
  }
}

TEST_P(CameraPathTest, MovesLikeHandHeldCamera) {
  Rigid3 last = path_.CamFromWorld(0.0);
  double distance = 0.0, turn = 0.0, fastest = 0.0, fastest_turn = 0.0;
  for (int i = 1; i < NumFrames(); ++i) {
    const Rigid3 here = path_.CamFromWorld(i * kFrame);
    const double speed = (here.OriginInSource() - last.OriginInSource()).norm() / kFrame;
    const double rate = LogSO3((here * last.Inverse()).rotation()).norm() / kFrame;
    distance += speed * kFrame;
    turn += rate * kFrame;
    fastest = std::max(fastest, speed);
    fastest_turn = std::max(fastest_turn, rate);
    last = here;
  }
  const double seconds = NumFrames() * kFrame;
  EXPECT_GT(distance / seconds, 0.15);
  EXPECT_LT(distance / seconds, 0.5);
  EXPECT_LT(fastest, 0.6);
  EXPECT_GT(turn / seconds, DegreesToRadians(5.0));
  EXPECT_LT(fastest_turn, DegreesToRadians(40.0));
}

TEST_P(CameraPathTest, VelocityIsContinuous) {
  const double step = 0.01;  // seconds
  Vec last = path_.CamFromWorld(0.0).OriginInSource();
  Vec last_velocity = (path_.CamFromWorld(step).OriginInSource() - last) / step;
  last = path_.CamFromWorld(step).OriginInSource();
  // A walk that is no loop stops at its end, which the pace moves by up to half a second.
  const double end = scene_.tour_is_loop ? 20.0 : std::min(20.0, path_.LoopSeconds() - 0.5);
  for (int i = 2; i * step < end; ++i) {
    const Vec here = path_.CamFromWorld(i * step).OriginInSource();
    const Vec velocity = (here - last) / step;
    // 2 m/s^2, a typical acceleration of a hand.
    ASSERT_LT((velocity - last_velocity).norm() / step, 2.0) << "second " << i * step;
    last = here;
    last_velocity = velocity;
  }
}

TEST_P(CameraPathTest, KeepsStructureInViewAndHorizonLevel) {
  for (int i = 0; i < NumFrames(); i += 15) {
    const Rigid3 world_from_cam = path_.CamFromWorld(i * kFrame).Inverse();
    const Vec forward = world_from_cam.rotation() * Vec::UnitZ();
    const Vec right = world_from_cam.rotation() * Vec::UnitX();
    const auto distance = scene_.CastRay(world_from_cam.translation(), forward);
    ASSERT_TRUE(distance.has_value());
    EXPECT_GT(*distance, 0.4) << "frame " << i;
    EXPECT_LT(std::abs(right.z()), 0.05) << "frame " << i;
    EXPECT_LT(std::abs(forward.z()), 0.6) << "frame " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CameraPathTest,
                         ::testing::Values(Case{SceneKind::kRoom, 1}, Case{SceneKind::kRoom, 2},
                                           Case{SceneKind::kRoom, 9}, Case{SceneKind::kCorridor, 1},
                                           Case{SceneKind::kCorridor, 4}, Case{SceneKind::kBare, 1},
                                           Case{SceneKind::kBare, 7}, Case{SceneKind::kSlanted, 1},
                                           Case{SceneKind::kSlanted, 5}, Case{SceneKind::kHouse, 1},
                                           Case{SceneKind::kRooms, 1},
                                           Case{SceneKind::kMirrored, 2},
                                           Case{SceneKind::kFloors, 3},
                                           Case{SceneKind::kDesks, 4}));

TEST(CameraPathOptionsTest, WalksBeginAndEndAtTheEndsOfTheirTour) {
  const Scene scene = MakeScene(SceneKind::kFloors, 1);
  PathOptions options;
  options.shake = 0.0;
  const CameraPath path(scene, options);
  const double end = path.LoopSeconds() + 1.0;
  EXPECT_LT((path.CamFromWorld(0.0).OriginInSource() - scene.tour.front().position).norm(), 1e-6);
  EXPECT_LT((path.CamFromWorld(end).OriginInSource() - scene.tour.back().position).norm(), 1e-6);
  EXPECT_EQ(path.CamFromWorld(end).params, path.CamFromWorld(end + 5.0).params);
}

TEST(CameraPathOptionsTest, IsDeterminedBySeed) {
  const Scene scene = MakeScene(SceneKind::kRoom, 1);
  PathOptions options;
  const CameraPath a(scene, options), b(scene, options);
  options.seed = 2;
  const CameraPath c(scene, options);
  EXPECT_EQ(a.CamFromWorld(1.0).params, b.CamFromWorld(1.0).params);
  EXPECT_GT((a.CamFromWorld(1.0).params - c.CamFromWorld(1.0).params).norm(), 1e-3);
}

TEST(CameraPathOptionsTest, RoundsDoNotRepeat) {
  const Scene scene = MakeScene(SceneKind::kRoom, 1);
  const CameraPath path(scene, PathOptions());
  const double round = path.LoopSeconds();
  EXPECT_GT((path.CamFromWorld(2.0).params - path.CamFromWorld(2.0 + round).params).norm(), 1e-3);
}

TEST(CameraPathOptionsTest, ThrowsOnInvalidOptionsOrTour) {
  const Scene scene = MakeScene(SceneKind::kRoom, 1);
  PathOptions options;
  options.speed = 0.0;
  EXPECT_THROW(CameraPath(scene, options), std::invalid_argument);
  EXPECT_THROW(CameraPath(Scene(), PathOptions()), std::invalid_argument);
}

TEST(LookAtTest, CentresTargetAndKeepsCameraUpright) {
  const Rigid3 cam_from_world = LookAt({1, 2, 1.5}, {4, -2, 0.5});
  const Vec target = cam_from_world * Vec(4, -2, 0.5);
  EXPECT_NEAR(target.x(), 0.0, 1e-12);
  EXPECT_NEAR(target.y(), 0.0, 1e-12);
  EXPECT_NEAR(target.z(), std::sqrt(26.0), 1e-12);
  EXPECT_LT((cam_from_world * Vec(4, -2, 1.5)).y(), 0.0);  // y points down in the image
  EXPECT_LT((cam_from_world.OriginInSource() - Vec(1, 2, 1.5)).norm(), 1e-12);
}

}  // namespace
}  // namespace msc_vo
