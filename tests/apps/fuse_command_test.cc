// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/geometry/colored_mesh.h"
#include "msc_vo/report/surface_layer.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

constexpr int kFrames = 8;
constexpr double kVoxel = 0.04;

// Reads what FormatMeshPly() writes. The tests run on little-endian machines.
ColoredMesh ReadMesh(const std::string& path) {
  const std::string ply = ReadFile(path, 1 << 28);
  const size_t body = ply.find("end_header\n") + 11;
  std::istringstream header(ply.substr(0, body));
  size_t num_vertices = 0, num_faces = 0;
  bool has_normals = false;
  for (std::string word; header >> word;) {
    if (word == "vertex") header >> num_vertices;
    if (word == "face") header >> num_faces;
    if (word == "nx") has_normals = true;
  }
  ColoredMesh mesh;
  mesh.positions.resize(num_vertices);
  mesh.colors.resize(num_vertices);
  mesh.triangles.resize(num_faces);
  const char* at = ply.data() + body;
  if (has_normals) mesh.normals.resize(num_vertices);
  for (size_t i = 0; i < num_vertices; ++i) {
    std::memcpy(mesh.positions[i].data(), at, 12);
    at += 12;
    if (has_normals) {
      std::memcpy(mesh.normals[i].data(), at, 12);
      at += 12;
    }
    std::memcpy(mesh.colors[i].data(), at, 3);
    at += 3;
  }
  for (size_t i = 0; i < num_faces; ++i, at += 13) std::memcpy(&mesh.triangles[i], at + 1, 12);
  EXPECT_EQ(at, ply.data() + ply.size());
  return mesh;
}

// Distance to the nearest true surface, metres.
double SurfaceDistance(const Scene& scene, const Eigen::Vector3d& x) {
  double distance = 1e9;
  for (const Quad& quad : scene.quads) distance = std::min(distance, quad.Distance(x));
  return distance;
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// The normal of the nearest surface, on its visible side.
Eigen::Vector3d NearestNormal(const Scene& scene, const Eigen::Vector3d& x) {
  const auto nearest =
      std::min_element(scene.quads.begin(), scene.quads.end(),
                       [&](const Quad& a, const Quad& b) { return a.Distance(x) < b.Distance(x); });
  return nearest->Normal();
}

// A floor that is black on the left and white on the right, seen by a camera that looks at it at 45
// degrees: the plane (y + z) / sqrt(2) = kFloorDistance. The world is the frame of the camera.
constexpr double kFloorDistance = 1.4;
constexpr double kFloorFocalLength = 130.0;
const Eigen::Vector2d kFloorCenter(79.5, 59.5);
constexpr int kFirstWhiteColumn = 90;

double FloorDistance(const Eigen::Vector3d& x) {
  return (x.y() + x.z()) * M_SQRT1_2 - kFloorDistance;
}

void WriteFloorImages(const std::string& folder) {
  cv::Mat_<uint16_t> depth(120, 160);
  cv::Mat_<uint8_t> color(120, 160, uint8_t{0});
  color.colRange(kFirstWhiteColumn, 160).setTo(255);
  for (int y = 0; y < depth.rows; ++y) {
    const double slope = (y - kFloorCenter.y()) / kFloorFocalLength;
    const double z = kFloorDistance / ((slope + 1.0) * M_SQRT1_2);
    depth.row(y).setTo(std::lround(5000.0 * z));
  }
  cv::imwrite(folder + "/rgb.png", color);
  cv::imwrite(folder + "/depth.png", depth);
}

class FuseCommandTest : public TemporaryFolder {
 protected:
  // Fuses images of the floor: colour images of these names, and the same depth for each.
  ColoredMesh FuseFloor(const std::vector<std::string>& more,
                        const std::vector<std::string>& images = {3, "rgb.png"}) {
    WriteText("floor/camera.txt", "130 130 79.5 59.5 160 120 5000\n");
    WriteFloorImages(Path("floor"));
    std::string list, truth;
    for (size_t i = 0; i < images.size(); ++i) {
      const std::string stamp = std::to_string(1.0 + 0.1 * static_cast<double>(i));
      list += stamp + " " + images[i] + " " + stamp + " depth.png\n";
      truth += stamp + " 0 0 0 0 0 0 1\n";
    }
    WriteText("floor/associations.txt", list);
    WriteText("floor/groundtruth.txt", truth);
    std::vector<std::string> arguments = {"fuse",
                                          Path("floor"),
                                          Path("floor/groundtruth.txt"),
                                          "--output",
                                          Path("floor.ply"),
                                          "--quiet",
                                          "--voxel",
                                          "0.02"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return ReadMesh(Path("floor.ply"));
  }
  static void ExpectNormalsOfWalls(const ColoredMesh& points) {
    ASSERT_EQ(points.normals.size(), points.positions.size());
    const SyntheticSequence truth = Truth();
    std::vector<double> cosines;
    for (size_t i = 0; i < points.normals.size(); ++i) {
      const Eigen::Vector3d normal = points.normals[i].cast<double>();
      ASSERT_NEAR(normal.norm(), 1.0, 1e-3);
      const Eigen::Vector3d x = points.positions[i].cast<double>();
      cosines.push_back(normal.dot(NearestNormal(truth.scene(), x)));
    }

    EXPECT_GT(Median(cosines), 0.98);  // others are near edges, where a voxel sees two surfaces
  }
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"), {"--frames", std::to_string(kFrames), "--width", "160", "--fps",
                                  "4", "--image-sigma", "0"});
  }
  CommandOutcome Fuse(const std::string& output, const std::vector<std::string>& more = {},
                      double voxel = kVoxel) {
    std::vector<std::string> arguments = {
        "fuse",       Path("room"), Path("room/groundtruth.txt"), "--output",
        Path(output), "--voxel",    std::to_string(voxel)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  static SyntheticSequence Truth() {
    SyntheticSequenceOptions options;
    options.width = 160;
    options.height = 120;
    options.fps = 4.0;
    options.image_sigma = 0.0;
    return SyntheticSequence(options);
  }
};

#ifdef MSC_VO_HAS_FUSION

TEST_F(FuseCommandTest, TheSurfaceLiesOnTheWalls) {
  ASSERT_EQ(Fuse("room.ply").exit_code, 0);
  const ColoredMesh mesh = ReadMesh(Path("room.ply"));
  ASSERT_GT(mesh.positions.size(), 2000U);
  ASSERT_GT(mesh.triangles.size(), 2000U);
  const SyntheticSequence truth = Truth();
  std::vector<double> distances;
  for (const Eigen::Vector3f& x : mesh.positions) {
    distances.push_back(SurfaceDistance(truth.scene(), x.cast<double>()));
  }
  const auto num_close = std::count_if(distances.begin(), distances.end(),
                                       [](double distance) { return distance <= kVoxel; });
  // Where a surface is seen past an edge of another one, the volume may connect the two.
  EXPECT_GT(num_close, 0.98 * mesh.positions.size());
  EXPECT_LT(Median(distances), 0.05 * kVoxel);
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    for (const int32_t vertex : triangle) {
      ASSERT_GE(vertex, 0);
      ASSERT_LT(vertex, static_cast<int32_t>(mesh.positions.size()));
    }
  }
}

