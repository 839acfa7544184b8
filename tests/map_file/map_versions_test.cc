// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Files of every version that was ever released can be read (tests/data/maps).

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"

namespace msc_vo {
namespace {

class MapVersionsTest : public TemporaryFolder {
 protected:
  // Readers may have to restore the last state of a file, so that they get a copy.
  std::string Copy(const std::string& name) const {
    std::filesystem::copy_file(std::filesystem::path(MSC_VO_MAPS_FOLDER) / name, Path(name));
    return Path(name);
  }
  // Checks and loads the file of a version.
  MapContents Load(int version) const {
    const std::string path = Copy("version_" + std::to_string(version) + ".map");
    EXPECT_NO_THROW(CheckMap(path));
    EXPECT_EQ(SummarizeMap(path).version, version);
    EXPECT_EQ(MapImages(path).Keyframes().empty(), version < 4);
    MapContents contents = LoadMap(path);
    EXPECT_EQ(contents.submaps.size(), 1u);
    return contents;
  }
};

TEST_F(MapVersionsTest, ReadsVersion1) {
  const std::string path = Copy("version_1.map");
  EXPECT_NO_THROW(CheckMap(path));
  const MapFileSummary summary = SummarizeMap(path);
  EXPECT_EQ(summary.version, 1);
  EXPECT_EQ(summary.program, "msc_vo 0.2.0");
  const MapContents contents = LoadMap(path);
  ASSERT_EQ(contents.sessions.size(), 2u);
  EXPECT_EQ(contents.sessions[1].first_keyframe, 3);
  ASSERT_EQ(contents.submaps.size(), 1u);
  EXPECT_NEAR(contents.submaps[0].noise_scale.line_pixel, 0.77900126102768, 1e-12);
  const Map& map = contents.submaps[0].map;
  ASSERT_EQ(map.keyframes().size(), 7u);
  EXPECT_EQ(map.points().size(), 283u);
  EXPECT_EQ(map.lines().size(), 36u);
  const Keyframe& keyframe = *map.FindKeyframe(1);
  EXPECT_NEAR(keyframe.cam_from_world.params[1], 0.051933722035206, 1e-12);
  EXPECT_NEAR(keyframe.cam_from_world.params[6], -0.107344770013162, 1e-12);
  EXPECT_NEAR((*map.StepCovariance(1))(4, 4), 8e-6, 1e-15);
  EXPECT_EQ(keyframe.frame->id, 10);
  EXPECT_NEAR(keyframe.frame->timestamp, 1.333333, 1e-9);
  EXPECT_EQ(keyframe.frame->camera.width, 160);
  ASSERT_TRUE(keyframe.frame->intrinsics);
  EXPECT_TRUE(keyframe.frame->intrinsics->distortion.IsZero());
  const PointFeature& feature = map.FindKeyframe(0)->frame->points[0];
  EXPECT_EQ(feature.pixel, Eigen::Vector2d(0x4b3e / 256.0, 0x2267 / 256.0));
  EXPECT_EQ(feature.sigma, 0.5);
  EXPECT_EQ(feature.level, 0);
  const PointLandmark& point = *map.Find<PointLandmark>(1);
  EXPECT_NEAR(point.position.z(), 2.616656, 1e-9);
  EXPECT_EQ(point.num_visible, 47);
  EXPECT_EQ(point.num_found, 44);
  const LineLandmark& line = *map.Find<LineLandmark>(292);
  EXPECT_NEAR(line.segment.end.y(), -0.989018, 1e-9);
  EXPECT_NEAR(line.depth_offset, 68e-6, 1e-9);
}

TEST_F(MapVersionsTest, ReadsThePlanesOfVersion2) {
  const MapContents contents = Load(2);
  ASSERT_FALSE(contents.submaps.empty());
  EXPECT_EQ(contents.submaps[0].map.keyframes().size(), 7u);
  const SavedPlanes& planes = contents.submaps[0].planes;
  ASSERT_EQ(planes.planes.size(), 6u);
  const HostedPlane& plane = planes.planes.at(0);
  EXPECT_EQ(plane.host, 3);
  EXPECT_NEAR(plane.in_host.normal().x(), -0.246114271881892, 1e-12);
  EXPECT_NEAR(plane.in_host.offset(), 2.56277679562133, 1e-12);
  ASSERT_EQ(plane.extent.size(), 9u);
  for (const Eigen::Vector3d& vertex : plane.extent) {
    EXPECT_LT((vertex - Project(plane.in_host, vertex)).norm(), 1e-9);
  }
}

TEST_F(MapVersionsTest, ReadsTheFalseDepthsOfVersion3) {
  const MapContents contents = Load(3);
  ASSERT_FALSE(contents.submaps.empty());
  std::vector<LandmarkId> false_depths;
  for (const auto& [id, point] : contents.submaps[0].map.points()) {
    if (point.has_false_depth) false_depths.push_back(id);
  }
  for (const auto& [id, line] : contents.submaps[0].map.lines()) {
    if (line.has_false_depth) false_depths.push_back(id);
  }
  EXPECT_THAT(false_depths, testing::UnorderedElementsAre(125, 376));
}

TEST_F(MapVersionsTest, ReadsTheImagesOfVersion4) {
  const MapContents contents = Load(4);
  const MapImages images(Path("version_4.map"));
  std::vector<KeyframeId> keyframes;
  for (const auto& [id, keyframe] : contents.submaps.at(0).map.keyframes()) {
    keyframes.push_back(id);
    const std::string jpeg = images.Read(id);
    const cv::Mat image =
        cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_UNCHANGED);
    EXPECT_EQ(image.size(), cv::Size(160, 120)) << id;
  }
  EXPECT_THAT(keyframes, testing::SizeIs(8));
  EXPECT_EQ(images.Keyframes(), keyframes);
}

// The first session had images of twice the size.
TEST_F(MapVersionsTest, ReadsTheFineLevelsOfVersion5) {
  const MapContents contents = Load(5);
  ASSERT_EQ(contents.sessions.size(), 2u);
  for (const auto& [id, keyframe] : contents.submaps[0].map.keyframes()) {
    int lowest = 0;
    for (const PointFeature& point : keyframe.frame->points) lowest = std::min(lowest, point.level);
    EXPECT_EQ(lowest, id < contents.sessions[1].first_keyframe ? -4 : 0) << id;
  }
}

TEST_F(MapVersionsTest, ExtendsVersion1) {
  const std::string path = Copy("version_1.map");
  MapWriter writer(path);
  MapContents contents = writer.Load();
  contents.sessions.push_back({contents.submaps[0].map.next_keyframe(), "third"});
  Map& map = contents.submaps[0].map;
  const KeyframeId own = map.AddKeyframe(map.FindKeyframe(0)->frame, map.CamFromWorld(0));
  const std::string jpeg = "\xff\xd8\xff image";
  writer.Write(std::move(contents), [&](KeyframeId id) { return id == own ? jpeg : ""; });
  std::filesystem::copy_file(path, Path("copy.map"));
  const MapContents extended = LoadMap(Path("copy.map"));
  EXPECT_EQ(extended.sessions.size(), 3u);
  EXPECT_NEAR(extended.submaps[0].noise_scale.line_pixel, 0.77900126102768, 1e-12);
  EXPECT_EQ(extended.submaps[0].map.points().size(), 283u);
  EXPECT_EQ(SummarizeMap(Path("copy.map")).version, 5);
  EXPECT_THAT(MapImages(Path("copy.map")).Keyframes(), testing::ElementsAre(own));
  EXPECT_EQ(MapImages(Path("copy.map")).Read(own), jpeg);
}

}  // namespace
}  // namespace msc_vo
