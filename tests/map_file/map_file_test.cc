// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "tests/map_file/random_map.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/map/map_validation.h"
#include "msc_vo/map_file/internal/plane_rows.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

void ExpectEqual(const PointFeature& a, const PointFeature& b) {
  EXPECT_LT((a.pixel - b.pixel).lpNorm<Eigen::Infinity>(), 0.51 / 256);
  EXPECT_NEAR(a.sigma, b.sigma, 1e-3 * b.sigma);
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.dynamic, b.dynamic);
  EXPECT_NEAR(a.angle, b.angle, 0.02);
  EXPECT_NEAR(a.inverse_depth, b.inverse_depth, 1e-7);
  EXPECT_NEAR(a.inverse_depth_sigma, b.inverse_depth_sigma, 3e-3 * b.inverse_depth_sigma);
  EXPECT_EQ(a.descriptor, b.descriptor);
}

void ExpectEqual(const LineFeature& a, const LineFeature& b) {
  EXPECT_LT((a.segment.start - b.segment.start).lpNorm<Eigen::Infinity>(), 0.51 / 256);
  EXPECT_LT((a.segment.end - b.segment.end).lpNorm<Eigen::Infinity>(), 0.51 / 256);
  EXPECT_NEAR(a.sigma, b.sigma, 1e-3 * b.sigma);
  ASSERT_EQ(a.HasDepth(), b.HasDepth());
  EXPECT_EQ(a.descriptor, b.descriptor);
  if (!a.HasDepth()) return;
  EXPECT_NEAR(a.depth->start, b.depth->start, 1e-7);
  EXPECT_NEAR(a.depth->end, b.depth->end, 1e-7);
  EXPECT_LT((a.depth->covariance - b.depth->covariance).norm(), 3e-3 * b.depth->covariance.norm());
  EXPECT_EQ(a.depth->num_inliers, b.depth->num_inliers);
  EXPECT_NEAR(a.depth->inlier_ratio, b.depth->inlier_ratio, 1e-3);
}

void ExpectEqual(const PointLandmark& a, const PointLandmark& b) {
  EXPECT_LT((a.position - b.position).norm(), 1e-6);
  EXPECT_NEAR(a.reference_distance, b.reference_distance, 1e-5 * b.reference_distance);
}

void ExpectEqual(const LineLandmark& a, const LineLandmark& b) {
  EXPECT_LT((a.segment.start - b.segment.start).norm(), 1e-6);
  EXPECT_LT((a.segment.end - b.segment.end).norm(), 1e-6);
  EXPECT_NEAR(a.depth_offset, b.depth_offset, 1e-6);
  EXPECT_NEAR(a.direction_sigma, b.direction_sigma, 1e-2 * b.direction_sigma);
}

template <typename L>
void ExpectSameLandmarks(const Map& loaded, const Map& saved) {
  ASSERT_EQ(loaded.landmarks<L>().size(), saved.landmarks<L>().size());
  for (const auto& [id, landmark] : saved.landmarks<L>()) {
    const L* const found = loaded.Find<L>(id);
    ASSERT_NE(found, nullptr);
    ExpectEqual(*found, landmark);
    EXPECT_EQ(found->first_keyframe, landmark.first_keyframe);
    EXPECT_EQ(found->num_visible, landmark.num_visible);
    EXPECT_EQ(found->num_found, landmark.num_found);
    EXPECT_EQ(found->noise, landmark.noise);
    EXPECT_EQ(found->has_false_depth, landmark.has_false_depth);
    EXPECT_LT((found->viewing_direction - landmark.viewing_direction).norm(), 1e-5);
    ASSERT_EQ(found->observations.size(), landmark.observations.size());
    for (size_t i = 0; i < landmark.observations.size(); ++i) {
      const KeyframeId keyframe = landmark.observations[i].keyframe;
      ASSERT_EQ(found->observations[i].keyframe, keyframe);
      ExpectEqual(
          FeaturesOf<L>(*loaded.FindKeyframe(keyframe)->frame)[found->observations[i].feature],
          FeaturesOf<L>(*saved.FindKeyframe(keyframe)->frame)[landmark.observations[i].feature]);
    }
  }
}

