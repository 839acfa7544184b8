// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// msc_vo export.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sys/stat.h>

#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/results/tracked_features.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

class ExportCommandTest : public PreparedFolder {
 protected:
  void Prepare() override {
    Run({"synthesize", Path("x"), "--frames", "12", "--width", "160"});
    Run({"replay", Path("x"), "--output", Path("run"), "--map", Path("x.map"), "--quiet"});
  }
  static std::string Run(const std::vector<std::string>& arguments, int exit_code = 0) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    return outcome.output;
  }
};

TEST_F(ExportCommandTest, WritesEveryFormat) {
  const TrajectoryFile own = ReadTrajectoryFile(Path("run/trajectory.txt"));
  for (const std::string format : {"tum", "kitti", "euroc"}) {
    Run({"export", Path("run"), format, Path(format)});
    const TrajectoryFile file = ReadTrajectoryFile(Path(format));
    ASSERT_EQ(file.poses.size(), 12u) << format;
    EXPECT_LT(
        (file.poses[7].world_from_cam.translation() - own.poses[7].world_from_cam.translation())
            .norm(),
        1e-7)
        << format;
  }
  Run({"export", Path("run"), "nerfstudio", Path("t.json"), "--every", "3"});
  const auto json = nlohmann::json::parse(ReadFile(Path("t.json")));
  EXPECT_EQ(json["w"], 160);
  ASSERT_EQ(json["frames"].size(), 4u);
  EXPECT_TRUE(HasEntry(json["frames"][3]["file_path"]));
  EXPECT_TRUE(HasEntry(json["frames"][3]["depth_file_path"]));
  Run({"export", Path("x.map"), "g2o", Path("x.g2o")});
  EXPECT_THAT(ReadFile(Path("x.g2o")), testing::StartsWith("VERTEX_SE3:QUAT 0 "));
  Run({"export", Path("x.map"), "colmap", Path("model"), "--sequence", Path("x")});
  EXPECT_THAT(ReadFile(Path("model/images.txt")), testing::HasSubstr(" rgb/"));
  Run({"export", Path("x.map"), "colmap", Path("model"), "--binary"});
  EXPECT_GT(ReadFile(Path("model/points3D.bin")).size(), 1000u);
}

#ifdef MSC_VO_HAS_MCAP
TEST_F(ExportCommandTest, WritesBagsForRos2) {
  Run({"export", Path("run"), "mcap", Path("x.mcap"), "--images"});
  const auto bag = OpenBagFile(Path("x.mcap"));
  const TrajectoryFile own = ReadTrajectoryFile(Path("run/trajectory.txt"));
  for (const char* topic : {"/tf", "/msc_vo/pose", "/msc_vo/odometry", "/camera/color/camera_info",
                            "/camera/color/image_raw/compressed"}) {
    ASSERT_EQ(bag->NumMessages(topic), 12) << topic;
    EXPECT_EQ(bag->ReceiveTime(topic, 7), own.poses[7].timestamp) << topic;
  }
  // Numbers of the trajectory without a change, with the axes of ROS.
  const Eigen::Vector3d x = own.poses[7].world_from_cam.translation();
  const double turned[] = {x.z(), -x.x(), -x.y()};
  EXPECT_THAT(bag->Read("/msc_vo/pose", 7),
              testing::HasSubstr(std::string(reinterpret_cast<const char*>(turned), 24)));
  EXPECT_EQ(bag->NumMessages("/msc_vo/map_points"), 1);
  EXPECT_GT(bag->Read("/msc_vo/map_lines", 0).size(), 1000u);
  Run({"export", Path("run"), "mcap", Path("y.mcap"), "--every", "5"});
  EXPECT_EQ(OpenBagFile(Path("y.mcap"))->NumMessages("/msc_vo/pose"), 3);
  EXPECT_THAT(Run({"export", Path("run/trajectory.txt"), "mcap", Path("z.mcap")}, 1),
              Names("trajectory.txt", "folder"));
}
#endif

#ifdef MSC_VO_HAS_MCAP
// Ratio of the features with a coloured pixel beside them.
double DrawnRatio(const cv::Mat& image, const ViewedFeatures& features) {
  std::vector<Eigen::Vector2f> pixels;
  for (const ViewedPoint& point : features.points) pixels.push_back(point.pixel);
  for (const ViewedLine& line : features.lines) pixels.push_back(0.5f * (line.start + line.end));
  int num_drawn = 0;
  for (const Eigen::Vector2f& pixel : pixels) {
    const cv::Rect around(cvRound(pixel.x()) - 3, cvRound(pixel.y()) - 3, 7, 7);
    std::vector<cv::Mat> channels;
    cv::split(image(around & cv::Rect(0, 0, image.cols, image.rows)), channels);
    num_drawn += cv::norm(channels[0], channels[2], cv::NORM_INF) > 50.0;
  }
  return static_cast<double>(num_drawn) / static_cast<double>(pixels.size());
}

