// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/ply_file.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Lines along the first axis, without axis, and outside of the last window.
const std::vector<MapLine> kLines = {
    {{{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}}, 5, true, 0, {0.0, 0.6, 0.8}},
    {{{0.0, 2.0, 1.0}, {1.0, 2.0, 1.0}}, 7, true, std::nullopt, {0.0, 1.0, 0.0}},
    {{{0.0, 1.0, 1.0}, {1.0, 1.0, 1.25}}, 6, false, 1, {1.0, 0.0, 0.0}}};

constexpr char kEdges[] =
    "ply\nformat ascii 1.0\ncomment two edges\nelement vertex 3\nproperty float x\n"
    "property float y\nproperty float z\nelement edge 2\nproperty int vertex1\n"
    "property int vertex2\nend_header\n0 0 0\n1 0 0\n1 2 0\n0 1\n2 1\n";

class PlyFileTest : public TemporaryFolder {
 protected:
  // Error message for kEdges with `from` replaced by `to`.
  std::string ErrorOf(const std::string& from, const std::string& to) {
    std::string text = kEdges;
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    WriteText("edges.ply", text);
    return MessageOf([&] { ReadEdgesPly(Path("edges.ply")); });
  }
};

// Expects parts of a file and its end.
void ExpectFile(const std::string& text, const std::vector<std::string>& parts,
                const std::string& end) {
  for (const std::string& part : parts) EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, testing::EndsWith(end));
}

TEST_F(PlyFileTest, WritesPoints) {
  ExpectFile(FormatPointsPly({{{1.0, 2.0, 3.0}, 4}}), {"element vertex 1\n"},
             "end_header\n1.000000 2.000000 3.000000 4\n");
}

TEST_F(PlyFileTest, ColoursLinesByAxis) {
  ExpectFile(FormatLinesPly(kLines),
             {"element vertex 6\n", "element edge 3\n",
              "\n0.000000 0.000000 1.000000 0.000000 -0.600000 -0.800000 255 0 0 5\n",
              "\n1.000000 2.000000 1.000000 0.000000 -1.000000 0.000000 128 0 128 7\n"},
             "0 0 0 6\n0 1 255 0 0\n2 3 128 0 128\n4 5 0 0 0\n");
}

TEST_F(PlyFileTest, ReadsWrittenLines) {
  WriteText("lines.ply", FormatLinesPly(kLines));
  const std::vector<EstimatedLine> lines = ReadLinesPly(Path("lines.ply"));
  ASSERT_EQ(lines.size(), kLines.size());
  for (size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].segment.start, kLines[i].segment.start);
    EXPECT_EQ(lines[i].segment.end, kLines[i].segment.end);
    EXPECT_EQ(lines[i].num_observations, kLines[i].num_observations);
    EXPECT_EQ(lines[i].viewing_direction, kLines[i].viewing_direction);
  }
  WriteText("none.ply", FormatLinesPly({}));
  EXPECT_TRUE(ReadLinesPly(Path("none.ply")).empty());
}

TEST_F(PlyFileTest, ReadsColoursOfWrittenLines) {
  WriteText("lines.ply", FormatLinesPly(kLines));
  const std::vector<ColoredEdge> edges = ReadColoredEdgesPly(Path("lines.ply"));
  ASSERT_EQ(edges.size(), 3u);
  EXPECT_EQ(edges[0].color, (std::array<uint8_t, 3>{255, 0, 0}));
  EXPECT_EQ(edges[1].color, (std::array<uint8_t, 3>{128, 0, 128}));
  EXPECT_EQ(edges[2].segment.end, Eigen::Vector3d(1.0, 1.0, 1.25));
  std::string text = FormatLinesPly(kLines);
  text.replace(text.find(" 255 0 0 5"), 10, " 256 0 0 5");
  WriteText("lines.ply", text);
  EXPECT_THROW(ReadColoredEdgesPly(Path("lines.ply")), std::runtime_error);
}