void ExpectSameMap(const Map& loaded, const Map& saved) {
  EXPECT_EQ(FirstViolation(loaded), "");
  EXPECT_EQ(loaded.next_keyframe(), saved.next_keyframe());
  EXPECT_EQ(loaded.next_landmark(), saved.next_landmark());
  ASSERT_EQ(loaded.keyframes().size(), saved.keyframes().size());
  for (const auto& [id, keyframe] : saved.keyframes()) {
    const Keyframe* const found = loaded.FindKeyframe(id);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->cam_from_world.params, keyframe.cam_from_world.params);
    EXPECT_EQ(*loaded.StepCovariance(id), *saved.StepCovariance(id));
    EXPECT_EQ(found->frame->id, keyframe.frame->id);
    EXPECT_EQ(found->frame->timestamp, keyframe.frame->timestamp);
    EXPECT_EQ(found->frame->intrinsics->distortion.k, keyframe.frame->intrinsics->distortion.k);
    EXPECT_EQ(found->frame->depth_ranges.cells[5].max_inverse_depth, 0.5f);
  }
  ForEachLandmarkKind(
      [&](auto kind) { ExpectSameLandmarks<typename decltype(kind)::Landmark>(loaded, saved); });
}

class MapFileTest : public TemporaryFolder {
 protected:
  RandomMap random_;
};

TEST_F(MapFileTest, LoadsWhatWasSaved) {
  Map map = random_.Make(6);
  map.SetDepthOffset(map.lines().front().first, -0.012);
  MapContents contents = AsContents(map.Share());
  AxesEstimate axes;
  axes.world_from_axes = Eigen::Quaterniond(random_.Pose().rotation());
  axes.sigma = 0.01;
  axes.deviation = 0.02;
  contents.submaps[0].axes = axes;
  contents.submaps[0].noise_scale = {1.5, 0.5, 2.0};
  contents.loops.push_back({1, 4, random_.Pose(), PoseCovariance::Identity()});
  SaveMap(Path("home.map"), std::move(contents));

  const MapContents loaded = LoadMap(Path("home.map"));
  ASSERT_EQ(loaded.submaps.size(), 1u);
  ExpectSameMap(loaded.submaps[0].map, map);
  ASSERT_TRUE(loaded.submaps[0].axes);
  EXPECT_EQ(loaded.submaps[0].axes->world_from_axes.coeffs(), axes.world_from_axes.coeffs());
  EXPECT_EQ(loaded.submaps[0].noise_scale.line_depth, 2.0);
  ASSERT_EQ(loaded.sessions.size(), 1u);
  EXPECT_EQ(loaded.sessions[0].name, "first");
  ASSERT_EQ(loaded.loops.size(), 1u);
  EXPECT_EQ(loaded.loops[0].to, 4);
  EXPECT_EQ(loaded.loops[0].covariance, PoseCovariance::Identity());
  EXPECT_NO_THROW(CheckMap(Path("home.map")));
}

void ExpectEqual(const PlaneFeature& a, const PlaneFeature& b) {
  EXPECT_LT((a.inverse_depth - b.inverse_depth).norm(), 1e-7);
  EXPECT_LT((a.covariance - b.covariance).norm(), 1e-12);
  EXPECT_LT((a.mean_square_ray - b.mean_square_ray).norm(), 1e-7);
  EXPECT_EQ(a.num_pixels, b.num_pixels);
  ASSERT_EQ(a.hull.size(), b.hull.size());
  for (size_t i = 0; i < a.hull.size(); ++i) EXPECT_LT((a.hull[i] - b.hull[i]).norm(), 1e-7);
}

// Any vertex may be the first one.
void ExpectSameExtent(PlaneExtent a, const PlaneExtent& b) {
  ASSERT_EQ(a.size(), b.size());
  const auto first = std::min_element(a.begin(), a.end(), [&](const auto& x, const auto& y) {
    return (x - b[0]).norm() < (y - b[0]).norm();
  });
  std::rotate(a.begin(), first, a.end());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-6);
}

// Planes are numbered anew, in their order.
void ExpectSamePlanes(const SavedSubMap& loaded, const SavedSubMap& saved) {
  EXPECT_EQ(loaded.planes.noise, saved.planes.noise);
  ASSERT_EQ(loaded.planes.planes.size(), saved.planes.planes.size());
  std::map<LandmarkId, LandmarkId> new_ids;
  auto other = loaded.planes.planes.begin();
  for (const auto& [id, plane] : saved.planes.planes) {
    new_ids[id] = other->first;
    EXPECT_EQ(other->second.host, plane.host);
    EXPECT_EQ(other->second.in_host.params, plane.in_host.params);
    ExpectSameExtent(other->second.extent, plane.extent);
    ++other;
  }
  for (const auto& [id, keyframe] : saved.map.keyframes()) {
    const std::vector<PlaneFeature>& planes = loaded.map.FindKeyframe(id)->frame->planes;
    ASSERT_EQ(planes.size(), keyframe.frame->planes.size());
    for (size_t i = 0; i < planes.size(); ++i) ExpectEqual(planes[i], keyframe.frame->planes[i]);
    std::map<int, LandmarkId> found, expected;
    for (const PlaneMatch& match : loaded.planes.observations.at(id)) {
      found[match.feature] = match.plane;
    }
    for (const PlaneMatch& match : saved.planes.observations.at(id)) {
      expected[match.feature] = new_ids.at(match.plane);
    }
    EXPECT_EQ(found, expected);
  }
}