TEST_F(ExportCommandTest, DrawsFeaturesOfKeyframes) {
  Run({"export", Path("run"), "mcap", Path("x.mcap"), "--map", Path("x.map")});
  const std::string topic = "/msc_vo/features/compressed";
  const auto bag = OpenBagFile(Path("x.mcap"));
  const std::vector<TimedPose> keyframes = ReadTrajectoryFile(Path("run/keyframes.txt")).poses;
  const MapContents contents = LoadMap(Path("x.map"));
  const SavedSubMap& submap = contents.submaps.front();
  ASSERT_EQ(bag->NumMessages(topic), static_cast<int>(keyframes.size()));
  ASSERT_EQ(submap.map.keyframes().size(), keyframes.size());
  int i = 0;
  for (const auto& [id, keyframe] : submap.map.keyframes()) {
    EXPECT_EQ(bag->ReceiveTime(topic, i), keyframes[static_cast<size_t>(i)].timestamp);
    const std::string message = bag->Read(topic, i++);
    const size_t begin = message.find("\xFF\xD8\xFF");
    ASSERT_NE(begin, std::string::npos);
    const std::vector<char> jpeg(message.begin() + static_cast<long>(begin), message.end());
    const cv::Mat image = cv::imdecode(jpeg, cv::IMREAD_COLOR);
    ASSERT_EQ(image.size(), cv::Size(160, 120));
    const ViewedFeatures features = ObservedFeatures(keyframe, submap.map, submap.axes);
    EXPECT_GT(features.points.size(), 20u);
    EXPECT_GT(features.lines.size(), 5u);
    EXPECT_GT(DrawnRatio(image, features), 0.98);
    // Elsewhere the image is grey.
    ViewedFeatures mirrored = features;
    for (ViewedPoint& point : mirrored.points) point.pixel.x() = 159.0f - point.pixel.x();
    mirrored.lines.clear();
    EXPECT_LT(DrawnRatio(image, mirrored), 0.8);
  }
  EXPECT_THAT(Run({"export", Path("run"), "tum", Path("a"), "--map", Path("x.map")}, 2),
              Names("--map", "tum"));
}

TEST_F(ExportCommandTest, DrawsTheSessionOfTheRun) {
  Run({"synthesize", Path("y"), "--frames", "12", "--width", "160", "--seed", "2"});
  Run({"replay", Path("y"), "--output", Path("other"), "--map", Path("y.map"), "--quiet"});
  EXPECT_THAT(Run({"export", Path("run"), "mcap", Path("a.mcap"), "--map", Path("y.map")}, 1),
              Names("y.map", Path("x"), "--map"));
  EXPECT_FALSE(HasEntry(Path("a.mcap")));
  // A later session with the same time stamps.
  Run({"export", Path("run"), "mcap", Path("a.mcap"), "--map", Path("x.map")});
  Run({"replay", Path("y"), "--output", Path("other"), "--overwrite", "--map", Path("x.map"),
       "--quiet"});
  Run({"export", Path("run"), "mcap", Path("b.mcap"), "--map", Path("x.map")});
  const std::string topic = "/msc_vo/features/compressed";
  const auto before = OpenBagFile(Path("a.mcap")), after = OpenBagFile(Path("b.mcap"));
  ASSERT_EQ(before->NumMessages(topic), after->NumMessages(topic));
  EXPECT_TRUE(before->Read(topic, 0) == after->Read(topic, 0));
}
#endif

#ifdef MSC_VO_HAS_MCAP
// The bag has the rest of the run.
TEST_F(ExportCommandTest, LeavesOutImagesThatCannotBeRead) {
  const std::vector<TimedPose> keyframes = ReadTrajectoryFile(Path("run/keyframes.txt")).poses;
  ASSERT_GT(keyframes.size(), 1u);
  const std::string stamp = FormatText("%.6f", keyframes[0].timestamp);
  for (const std::string& image : ListFolder(Path("x/rgb"))) {
    const std::string name = std::filesystem::path(image).filename().string();
    if (name.find(stamp) == 0) WriteText("x/rgb/" + name, "damaged");
  }
  EXPECT_THAT(Run({"export", Path("run"), "mcap", Path("x.mcap"), "--map", Path("x.map")}),
              Names("x.mcap", "1 image", "/msc_vo/features/compressed"));
  const auto bag = OpenBagFile(Path("x.mcap"));
  EXPECT_EQ(bag->NumMessages("/msc_vo/pose"), 12);
  EXPECT_EQ(bag->NumMessages("/msc_vo/features/compressed"),
            static_cast<int>(keyframes.size()) - 1);
}