std::vector<MapPlane> MakePlanes() {
  MapPlane wall, slope;
  wall.plane = Plane({0.0, 0.0, -1.0}, 2.0);
  wall.extent = {{0.0, 0.0, 2.0}, {0.0, 1.0, 2.0}, {1.0, 1.0, 2.0}, {1.0, 0.0, 2.0}};
  wall.num_observations = 7;
  wall.axis = 2;
  slope.plane = Plane({0.6, 0.0, -0.8}, 1.0);
  slope.extent = {{0.0, 0.0, 1.25}, {0.0, 1.0, 1.25}, {1.0, 1.0, 2.0}};
  slope.num_observations = 3;
  return {wall, MapPlane(), slope};
}

TEST_F(PlyFileTest, WritesPlanesAsFaces) {
  ExpectFile(FormatPlanesPly(MakePlanes()),
             {"element vertex 7\n", "element face 2\n",
              "\n1.000000 1.000000 2.000000 0.000000 0.000000 -1.000000 0 0 255 7\n",
              "\n0.000000 1.000000 1.250000 0.600000 0.000000 -0.800000 128 128 128 3\n"},
             "\n4 0 1 2 3\n3 4 5 6\n");
}

TEST_F(PlyFileTest, ReadsWrittenPlanes) {
  const std::string text = FormatPlanesPly(MakePlanes());
  WriteText("planes.ply", text);
  const std::vector<ColoredPolygon> polygons = ReadColoredPolygonsPly(Path("planes.ply"));
  ASSERT_EQ(polygons.size(), 2u);
  EXPECT_EQ(polygons[0].vertices, MakePlanes()[0].extent);
  EXPECT_EQ(polygons[0].color, (std::array<uint8_t, 3>{0, 0, 255}));
  EXPECT_EQ(polygons[1].vertices, MakePlanes()[2].extent);
  EXPECT_EQ(polygons[1].color, (std::array<uint8_t, 3>{128, 128, 128}));
  const auto error_of = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    WriteText("planes.ply", changed.replace(changed.find(from), from.size(), to));
    return MessageOf([&] { ReadColoredPolygonsPly(Path("planes.ply")); });
  };
  EXPECT_THAT(error_of("\n3 4 5 6\n", "\n3 4 5\n"), Names("planes.ply:26", "'3 4 5'"));
  EXPECT_THAT(error_of("\n3 4 5 6\n", "\n3 4 5 7\n"), Names("planes.ply:26", "7 vertices"));
  EXPECT_THAT(error_of("\n3 4 5 6\n", "\n2 4 5\n"), Names("planes.ply:26", "three or more"));
  EXPECT_THAT(error_of(" 0 0 255 7", " 0 0 256 7"), Names("planes.ply:18", "colour"));
  EXPECT_THAT(error_of("element face 2", "element side 2"), Names("planes.ply", "'face'"));
}

TEST_F(PlyFileTest, ReadsWrittenPoints) {
  WriteText("map.ply", FormatPointsPly({{{1.0, -2.0, 0.5}, 3}, {{0.0, 0.0, 4.0}, 9}}));
  const std::vector<MapPoint> points = ReadPointsPly(Path("map.ply"));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, Eigen::Vector3d(1.0, -2.0, 0.5));
  EXPECT_EQ(points[1].num_observations, 9);
  WriteText("map.ply", FormatPointsPly({{{1.0, -2.0, 0.5}, -3}}));
  EXPECT_THROW(ReadPointsPly(Path("map.ply")), std::runtime_error);
}

TEST_F(PlyFileTest, ReadsWrittenEdges) {
  const std::vector<LineSegment3> edges = {{{0.5, -2.0, 1.0}, {0.5, -2.0, 1e-6}},
                                           {{0.0, 0.0, 0.0}, {123.456789, 0.0, 0.0}}};
  WriteText("edges.ply", FormatEdgesPly(edges));
  const std::vector<LineSegment3> read = ReadEdgesPly(Path("edges.ply"));
  ASSERT_EQ(read.size(), edges.size());
  for (size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].start, edges[i].start);
    EXPECT_EQ(read[i].end, edges[i].end);
  }
}

