// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <csignal>

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

#include "msc_vo/datasets/accelerometer.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class SynthesizeCommandTest : public TemporaryFolder {
 protected:
  // Renders one small image.
  CommandOutcome Synthesize(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", Path(name), "--frames",
                                          "1",          "--width",  "160"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  // The same, which must succeed. Returns truth.json.
  nlohmann::json Truth(const std::string& name, const std::vector<std::string>& more) {
    const CommandOutcome outcome = Synthesize(name, more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return nlohmann::json::parse(ReadFile(Path(name + "/truth.json")));
  }
  std::string Camera(const std::string& name) { return ReadFile(Path(name + "/camera.txt")); }
  std::string Color(const std::string& name) { return ReadFile(Path(name + "/rgb/1.000000.png")); }
  std::string Depth(const std::string& name) {
    return ReadFile(Path(name + "/depth/1.000000.png"));
  }
  size_t ColorBytes(const std::string& name) {
    return ReadFile(Path(name + "/rgb/1.000000.jpg")).size();
  }
};

TEST_F(SynthesizeCommandTest, AppliesTheJpegQuality) {
  ASSERT_EQ(Synthesize("default", {"--jpeg"}).exit_code, 0);
  ASSERT_EQ(Synthesize("same", {"--jpeg", "--jpeg-quality", "95"}).exit_code, 0);
  ASSERT_EQ(Synthesize("small", {"--jpeg", "--jpeg-quality", "50"}).exit_code, 0);
  EXPECT_EQ(ColorBytes("same"), ColorBytes("default"));
  EXPECT_LT(ColorBytes("small"), ColorBytes("default") / 2);
}

TEST_F(SynthesizeCommandTest, RejectsJpegQualityWithoutJpeg) {
  const CommandOutcome outcome = Synthesize("png", {"--jpeg-quality", "90"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("--jpeg"));
}

TEST_F(SynthesizeCommandTest, WritesAnAccelerometer) {
  ASSERT_EQ(Synthesize("room", {"--fps", "2"}).exit_code, 0);
  const std::vector<TimedAcceleration> readings = ReadAccelerometer(OpenSequence(Path("room")));
  ASSERT_FALSE(readings.empty());
  // The camera is held upright: up is against its y axis.
  EXPECT_LT(readings.front().acceleration.y(), -8.0);
}

TEST_F(SynthesizeCommandTest, WritesTheTruth) {
  const nlohmann::json truth = Truth("room", {"--seed", "7"});
  const nlohmann::json& camera = truth["camera"];
  EXPECT_EQ(camera["fx"], 131.25);
  EXPECT_EQ(camera["cy"], 59.5);
  EXPECT_EQ(camera["width"], 160);
  EXPECT_EQ(camera["lens"], "radial-tangential");
  EXPECT_EQ(camera["distortion"], std::vector<double>(5, 0.0));
  EXPECT_EQ(camera["depth_scale"], 5000.0);
  EXPECT_EQ(camera["readout_time"], 0.0);
  EXPECT_TRUE(camera["depth_camera"].is_null());
  EXPECT_TRUE(truth["given"]["readout_time"].is_null());
  for (const char* key : {"fx", "fy", "cx", "cy", "height", "distortion", "depth_scale"}) {
    EXPECT_EQ(truth["given"][key], camera[key]) << key;
  }
  EXPECT_EQ(truth["seed"], 7);
  EXPECT_EQ(truth["depth_sensor"], "exact");
  EXPECT_TRUE(truth["light"].is_null());
  EXPECT_EQ(truth["hunting_exposure"], false);
  EXPECT_EQ(truth["motion_blur"], 0.0);
}

TEST_F(SynthesizeCommandTest, RecordsOtherPathsThroughAScene) {
  const nlohmann::json first = Truth("first", {"--scene", "desks"});
  const nlohmann::json other = Truth("other", {"--scene", "desks", "--path", "2", "--returns"});
  EXPECT_EQ(first["path"], 1);
  EXPECT_EQ(first["returns"], false);
  EXPECT_EQ(other["path"], 2);
  EXPECT_EQ(other["returns"], true);
  EXPECT_EQ(ReadFile(Path("first/edges.ply")), ReadFile(Path("other/edges.ply")));
  EXPECT_NE(ReadFile(Path("first/groundtruth.txt")), ReadFile(Path("other/groundtruth.txt")));
  const CommandOutcome outcome = Synthesize("room", {"--scene", "room", "--returns"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("--returns"), HasSubstr("rooms")));
}

TEST_F(SynthesizeCommandTest, RecordsAWalkToItsEnd) {
  const CommandOutcome outcome =
      RunCommand({"synthesize", Path("walk"), "--scene", "floors", "--width", "64", "--fps", "0.5",
                  "--speed", "1", "--turn-rate", "90", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string truth = ReadFile(Path("walk/groundtruth.txt"));
  const auto count = std::count(truth.begin(), truth.end(), '\n') - 1;  // a header
  EXPECT_GT(count, 4);
  EXPECT_LT(count, 30);
}

TEST_F(SynthesizeCommandTest, WritesTheTrueCamerasThatAreUntold) {
  const std::string lens = "--lens=radial-tangential:-0.3,0.1,0,0,0";
  const std::string rig = "--rig=146.25,0.025,0,0";
  nlohmann::json truth = Truth("told", {lens, rig});
  EXPECT_EQ(truth["given"]["distortion"], truth["camera"]["distortion"]);
  EXPECT_EQ(truth["given"]["depth_camera"], truth["camera"]["depth_camera"]);
  EXPECT_THAT(Camera("told"),
              HasSubstr(" 5000 -0.3 0.1 0 0 0\ndepth_camera 146.25 146.25 79.5 59.5 "
                        "160 120 0.025 0 0 0 0 0 1\n"));
  truth = Truth("untold", {lens, rig, "--untold"});
  EXPECT_EQ(truth["camera"]["distortion"], (std::vector<double>{-0.3, 0.1, 0.0, 0.0, 0.0}));
  EXPECT_EQ(truth["camera"]["depth_camera"]["fx"], 146.25);
  EXPECT_EQ(truth["camera"]["depth_camera"]["translation"], (std::vector<double>{0.025, 0.0, 0.0}));
  EXPECT_EQ(truth["given"]["distortion"], std::vector<double>(5, 0.0));
  EXPECT_TRUE(truth["given"]["depth_camera"].is_null());
  EXPECT_THAT(Camera("untold"), StartsWith("131.25 131.25 79.5 59.5 160 120 5000\n#"));
  truth = Truth("rolling", {"--readout-time", "0.02"});
  EXPECT_EQ(truth["camera"]["readout_time"], 0.02);
}

TEST_F(SynthesizeCommandTest, WritesAWrongCalibration) {
  Truth("right", {});
  const nlohmann::json truth =
      Truth("wrong", {"--focal-length-error", "2", "--principal-point-error", "3,-1.5"});
  EXPECT_THAT(Camera("wrong"), StartsWith("133.875 133.875 82.5 58 160 120 5000\n"));
  EXPECT_EQ(truth["camera"]["fx"], 131.25);
  EXPECT_EQ(truth["camera"]["cx"], 79.5);
  EXPECT_EQ(truth["given"]["fy"], 133.875);
  EXPECT_EQ(truth["given"]["cy"], 58.0);
  EXPECT_EQ(Color("wrong"), Color("right"));
  EXPECT_EQ(Depth("wrong"), Depth("right"));
  Truth("short", {"--focal-length-error", "-2"});
  EXPECT_THAT(Camera("short"), StartsWith("128.625 128.625 79.5 59.5 "));
  // With a depth camera and a lens, the errors are those of the colour camera alone.
  Truth("rig", {"--focal-length-error=2", "--rig=146.25,0,0,0", "--lens=fisheye:0.02,0,0,0"});
  EXPECT_THAT(Camera("rig"),
              AllOf(StartsWith("133.875 133.875 79.5 "), HasSubstr("\nlens fisheye 0.02 0 0 0\n"),
                    HasSubstr("\ndepth_camera 146.25 146.25 ")));
}

TEST_F(SynthesizeCommandTest, AppliesErrorsOfColourImages) {
  Truth("plain", {"--fps", "5"});
  const std::vector<std::pair<std::string, std::vector<std::string>>> errors = {
      {"light", {"--light", "0.2"}},
      {"hunting_exposure", {"--hunting-exposure"}},
      {"motion_blur", {"--motion-blur", "0.5"}}};
  for (const auto& [name, option] : errors) {
    std::vector<std::string> arguments = {"--fps", "5"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const nlohmann::json truth = Truth(name, arguments);
    EXPECT_EQ(truth[name].dump(), option.size() == 1 ? "true" : option[1]);
    EXPECT_NE(Color(name), Color("plain")) << name;
    EXPECT_EQ(Depth(name), Depth("plain")) << name;
    EXPECT_EQ(Camera(name), Camera("plain")) << name;
    EXPECT_EQ(Truth(name + "_again", arguments), truth);
    EXPECT_EQ(Color(name + "_again"), Color(name)) << name;
  }
}

TEST_F(SynthesizeCommandTest, AppliesErrorsOfDepthImages) {
  Truth("plain", {});
  nlohmann::json truth = Truth("scale", {"--depth-factor", "1.1"});
  EXPECT_EQ(truth["camera"]["depth_scale"], 5500.0);
  EXPECT_EQ(truth["given"]["depth_scale"], 5000.0);
  EXPECT_EQ(Camera("scale"), Camera("plain"));
  EXPECT_EQ(Color("scale"), Color("plain"));
  const auto depth_at_center = [this](const std::string& name) {
    return cv::imread(Path(name + "/depth/1.000000.png"), cv::IMREAD_UNCHANGED)
        .at<uint16_t>(60, 80);
  };
  EXPECT_NEAR(depth_at_center("scale"), 1.1 * depth_at_center("plain"), 1.0);
  truth = Truth("unbiased", {"--depth-sensor", "tof", "--depth-bias", "0"});
  EXPECT_EQ(truth["depth_sensor"], "tof");
  EXPECT_EQ(truth["depth_bias"], 0.0);
  EXPECT_EQ(Truth("tof", {"--depth-sensor", "tof"})["depth_bias"], 0.005);
  EXPECT_EQ(Truth("biased", {"--depth-sensor", "tof", "--depth-bias", "0.2"})["depth_bias"], 0.2);
  const double tof = depth_at_center("tof") - depth_at_center("unbiased");
  EXPECT_NEAR(depth_at_center("biased") - depth_at_center("unbiased"), 40.0 * tof, 21.0);
}

TEST_F(SynthesizeCommandTest, RendersSpecularSurfaces) {
  EXPECT_EQ(Truth("plain", {})["specular"], nlohmann::json::array());
  const nlohmann::json truth = Truth("floor", {"--specular", "floor,mirror"});
  EXPECT_EQ(truth["specular"], (std::vector<std::string>{"floor", "mirror"}));
  EXPECT_NE(Color("floor"), Color("plain"));
  EXPECT_NE(Depth("floor"), Depth("plain"));
  EXPECT_EQ(Camera("floor"), Camera("plain"));
  Truth("again", {"--specular", "mirror", "--specular", "floor"});
  EXPECT_EQ(Color("again"), Color("floor"));
  EXPECT_EQ(Depth("again"), Depth("floor"));
}

TEST_F(SynthesizeCommandTest, DisplacesDepthOfIclNuim) {
  nlohmann::json truth = Truth("plain", {"--depth-sensor", "icl-nuim"});
  EXPECT_EQ(truth["depth_sensor"], "icl-nuim");
  EXPECT_EQ(truth["depth_offset"], (std::vector<double>{0.0, 0.0}));
  // Pixels of a focal length of 525 px; these images have 131.25 px.
  truth = Truth("moved", {"--depth-sensor", "icl-nuim", "--depth-offset", "40,-20"});
  EXPECT_EQ(truth["depth_offset"], (std::vector<double>{40.0, -20.0}));
  EXPECT_EQ(Color("moved"), Color("plain"));
  const cv::Mat plain = cv::imread(Path("plain/depth/1.000000.png"), cv::IMREAD_UNCHANGED);
  const cv::Mat moved = cv::imread(Path("moved/depth/1.000000.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(plain.size(), moved.size());
  // Median differences of depth, without and with the offset.
  const cv::Rect of_plain(20, 10, 120, 90), of_moved(10, 15, 120, 90);
  const auto median_difference = [&](const cv::Rect& a, const cv::Rect& b) {
    cv::Mat difference;
    cv::absdiff(plain(a), moved(b), difference);
    std::vector<uint16_t> values(difference.begin<uint16_t>(), difference.end<uint16_t>());
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  EXPECT_LT(median_difference(of_plain, of_moved), median_difference(of_plain, of_plain));
}

TEST_F(SynthesizeCommandTest, SaysHowManyImagesAnInterruptedRunHasWritten) {
  CommandProcess synthesize({"synthesize", Path("long"), "--frames", "5000", "--width", "160"});
  const std::string truth = Path("long/groundtruth.txt");
  for (int i = 0; i < 60000; ++i) {
    if (HasEntry(truth) && ReadFile(truth).size() > 200) break;  // it has poses
    usleep(1000);
  }
  synthesize.Signal(SIGINT);
  EXPECT_EQ(synthesize.Wait(), 130) << synthesize.output();
  EXPECT_THAT(synthesize.output(), LineNames("interrupted", Path("long"), "5000"));
}

// The same options render the same sequence again, and take nothing away.
TEST_F(SynthesizeCommandTest, ReplacesTheSequenceOfTheSameOptions) {
  Truth("room", {"--seed", "3"});
  const std::string color = Color("room");
  WriteText("room/rgb/1.000000.png", "damaged");
  WriteText("room/notes.txt", "mine");
  Truth("room", {"--seed", "3", "--scene", "room", "--json"});  // the default scene
  EXPECT_TRUE(Color("room") == color);
  EXPECT_EQ(ReadFile(Path("room/notes.txt")), "mine");

  WriteText("room/rgb/9.500000.png", "of a run that was killed");
  Truth("room", {"--seed", "3", "--fps", "30.0", "--hunting-exposure=false"});  // the same options
  EXPECT_FALSE(HasEntry(Path("room/rgb/9.500000.png")));

  WriteText("room/depth/mine.png", "mine");
  const CommandOutcome added = Synthesize("room", {"--seed", "3"});
  EXPECT_EQ(added.exit_code, 1);
  EXPECT_THAT(added.output, LineNames("error:", Path("room/depth/mine.png"), "--overwrite"));
  EXPECT_TRUE(Color("room") == color);
}

TEST_F(SynthesizeCommandTest, RefusesToReplaceOtherSequences) {
  const std::string fine = "--fps=60";
  Truth("room", {"--seed", "3", fine});
  const std::string color = Color("room");
  const CommandOutcome other = Synthesize("room", {"--seed", "4", fine});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.output, LineNames("error:", Path("room"), "--seed", "3", "4", "--overwrite"));
  const CommandOutcome jpeg = Synthesize("room", {"--seed", "3", fine, "--jpeg"});
  EXPECT_EQ(jpeg.exit_code, 1);
  EXPECT_THAT(jpeg.output, LineNames("error:", Path("room"), "--jpeg", "--overwrite"));
  EXPECT_TRUE(Color("room") == color);

  WriteText("room/rgb/mine.png", "mine");
  Truth("room", {"--seed", "3", fine, "--jpeg", "--overwrite"});
  EXPECT_FALSE(HasEntry(Path("room/rgb/1.000000.png")));
  EXPECT_GT(ColorBytes("room"), 0U);
  EXPECT_EQ(ReadFile(Path("room/rgb/mine.png")), "mine");
}

TEST_F(SynthesizeCommandTest, KeepsTheFilesOfOthersInTheirFolders) {
  WriteText("other/rgb.txt", "1.5 rgb/1.500000.png\n1.6 ../kept.png\n");
  WriteText("other/rgb/1.500000.png", "theirs");
  WriteText("kept.png", "theirs");
  const CommandOutcome outcome = Synthesize("other", {});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", Path("other"), "--overwrite"));
  Truth("other", {"--overwrite"});
  EXPECT_EQ(ReadFile(Path("other/rgb/1.500000.png")), "theirs");
  // A list of a sequence that names files elsewhere.
  WriteText("other/rgb.txt", "1.0 rgb/../../kept.png\n1.1 ../kept.png\n");
  Truth("other", {"--overwrite", "--seed", "2"});
  EXPECT_EQ(ReadFile(Path("kept.png")), "theirs");
}

TEST_F(SynthesizeCommandTest, RefusesBadValues) {
  const auto expect_refused = [this](const std::vector<std::string>& arguments,
                                     const NamesMatcher& names) {
    const CommandOutcome outcome = Synthesize("bad", arguments);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, AllOf(names, Not(HasSubstr("SyntheticSequence"))));
    EXPECT_FALSE(HasEntry(Path("bad"))) << testing::PrintToString(arguments);
  };
  expect_refused({"--focal-length-error", "-95"}, Names("--focal-length-error", "-95"));
  expect_refused({"--focal-length-error", "a"}, Names("--focal-length-error"));
  expect_refused({"--principal-point-error", "3"}, Names("--principal-point-error", "2"));
  expect_refused({"--principal-point-error", "3,nan"}, Names("--principal-point-error", "nan"));
  expect_refused({"--principal-point-error", "100,0"}, Names("camera.txt", "cx", "179.5"));
  expect_refused({"--light", "0"}, Names("--light", "0"));
  expect_refused({"--light", "1.5"}, Names("--light", "1.5"));
  expect_refused({"--motion-blur", "1.5"}, Names("--motion-blur", "1.5"));
  expect_refused({"--hunting-exposure=maybe"}, Names("--hunting-exposure"));
  expect_refused({"--depth-factor", "0"}, Names("--depth-factor", "0"));
  expect_refused({"--depth-bias", "0.01"}, Names("--depth-bias", "--depth-sensor tof"));
  expect_refused({"--depth-bias", "0.01", "--sensor", "stereo"},
                 Names("--depth-bias", "--depth-sensor tof"));
  expect_refused({"--specular", "window"}, Names("--specular", "window"));
  expect_refused({"--specular", "mirror", "--scene", "bare"}, Names("--specular", "--scene room"));
  expect_refused({"--depth-offset", "1,2"}, Names("--depth-offset", "--depth-sensor icl-nuim"));
  expect_refused({"--depth-offset", "1", "--depth-sensor", "icl-nuim"}, Names("--depth-offset"));
  expect_refused({"--depth-offset", "1,200", "--depth-sensor", "icl-nuim"},
                 Names("--depth-offset", "200"));
  expect_refused({"--returns"}, Names("--returns", "--scene rooms"));
  expect_refused({"--readout-time", "0.5"},
                 LineNames("error:", "--readout-time", "0.0333333 s", "0.5 s"));
  expect_refused({"--readout-time", "0.01", "--lens", "fisheye:0.1,0,0,0"},
                 LineNames("error:", "--readout-time", "lens"));
  expect_refused({"--depth-delay", "-0.2", "--stride", "3"},
                 LineNames("error:", "--depth-delay", "0.05 s", "-0.2 s"));
  expect_refused({"--focal-length", "5"}, LineNames("error:", "--focal-length", "5 px"));
  expect_refused({"--rig", "5,0,0,0"}, LineNames("error:", "--rig", "5 px"));
  expect_refused({"--rig", "300,2,0,0"}, LineNames("error:", "--rig", "2 m"));
  const CommandOutcome small = RunCommand({"synthesize", Path("bad"), "--width", "33"});
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_THAT(small.output, LineNames("error:", "width", "33x24"));
}

}  // namespace
}  // namespace msc_vo