TEST_F(FuseCommandTest, TheSurfaceIsCompleteAndHasTheColorsOfTheImages) {
  ASSERT_EQ(Fuse("room.ply").exit_code, 0);
  const ColoredMesh mesh = ReadMesh(Path("room.ply"));
  const SyntheticSequence truth = Truth();
  const SyntheticFrame frame = truth.Render(kFrames / 2);
  int num_seen = 0, num_found = 0;
  std::vector<double> differences;
  for (int y = 5; y < 115; y += 10) {
    for (int x = 5; x < 155; x += 10) {
      const size_t pixel = 160 * y + x;
      const double depth = frame.image.depth[pixel];
      if (depth <= 0.0 || depth > 3.5) continue;
      const Eigen::Vector3d point =
          frame.pose.world_from_cam * truth.camera().BackProject(Eigen::Vector2d(x, y), depth);
      size_t nearest = 0;
      double distance = 1e9;
      for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const double d = (mesh.positions[i].cast<double>() - point).norm();
        if (d < distance) nearest = i;
        distance = std::min(distance, d);
      }
      ++num_seen;
      num_found += distance < 1.5 * kVoxel ? 1 : 0;
      for (int k = 0; k < 3; ++k) {
        differences.push_back(std::abs(static_cast<double>(mesh.colors[nearest][k]) -
                                       frame.image.rgb[3 * pixel + k]));
      }
    }
  }
  ASSERT_GT(num_seen, 50);
  EXPECT_GT(num_found, 0.9 * num_seen);
  EXPECT_LT(Median(differences), 15.0);  // grey values; a voxel covers several texels
}

// Where a pixel is in its image does not matter on a plane that is parallel to the image.
TEST_F(FuseCommandTest, AnInclinedPlaneIsAtItsDepth) {
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{}, {"--points"}}) {
    std::vector<double> distances;
    for (const Eigen::Vector3f& x : FuseFloor(more).positions) {
      distances.push_back(FloorDistance(x.cast<double>()));
    }
    ASSERT_GT(distances.size(), 1000U);
    // Half a pixel is 5 mm on the floor.
    EXPECT_NEAR(Median(distances), 0.0, 0.001);
  }
}