TEST_F(MapFileTest, LoadsThePlanesThatWereSaved) {
  const auto contents_of = [](SavedSubMap* submap) {
    MapContents contents;
    contents.sessions.push_back({0, "first"});
    contents.submaps.push_back(
        {submap->id, submap->map.Share(), submap->axes, submap->noise_scale, submap->planes});
    return contents;
  };
  SavedSubMap saved = WithPlanes(random_.Make(4));
  MapWriter writer(Path("home.map"));
  writer.Write(contents_of(&saved));
  const auto load = [&] {
    std::filesystem::copy_file(Path("home.map"), Path("copy.map"),
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_NO_THROW(CheckMap(Path("copy.map")));
    return std::move(LoadMap(Path("copy.map")).submaps.at(0));
  };
  ExpectSamePlanes(load(), saved);
  EXPECT_EQ(SummarizeMap(Path("copy.map")).submaps.at(0).num_planes, 5);
  // A culled keyframe takes its planes with it, and the host of the other is another keyframe.
  saved.map.RemoveKeyframe(3, 2);
  saved.planes.observations.erase(3);
  saved.planes.planes.erase(13);
  saved.planes.planes.at(3).host = 1;
  writer.Write(contents_of(&saved));
  ExpectSamePlanes(load(), saved);
}

// Loading a map and saving it again leaves the same bytes: rounding moves a vertex onto an edge,
// where it is none.
TEST_F(MapFileTest, SavesHullsAsTheyAreLoaded) {
  PlaneFeature plane;
  plane.inverse_depth = {0.0, 0.0, 1.0};
  plane.covariance = 1e-6 * Eigen::Matrix3d::Identity();
  plane.mean_square_ray = Eigen::Matrix3d::Identity();
  plane.num_pixels = 100;
  plane.hull = {{1.0, 1.0}, {1.5, 1.0 - 1e-9}, {2.0, 1.0}, {1.5, 2.0}};
  const std::string saved = EncodePlanes({plane});
  EXPECT_EQ(DecodePlanes(saved).at(0).hull.size(), 3u);
  EXPECT_EQ(EncodePlanes(DecodePlanes(saved)), saved);
}

// Corrections of the map turn a plane, but not the extent that it had before.
TEST_F(MapFileTest, SavesExtentsOnPlanesThatHaveTurned) {
  SavedSubMap saved = WithPlanes(random_.Make(4));
  HostedPlane& turned = saved.planes.planes.at(3);
  turned.in_host = Plane({0.28, 0.0, -0.96}, turned.in_host.offset());  // by 0.36 rad
  PlaneExtent extent;
  for (const Eigen::Vector3d& x : turned.extent) extent.push_back(Project(turned.in_host, x));
  MapContents contents;
  contents.sessions.push_back({0, "first"});
  contents.submaps.push_back(std::move(saved));
  SaveMap(Path("home.map"), std::move(contents));
  const MapContents loaded = LoadMap(Path("home.map"));
  ExpectSameExtent(loaded.submaps[0].planes.planes.at(0).extent, extent);
}

TEST_F(MapFileTest, LeavesOutFeaturesThatObserveNothing) {
  Map map = random_.Make(3);
  SaveMap(Path("home.map"), AsContents(map.Share()));
  const MapContents loaded = LoadMap(Path("home.map"));
  for (const auto& [id, keyframe] : loaded.submaps[0].map.keyframes()) {
    EXPECT_LT(keyframe.frame->points.size(), map.FindKeyframe(id)->frame->points.size());
    EXPECT_THAT(keyframe.landmarks.points, ::testing::Not(::testing::Contains(kNoId)));
  }
}

// Changes of all kinds, each written on top of the one before.
TEST_F(MapFileTest, WritesChangesOfARun) {
  Map map = random_.Make(4);
  MapWriter writer(Path("home.map"));
  const auto write_and_compare = [&] {
    writer.Write(AsContents(map.Share()));
    std::filesystem::copy_file(Path("home.map"), Path("copy.map"),
                               std::filesystem::copy_options::overwrite_existing);
    ExpectSameMap(LoadMap(Path("copy.map")).submaps[0].map, map);
    EXPECT_NO_THROW(CheckMap(Path("copy.map")));
  };
  write_and_compare();
  random_.AddKeyframe(&map);
  write_and_compare();
  map.SetPose(1, random_.Pose());
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    std::vector<LandmarkId> ids;
    for (const auto& [id, landmark] : map.landmarks<L>()) ids.push_back(id);
    for (const LandmarkId id : ids) map.Refresh<L>(id);
    map.Remove<L>(ids[2]);
    map.MergeLandmarks<L>(ids.back(), ids[3]);
    map.Refresh<L>(ids[3]);
    map.CountTracking<L>(ids[4], 7, 3);
  });
  write_and_compare();
  map.RemoveKeyframe(2, 3);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    std::vector<LandmarkId> ids;
    for (const auto& [id, landmark] : map.landmarks<L>()) ids.push_back(id);
    for (const LandmarkId id : ids) map.Refresh<L>(id);
  });
  write_and_compare();
}