// Another program replaces the map after the run: the export of the run has the rest of it.
TEST_F(ExportCommandTest, ReplayLeavesOutFeaturesThatAreNotInTheMap) {
  std::filesystem::rename(Path("x"), Path("z"));
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  CommandProcess replay({"replay", Path("z"), "--output", Path("again"), "--map", Path("z.map"),
                         "--json", "--export", "mcap=" + Path("z.mcap")},
                        Path("pipe"));
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(fopen(Path("pipe").c_str(), "r"), fclose);
  ASSERT_GT(fcntl(fileno(pipe.get()), F_SETPIPE_SZ, 4096), 0);
  ASSERT_EQ(setvbuf(pipe.get(), nullptr, _IONBF, 0), 0);
  EXPECT_EQ(fgetc(pipe.get()), '{');  // the run has ended, and waits for the rest to be read
  EXPECT_TRUE(HasEntry(Path("z.map")));
  std::filesystem::rename(Path("x.map"), Path("z.map"));
  size_t num_bytes = 0;
  while (fgetc(pipe.get()) != EOF) ++num_bytes;
  EXPECT_GT(num_bytes, 4096u) << "all fits into the pipe";
  EXPECT_EQ(replay.Wait(), 0);
  EXPECT_THAT(replay.output(), Names("z.mcap", "left out", "z.map", "no keyframe"));
  const auto bag = OpenBagFile(Path("z.mcap"));
  EXPECT_EQ(bag->NumMessages("/msc_vo/pose"), 12);
  EXPECT_EQ(bag->FindTopic("/msc_vo/features/compressed"), nullptr);
  EXPECT_THAT(Run({"export", Path("again"), "mcap", Path("a.mcap"), "--map", Path("z.map")}, 1),
              Names("z.map", "no keyframe"));
}
#endif

#ifdef MSC_VO_HAS_FUSION
TEST_F(ExportCommandTest, WritesPointsWithNormals) {
  Run({"export", Path("run"), "ply", Path("fine.ply"), "--voxel", "0.05"});
  Run({"export", Path("run"), "ply", Path("coarse.ply"), "--voxel", "0.1"});
  const std::string fine = ReadFile(Path("fine.ply"));
  EXPECT_THAT(fine, testing::HasSubstr("property float nx\n"));
  EXPECT_GT(fine.size(), 2 * ReadFile(Path("coarse.ply")).size());
  // The same as of fuse.
  Run({"fuse", Path("x"), Path("run/trajectory.txt"), "--points", "--voxel", "0.05", "--output",
       Path("fused.ply")});
  EXPECT_TRUE(ReadFile(Path("fused.ply")) == fine);
  EXPECT_THAT(Run({"export", Path("run"), "ply", Path("a.ply"), "--max-depth", "0.1"}, 1),
              Names("--max-depth"));
}
#endif

#ifdef MSC_VO_HAS_FUSION
// What is not in the camera: reduced colour, masks, the unit of depth in floating-point numbers.
TEST_F(ExportCommandTest, ReadsTheImagesAsTheRunDid) {
  const auto expect_same = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> run = {"replay",
                                    Path("x"),
                                    "--output",
                                    Path("other"),
                                    "--overwrite",
                                    "--export",
                                    "ply=" + Path("run.ply"),
                                    "--quiet"};
    run.insert(run.end(), arguments.begin(), arguments.end());
    Run(run);
    Run({"export", Path("other"), "ply", Path("later.ply")});
    EXPECT_TRUE(ReadFile(Path("run.ply")) == ReadFile(Path("later.ply")));
    return ReadFile(Path("run.ply"));
  };
  const std::string whole = expect_same({});
  EXPECT_FALSE(expect_same({"--set", "camera.max_width=128"}).empty());
  cv::Mat mask(120, 160, CV_8UC1, cv::Scalar(0));
  mask.colRange(80, 160) = 255;
  ASSERT_TRUE(cv::imwrite(Path("mask.png"), mask));
  EXPECT_LT(expect_same({"--mask", Path("mask.png")}).size(), whole.size());
  for (const std::string& path : ListFolder(Path("x/depth"))) {
    cv::Mat depth;
    cv::imread(path, cv::IMREAD_UNCHANGED).convertTo(depth, CV_32F, 5.0 / 5000.0);
    ASSERT_TRUE(cv::imwrite(path.substr(0, path.size() - 4) + ".tiff", depth));
    std::filesystem::remove(path);
  }
  std::string list = ReadFile(Path("x/depth.txt"));
  for (size_t at; (at = list.find(".png")) != std::string::npos;) list.replace(at, 4, ".tiff");
  WriteText("x/depth.txt", list);
  std::filesystem::remove(Path("x/associations.txt"));
  const std::string of_floats = expect_same({"--set", "camera.float_depth_scale=5"});
  EXPECT_GT(of_floats.size(), whole.size() / 2);
}
#endif

