// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/synthetic/scene/small_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/renderer.h"
#include "msc_vo/synthetic/scene/surface_view.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

using Vec = Eigen::Vector3d;

// The walk of a person in a hurry, of whom every third image is taken.
PathOptions BriskWalk(uint64_t seed) {
  PathOptions options;
  options.speed = 0.55;
  options.turn_rate = DegreesToRadians(55.0);
  options.seed = seed;
  return options;
}

class LookAlikesTest : public ::testing::TestWithParam<SceneKind> {
 protected:
  // Grey image of a look-alike from a camera of its part, reflected if the look-alike is.
  static std::vector<uint8_t> View(const Scene& scene, const Placement& placement,
                                   const Waypoint& camera) {
    const auto point = [&](const Vec& x) { return Vec(placement.linear * x + placement.offset); };
    const Renderer renderer(scene, kSmallCamera);
    const RenderedImage image =
        renderer.Render(LookAt(point(camera.position), point(camera.target)));
    std::vector<uint8_t> gray = image.Gray();
    if (placement.linear.determinant() > 0.0) return gray;
    for (int y = 0; y < kSmallCamera.height; ++y) {
      std::reverse(gray.begin() + y * kSmallCamera.width,
                   gray.begin() + (y + 1) * kSmallCamera.width);
    }
    return gray;
  }

  // Cameras in the part of a scene, away from views of other parts.
  static std::vector<Waypoint> Cameras() {
    if (GetParam() == SceneKind::kDesks) return {{{0, 1.3, 1.45}, {0.1, 2.4, 1.1}}};
    return {{{-0.4, 1.2, 1.45}, {0.0, 3.0, 1.2}},
            {{0.5, 1.6, 1.4}, {-2.0, 2.0, 1.1}},
            {{-0.2, 1.3, 1.5}, {2.0, 1.4, 1.1}}};
  }

  // Ratio of the pixels that differ by more than a camera's noise.
  static double Difference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    int count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 4 ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(a.size());
  }
};

TEST_P(LookAlikesTest, CopiesLookIdenticalInEvenSeeds) {
  for (const uint64_t seed : {2, 8, 14}) {
    const Scene scene = MakeScene(GetParam(), seed);
    ASSERT_GE(scene.look_alikes.size(), 2u);
    for (const Waypoint& camera : Cameras()) {
      const std::vector<uint8_t> first = View(scene, scene.look_alikes[0], camera);
      for (const Placement& placement : scene.look_alikes) {
        EXPECT_LT(Difference(first, View(scene, placement, camera)), 0.002) << seed;
      }
    }
  }
}

TEST_P(LookAlikesTest, CopiesDifferInASmallThingInOddSeeds) {
  const Waypoint camera = GetParam() == SceneKind::kDesks
                              ? Waypoint{{0.4, 1.9, 1.75}, {0.5, 2.9, 1.75}}
                              : Waypoint{{0.3, 1.6, 1.5}, {0.4, 0.0, 1.5}};
  const Scene scene = MakeScene(GetParam(), 3);
  for (size_t i = 1; i < scene.look_alikes.size(); ++i) {
    const double difference = Difference(View(scene, scene.look_alikes[0], camera),
                                         View(scene, scene.look_alikes[i], camera));
    EXPECT_GT(difference, 0.003);
    EXPECT_LT(difference, 0.1);
  }
}

TEST_P(LookAlikesTest, SurfacesDependOnTheSeedAlone) {
  const Scene a = MakeScene(GetParam(), 5, {1, false}), b = MakeScene(GetParam(), 5, {2, true});
  ASSERT_EQ(a.quads.size(), b.quads.size());
  for (size_t i = 0; i < a.quads.size(); ++i) {
    EXPECT_EQ(a.quads[i].origin, b.quads[i].origin);
    EXPECT_EQ(a.quads[i].texture.seed, b.quads[i].texture.seed);
  }
  const Scene other = MakeScene(GetParam(), 5, {2, false});
  EXPECT_NE(a.tour.front().position, other.tour.front().position);
}

TEST_P(LookAlikesTest, WalksStayInFreeSpace) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    for (const WalkOptions& walk : {WalkOptions{1, false}, WalkOptions{1, true},
                                    WalkOptions{2 + seed, false}, WalkOptions{2 + seed, true}}) {
      const Scene scene = MakeScene(GetParam(), seed, walk);
      const CameraPath path(scene, BriskWalk(seed));
      Vec last = path.CamFromWorld(0.0).OriginInSource();
      for (double seconds = 0.3; seconds < path.LoopSeconds(); seconds += 0.3) {
        const Vec here = path.CamFromWorld(seconds).OriginInSource();
        ASSERT_GT(scene.Clearance(here), 0.3) << seed << ", second " << seconds;
        const auto wall = scene.CastRay(last, here - last);
        ASSERT_TRUE(!wall || *wall > 1.0) << seed << ", second " << seconds;
        last = here;
      }
    }
  }
}