TEST_F(PlyFileTest, ReadsEdgesThatShareVertices) {
  WriteText("edges.ply", kEdges);
  const std::vector<LineSegment3> edges = ReadEdgesPly(Path("edges.ply"));
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[1].start, Eigen::Vector3d(1, 2, 0));
  EXPECT_EQ(edges[1].end, Eigen::Vector3d(1, 0, 0));
}

TEST_F(PlyFileTest, ReportsFileAndLineOfErrors) {
  EXPECT_THAT(ErrorOf("ply", "plain"), Names("edges.ply:1", "'ply'", "plain"));
  EXPECT_THAT(ErrorOf("ascii", "binary_little_endian"),
              Names("edges.ply:2", "ascii", "binary_little_endian"));
  EXPECT_THAT(ErrorOf("vertex 3", "vertex 1e30"), Names("edges.ply:4", "whole number", "1e30"));
  EXPECT_THAT(ErrorOf("vertex 3", "vertex three"), Names("edges.ply:4", "whole number", "three"));
  EXPECT_THAT(ErrorOf("property float x", "property list uchar int x"),
              Names("edges.ply:5", "comment", "element", "property"));
  EXPECT_THAT(ErrorOf("float z", "float w"), Names("edges.ply:4", "'vertex'", "'z'"));
  EXPECT_THAT(ErrorOf("element edge", "element face"), Names("edges.ply", "no element", "'edge'"));
  EXPECT_THAT(ErrorOf("end_header\n", ""), Names("edges.ply:11", "comment", "element", "property"));
  EXPECT_THAT(ErrorOf("1 0 0", "1 0"), Names("edges.ply:13", "3", "'vertex'", "'1 0'"));
  EXPECT_THAT(ErrorOf("1 0 0", "1 0 nan"), Names("edges.ply:13", "'nan'"));
  EXPECT_THAT(ErrorOf("2 1\n", "2 3\n"), Names("edges.ply:16", "3", "'2 3'"));
  EXPECT_THAT(ErrorOf("2 1\n", "2 0.5\n"), Names("edges.ply:16", "3", "'2 0.5'"));
  EXPECT_THAT(ErrorOf("2 1\n", "2 2\n"), Names("edges.ply:16", "different", "'2 2'"));
  EXPECT_THAT(ErrorOf("2 1\n", "2 1\n2 1\n"), Names("edges.ply:17", "end", "'2 1'"));
  EXPECT_THAT(ErrorOf("2 1\n", ""), Names("edges.ply:15", "1", "2", "'edge'"));
  EXPECT_THAT(ErrorOf(kEdges, ""), Names("edges.ply:1", "empty"));
  EXPECT_THAT(ErrorOf(kEdges, "ply\n"), Names("edges.ply:1", "ascii"));
  EXPECT_THAT(ErrorOf(kEdges, "ply\nformat ascii 1.0\n"), Names("edges.ply:2", "end_header"));
  EXPECT_THAT(MessageOf([&] { ReadEdgesPly(Path("none.ply")); }), Names("none.ply", "exist"));
  WriteText("edges.ply", kEdges);
  EXPECT_THAT(MessageOf([&] { ReadLinesPly(Path("edges.ply")); }),
              Names("edges.ply:4", "'vertex'", "'nx'"));
  std::string lines = FormatLinesPly(kLines);
  WriteText("lines.ply", lines.replace(lines.find(" 5\n"), 2, " 5.5"));
  EXPECT_THAT(MessageOf([&] { ReadLinesPly(Path("lines.ply")); }),
              Names("lines.ply:22", "whole number", "observations"));
}

}  // namespace
}  // namespace msc_vo