TEST_F(MapFileTest, JoinsSubMaps) {
  Map first = random_.Make(3);
  Map second = random_.Make(2, first);
  MapContents two = AsContents(first.Share());
  two.submaps.push_back({1, second.Share(), {}, {}});
  MapWriter writer(Path("home.map"));
  writer.Write(std::move(two));
  first.Transform(random_.Pose());
  first.Merge(second);
  writer.Write(AsContents(first.Share()));
  std::filesystem::copy_file(Path("home.map"), Path("copy.map"));
  const MapContents loaded = LoadMap(Path("copy.map"));
  ASSERT_EQ(loaded.submaps.size(), 1u);
  ExpectSameMap(loaded.submaps[0].map, first);
}

// Ids of removed keyframes and landmarks are not reused.
TEST_F(MapFileTest, ContinuesLoadedMap) {
  Map map = random_.Make(3);
  SaveMap(Path("home.map"), AsContents(map.Share()));
  MapWriter writer(Path("home.map"));
  MapContents contents = writer.Load();
  Map& loaded = contents.submaps[0].map;
  const KeyframeId first = loaded.next_keyframe();
  EXPECT_EQ(first, map.next_keyframe());
  Map own = random_.Make(2, loaded);
  Map saved = own.Share();
  contents.sessions.push_back({first, "second"});
  contents.submaps.push_back({1, std::move(own), {}, {}});
  writer.Write(std::move(contents));
  std::filesystem::copy_file(Path("home.map"), Path("copy.map"));
  const MapContents both = LoadMap(Path("copy.map"));
  ASSERT_EQ(both.submaps.size(), 2u);
  ExpectSameMap(both.submaps[1].map, saved);
  EXPECT_EQ(both.submaps[0].map.keyframes().size(), 3u);
  const MapFileSummary summary = SummarizeMap(Path("copy.map"));
  ASSERT_EQ(summary.sessions.size(), 2u);
  EXPECT_EQ(summary.sessions[0].num_keyframes, 3);
  EXPECT_EQ(summary.sessions[1].num_keyframes, 2);
  ASSERT_EQ(summary.submaps.size(), 2u);
  EXPECT_EQ(summary.submaps[1].num_points, static_cast<int64_t>(saved.points().size()));
}

TEST_F(MapFileTest, SavingReplacesTheMapBefore) {
  SaveMap(Path("home.map"), AsContents(random_.Make(5)));
  Map map = random_.Make(2);
  SaveMap(Path("home.map"), AsContents(map.Share()));
  ExpectSameMap(LoadMap(Path("home.map")).submaps[0].map, map);
}

TEST_F(MapFileTest, FailedWriteLeavesTheMapBefore) {
  Map map = random_.Make(2);
  MapWriter writer(Path("home.map"));
  writer.Write(AsContents(map.Share()));
  Map broken = map.Share();
  random_.AddKeyframe(&broken);
  broken.SetPose(0, Rigid3(Eigen::Quaterniond::Identity(),
                           Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())));
  EXPECT_THROW(writer.Write(AsContents(broken.Share())), std::invalid_argument);
  std::filesystem::copy_file(Path("home.map"), Path("copy.map"));
  ExpectSameMap(LoadMap(Path("copy.map")).submaps[0].map, map);
  random_.AddKeyframe(&map);
  writer.Write(AsContents(map.Share()));
  std::filesystem::copy_file(Path("home.map"), Path("copy2.map"));
  ExpectSameMap(LoadMap(Path("copy2.map")).submaps[0].map, map);
}

TEST_F(MapFileTest, RefusesSecondWriterAndReaderWhileItIsWritten) {
  MapWriter writer(Path("home.map"));
  writer.Write(AsContents(random_.Make(2)));
  EXPECT_THAT(MessageOf([&] { MapWriter second(Path("home.map")); }),
              Names(Path("home.map"), "in use"));
  EXPECT_THAT(MessageOf([&] { LoadMap(Path("home.map")); }), Names(Path("home.map"), "in use"));
}

}  // namespace
}  // namespace msc_vo