TEST_P(LookAlikesTest, WalksVisitSeveralLookAlikesInFourHundredImages) {
  const Vec middle(0.0, GetParam() == SceneKind::kDesks ? 0.0 : 1.2, 1.45);
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    for (const bool returns : {false, true}) {
      const Scene scene = MakeScene(GetParam(), seed, {seed % 3 + 1, returns});
      const CameraPath path(scene, BriskWalk(seed));
      EXPECT_LT(path.LoopSeconds(), 39.5) << seed << returns;
      int num_visited = 0;
      for (const Placement& placement : scene.look_alikes) {
        const Vec place = placement.linear * middle + placement.offset;
        double nearest = 100.0;
        for (double seconds = 0.0; seconds < path.LoopSeconds(); seconds += 0.2) {
          nearest = std::min(nearest, (path.CamFromWorld(seconds).OriginInSource() - place).norm());
        }
        num_visited += nearest < 0.6 ? 1 : 0;
      }
      EXPECT_GE(num_visited, 2) << seed;
    }
  }
}

TEST_P(LookAlikesTest, WalksReturnOnlyOnRequest) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    for (const bool returns : {false, true}) {
      SyntheticSequenceOptions options;
      options.scene = GetParam();
      options.seed = seed;
      options.walk = {1, returns};
      options.fps = 2.0;
      options.path = BriskWalk(seed);
      const SyntheticSequence sequence(options);
      std::vector<SurfaceView> views;
      for (int i = 0; i < *sequence.WalkLength(); ++i) {
        views.push_back(sequence.SurfacesAt(i, 32));
      }
      EXPECT_EQ(!FindReturns(views).empty(), returns) << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LookAlikesTest,
                         ::testing::Values(SceneKind::kRooms, SceneKind::kMirrored,
                                           SceneKind::kFloors, SceneKind::kDesks),
                         [](const auto& scene) {
                           return SceneKindNames()[static_cast<int>(scene.param)];
                         });

TEST(MirroredSceneTest, HasReflectedAndRotatedCopies) {
  const Scene scene = MakeScene(SceneKind::kMirrored, 4);
  ASSERT_EQ(scene.look_alikes.size(), 4u);
  EXPECT_EQ(std::count_if(scene.look_alikes.begin(), scene.look_alikes.end(),
                          [](const Placement& p) { return p.linear.determinant() < 0.0; }),
            2);
}

TEST(GallerySceneTest, ShowsTheSameThingInHallsThatDiffer) {
  for (const uint64_t seed : {1, 2}) {
    const Scene scene = MakeScene(SceneKind::kGallery, seed);
    ASSERT_EQ(scene.look_alikes.size(), 2u);
    // Distance of the surface in front of a visitor of the exhibit, by the direction of the view.
    const auto distance = [&](int hall, const Vec& direction) {
      const Placement& place = scene.look_alikes[hall];
      return *scene.CastRay(place.linear * Vec(0.0, 1.6, 1.45) + place.offset,
                            place.linear * direction);
    };
    for (const double x : {-0.5, -0.4, -0.3}) {  // to the board, or the bookcase
      EXPECT_NEAR(distance(0, {x, -1.0, 0.0}), distance(1, {x, -1.0, 0.0}), 1e-9) << seed;
    }
    double largest_difference = 0.0;  // of the walls on either side
    for (const double x : {-1.0, 1.0}) {
      const double difference = distance(0, {x, 0.0, 0.0}) - distance(1, {x, 0.0, 0.0});
      largest_difference = std::max(largest_difference, std::abs(difference));
    }
    EXPECT_GT(largest_difference, 0.05) << seed;
  }
}

TEST(GallerySceneTest, PathsVisitItsHallsInTurn) {
  const auto hall_of = [](const WalkOptions& walk) {
    const Scene scene = MakeScene(SceneKind::kGallery, 3, walk);
    const auto distance = [&](int hall) {
      return (scene.tour.front().position - scene.look_alikes[hall].offset).norm();
    };
    return distance(0) < distance(1) ? 0 : 1;
  };
  EXPECT_EQ(hall_of({1, false}), 0);
  EXPECT_EQ(hall_of({2, false}), 1);
  EXPECT_EQ(hall_of({3, false}), 0);
}

TEST(GallerySceneTest, WalksStayInFreeSpace) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = MakeScene(SceneKind::kGallery, seed, {1 + seed % 5, false});
    const CameraPath path(scene, BriskWalk(seed));
    for (double seconds = 0.0; seconds < path.LoopSeconds(); seconds += 0.3) {
      EXPECT_GT(scene.Clearance(path.CamFromWorld(seconds).OriginInSource()), 0.3) << seed;
    }
  }
}

TEST(OtherPathTest, MovesTheTourThroughTheSameRoom) {
  for (const SceneKind kind : {SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kHouse}) {
    const Scene first = MakeScene(kind, 4), other = MakeScene(kind, 4, {2, false});
    ASSERT_EQ(first.quads.size(), other.quads.size());
    double sum = 0.0;
    for (size_t i = 0; i < first.tour.size(); ++i) {
      sum += (first.tour[i].position - other.tour[i].position).norm();
    }
    EXPECT_GT(sum / static_cast<double>(first.tour.size()), 0.05);
    const CameraPath path(other, PathOptions());
    for (double seconds = 0.0; seconds < path.LoopSeconds(); seconds += 0.3) {
      ASSERT_GT(other.Clearance(path.CamFromWorld(seconds).OriginInSource()), 0.3);
    }
  }
}

}  // namespace
}  // namespace msc_vo