TEST_F(FuseCommandTest, AnEdgeOfColoursIsAtItsPixel) {
  const ColoredMesh mesh = FuseFloor({});
  int num_near = 0, num_wrong = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3d x = mesh.positions[i].cast<double>();
    const double column = kFloorFocalLength * x.x() / x.z() + kFloorCenter.x();
    const double from_border = column - (kFirstWhiteColumn - 0.5);
    if (std::abs(from_border) > 1.5) continue;
    ++num_near;
    num_wrong += (from_border > 0.0) != (mesh.colors[i][0] > 127) ? 1 : 0;
  }
  ASSERT_GT(num_near, 300);
  EXPECT_LT(num_wrong, num_near / 20);  // a sixth if the border is displaced by half a pixel
}

TEST_F(FuseCommandTest, ColorsAreMeansOfTheImages) {
  std::filesystem::create_directory(Path("floor"));
  for (const int grey : {100, 110}) {
    cv::imwrite(Path("floor/" + std::to_string(grey) + ".png"), cv::Mat(120, 160, CV_8UC1, grey));
  }
  std::vector<std::string> images;
  for (int i = 0; i < 40; ++i) images.push_back(i % 2 == 0 ? "110.png" : "100.png");
  const ColoredMesh mesh = FuseFloor({}, images);
  double sum = 0.0;
  for (const std::array<uint8_t, 3>& color : mesh.colors) sum += color[1];
  EXPECT_NEAR(sum / static_cast<double>(mesh.colors.size()), 105.0, 0.5);
}

TEST_F(FuseCommandTest, WritesPointsAndTheSameBytesTwice) {
  ASSERT_EQ(Fuse("a.ply", {"--points"}).exit_code, 0);
  ASSERT_EQ(Fuse("b.ply", {"--points", "--quiet"}).exit_code, 0);
  const ColoredMesh points = ReadMesh(Path("a.ply"));
  EXPECT_GT(points.positions.size(), 2000U);
  EXPECT_TRUE(points.triangles.empty());
  ExpectNormalsOfWalls(points);
  EXPECT_TRUE(ReadFile(Path("a.ply"), 1 << 28) == ReadFile(Path("b.ply"), 1 << 28));
}

TEST_F(FuseCommandTest, AddsTheSurfaceToAReport) {
  ASSERT_EQ(RunCommand({"replay", Path("room"), "--output", Path("out"), "--quiet"}).exit_code, 0);
  const std::string report = Path("out/report.html");
  const std::string before = ReadFile(report, 1 << 28);
  const CommandOutcome outcome = Fuse("a.ply", {"--report", report});
  if (!IsInteractiveReport(before)) {  // built without three.js
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, LineNames("error:", "report.html", "three.js"));
    return;
  }
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, Names(Path("out/report.html")));
  const std::string once = ReadFile(report, 1 << 28);
  EXPECT_GT(once.size(), before.size() + 20'000);
  ASSERT_EQ(Fuse("a.ply", {"--report", report}).exit_code, 0);
  EXPECT_TRUE(ReadFile(report, 1 << 28) == once);
}

TEST_F(FuseCommandTest, RefusesWhatIsNoReport) {
  WriteFile(Path("page.html"), "<html></html>");
  const CommandOutcome outcome = Fuse("a.ply", {"--report", Path("page.html")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "page.html", "three.js"));
  EXPECT_EQ(ReadFile(Path("page.html")), "<html></html>");
}

TEST_F(FuseCommandTest, StopsAtTheMemoryLimit) {
  const CommandOutcome outcome = Fuse("room.ply", {"--max-memory", "32"}, 0.002);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "voxels", "MiB"));
}

TEST_F(FuseCommandTest, ReportsThatNothingWasMeasured) {
  const CommandOutcome outcome = Fuse("room.ply", {"--max-depth", "0.1"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "--max-depth", "--voxel"));
}

#else

TEST_F(FuseCommandTest, NamesTheMissingModule) {
  const CommandOutcome outcome = Fuse("room.ply");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("msc-vo-fusion"));
}

#endif  // MSC_VO_HAS_FUSION

TEST_F(FuseCommandTest, NamesATrajectoryOfOtherImages) {
  WriteFile(Path("other.txt"), "1e9 0 0 0 0 0 0 1\n");
  const CommandOutcome outcome =
      RunCommand({"fuse", Path("room"), Path("other.txt"), "--output", Path("room.ply")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "other.txt", "1"));
}

TEST_F(FuseCommandTest, RefusesNamesOfOtherFormats) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"fuse", Path("room"), Path("room/groundtruth.txt"), "--output", Path("room.obj")},
           {"export", Path("out"), "ply", Path("room.obj")},
           {"replay", Path("room"), "--export", "ply=" + Path("room.obj")}}) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, Names(".ply", "room.obj"));
    EXPECT_FALSE(HasEntry(Path("room.obj")));
  }
}

TEST_F(FuseCommandTest, DoesNotOverwriteTheTrajectory) {
  std::filesystem::copy_file(Path("room/groundtruth.txt"), Path("truth.ply"));
  const CommandOutcome outcome =
      RunCommand({"fuse", Path("room"), Path("truth.ply"), "--output", Path("truth.ply")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "truth.ply", "input"));
}

}  // namespace
}  // namespace msc_vo