// The images were taken with the camera of the run, whatever is said of the sequence later.
TEST_F(ExportCommandTest, TakesTheCameraOfTheRun) {
  Run({"export", Path("run"), "nerfstudio", Path("before.json")});
  WriteText("x/camera.txt", "200 200 79.5 59.5 160 120 5000\n");
  Run({"export", Path("run"), "nerfstudio", Path("after.json")});
  EXPECT_EQ(ReadFile(Path("after.json")), ReadFile(Path("before.json")));
  EXPECT_NE(nlohmann::json::parse(ReadFile(Path("after.json")))["fl_x"], 200.0);
  Run({"export", Path("run"), "nerfstudio", Path("other.json"), "--set", "camera.fx=150", "--set",
       "camera.fy=150"});
  EXPECT_EQ(nlohmann::json::parse(ReadFile(Path("other.json")))["fl_x"], 150.0);
}

TEST_F(ExportCommandTest, OverwritesNoInput) {
  const std::string frames = ReadFile(Path("run/frames.csv"));
  EXPECT_THAT(Run({"export", Path("run"), "tum", Path("run/frames.csv")}, 1), Names("frames.csv"));
  EXPECT_EQ(ReadFile(Path("run/frames.csv")), frames);
  const std::string planes = ReadFile(Path("run/planes.ply"));
  EXPECT_THAT(Run({"export", Path("run"), "ply", Path("run/planes.ply")}, 1),
              Names(Path("run/planes.ply"), "input"));
  EXPECT_EQ(ReadFile(Path("run/planes.ply")), planes);
  const std::string camera = ReadFile(Path("x/camera.txt"));
  EXPECT_THAT(Run({"export", Path("run"), "nerfstudio", Path("x/camera.txt")}, 1),
              Names("camera.txt"));
  EXPECT_EQ(ReadFile(Path("x/camera.txt")), camera);
}

// replay --export writes what msc_vo export writes afterwards.
TEST_F(ExportCommandTest, ReplayWritesTheSameBytes) {
  std::vector<std::string> replay = {"replay",  Path("x"),     "--output", Path("again"),
                                     "--quiet", "--overwrite", "--map",    Path("again.map")};
  std::vector<std::string> formats = {"tum", "kitti", "euroc", "nerfstudio", "g2o", "colmap"};
#ifdef MSC_VO_HAS_MCAP
  formats.push_back("mcap");
#endif
#ifdef MSC_VO_HAS_FUSION
  formats.push_back("ply");
#endif
  for (const std::string& format : formats) {
    replay.push_back("--export");
    replay.push_back(format + "=" + Path("a." + format));
  }
  Run(replay);
  for (const std::string& format : formats) {
    const bool is_map = format == "g2o" || format == "colmap";
    std::vector<std::string> arguments = {"export", Path(is_map ? "again.map" : "again"), format,
                                          Path("b." + format)};
    if (format == "colmap") {
      arguments.push_back("--sequence");
      arguments.push_back(Path("x"));
    }
    if (format == "mcap") arguments.insert(arguments.end(), {"--map", Path("again.map")});
    Run(arguments);
    const std::string file = format == "colmap" ? "/images.txt" : "";
    EXPECT_TRUE(ReadFile(Path("a." + format + file)) == ReadFile(Path("b." + format + file)))
        << format;
  }
}

// Both sessions have images of the same times and names.
TEST_F(ExportCommandTest, NamesTheImagesOfTheSessionOfTheSequence) {
  std::filesystem::copy_file(Path("x.map"), Path("two.map"));
  Run({"synthesize", Path("y"), "--frames", "12", "--width", "160", "--path", "2"});
  Run({"replay", Path("y"), "--output", Path("second"), "--map", Path("two.map"), "--quiet",
       "--export", "colmap=" + Path("m")});
  std::istringstream words(ReadFile(Path("m/images.txt")));
  std::vector<std::string> names;
  for (std::string word; words >> word;) {
    if (word.rfind("rgb/", 0) == 0) names.push_back(word);
  }
  EXPECT_EQ(names.size(), ReadTrajectoryFile(Path("second/keyframes.txt")).poses.size());
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_THAT(Run({"export", Path("two.map"), "colmap", Path("n"), "--sequence", Path("z")}, 1),
              Names(Path("z")));
}

TEST_F(ExportCommandTest, ReplayFailsBeforeTheRun) {
  const auto replay = [this](const std::string& text, int exit_code) {
    return Run({"replay", Path("x"), "--output", Path("new"), "--export", text}, exit_code);
  };
  EXPECT_THAT(replay("obj=" + Path("m"), 2), Names("obj", "nerfstudio"));
  EXPECT_THAT(replay("tum", 2), Names("tum", "FORMAT=PATH"));
  EXPECT_THAT(replay("tum=" + Path("none/poses.txt"), 1), Names("none/poses.txt"));
  EXPECT_THAT(replay("colmap=" + Path("m"), 1), Names("colmap", "--map FILE"));
  EXPECT_THAT(replay("tum=" + Path("x/camera.txt"), 1), Names("camera.txt"));
  EXPECT_FALSE(HasEntry(Path("new/trajectory.txt")));
}

// The transform between two worlds is unknown.
TEST_F(ExportCommandTest, ReplayRefusesPathsThatAreTaken) {
  const std::vector<std::string> replay = {"replay", Path("x"), "--output", Path("new"), "--quiet"};
  const auto refuse = [&](const std::vector<std::string>& exports) {
    std::vector<std::string> arguments = replay;
    for (const std::string& one : exports) arguments.insert(arguments.end(), {"--export", one});
    EXPECT_THAT(Run(arguments, 1), Names("--export", "another one"));
    EXPECT_FALSE(HasEntry(Path("new/trajectory.txt")));
  };
  refuse({"tum=" + Path("a.txt"), "kitti=" + Path("a.txt")});
  refuse({"tum=" + Path("new/keyframes.txt")});
  refuse({"tum=" + Path("new/report.html")});
}

#ifdef MSC_VO_HAS_MCAP
TEST_F(ExportCommandTest, KeepsABagThatItCannotReplace) {
  WriteText("x.mcap", "an earlier one");
  for (const std::string& path : ListFolder(Path("x/rgb")))
    WriteText("x/rgb/" + path.substr(path.rfind('/') + 1), "damaged");
  Run({"export", Path("run"), "mcap", Path("x.mcap"), "--images"}, 1);
  EXPECT_EQ(ReadFile(Path("x.mcap")), "an earlier one");
  EXPECT_FALSE(HasEntry(Path("x.mcap.part")));
}
#endif

TEST_F(ExportCommandTest, TakesOneWorld) {
  WriteText("two.txt",
            "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n# segment 1, world 1\n3 0 0 0 0 0 0 1\n"
            "# not estimated\n4 0 0 0 0 0 0 1\n");
  for (const std::string format : {"kitti", "euroc"}) {
    EXPECT_THAT(Run({"export", Path("two.txt"), format, Path(format)}),
                Names("two.txt", "2 of 3 poses", "segment 0"));
    EXPECT_EQ(ReadTrajectoryFile(Path(format)).poses.size(), 2u);
  }
  EXPECT_THAT(Run({"export", Path("two.txt"), "kitti", Path("kitti")}), Names("2 of 4", "frames"));
  Run({"export", Path("two.txt"), "tum", Path("tum")});
  EXPECT_EQ(ReadTrajectoryFile(Path("tum")).poses.size(), 3u);
}

TEST_F(ExportCommandTest, SaysWhatIsWrong) {
  EXPECT_THAT(Run({"export", Path("run"), "colmap", Path("m")}, 1), Names("run", "--map"));
  EXPECT_THAT(Run({"export", Path("run"), "obj", Path("m")}, 2), Names("obj", "nerfstudio"));
  EXPECT_THAT(Run({"export", Path("none"), "tum", Path("m")}, 1), Names("none"));
  EXPECT_THAT(Run({"export", Path("run/trajectory.txt"), "nerfstudio", Path("m")}, 1),
              Names("trajectory.txt", "--sequence"));
  EXPECT_THAT(Run({"export", Path("x.map"), "g2o", Path("x.map")}, 1), Names("x.map"));
  Run({"synthesize", Path("y"), "--frames", "2", "--width", "160", "--fps", "7"});
  EXPECT_THAT(Run({"export", Path("x.map"), "colmap", Path("m"), "--sequence", Path("y")}, 1),
              Names("y", "no image of the keyframe"));
}

}  // namespace
}  // namespace msc_vo
