// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/run_json.h"

#include <cmath>
#include <limits>
#include <vector>

#include "fake_run.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/report/base64.h"

namespace msc_vo {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

FrameView MakeView(int frame) {
  FrameView view;
  view.frame = frame;
  view.jpeg = "\xff\xd8 picture";
  view.features.points = {{{1.0F, 2.5F}, true}, {{-3.0F, 1e9F}, false}};
  view.features.lines = {{{10.0F, 20.0F}, {30.0F, 40.0F}, LineColor::kAxis2},
                         {{0.0F, 0.0F}, {1.0F, 1.0F}, LineColor::kWithoutDepth}};
  return view;
}

TEST(RunJson, HasOneColumnPerQuantity) {
  ReportData data = MakeFakeRun(3);
  data.frames[1].rotation_sigma_deg = 0.5;
  data.frames[1].translation_sigma = 0.25;
  data.frames[1].world_sigma = CameraSigma{0.75, 0.5};
  data.frames[1].submap = kNoSubMapNumber;
  data.frames[2].submap = 7;
  const json run = json::parse(FormatRunJson(data));
  const json& frames = run["frames"];
  EXPECT_EQ(frames["first"], 0);
  EXPECT_EQ(frames["time"], EncodeBase64(std::vector<float>{0.0F, 1 / 30.0F, 2 / 30.0F}));
  EXPECT_EQ(frames["keyframe"], EncodeBase64(std::vector<uint8_t>{1, 0, 0}));
  EXPECT_EQ(frames["submap"], EncodeBase64(std::vector<uint16_t>{0, 65535, 7}));
  // Base64 has four characters for three bytes: 3 frames of 7 and 5 floats and 4 shorts.
  EXPECT_EQ(frames["pose"].get<std::string>().size(), 3u * 7 * 4 * 4 / 3);
  std::vector<float> sigma(3 * 6, std::numeric_limits<float>::quiet_NaN());
  for (size_t i = 0; i < 3; ++i) {
    if (data.frames[i].rotation_sigma_deg) sigma[6 * i] = *data.frames[i].rotation_sigma_deg;
    if (data.frames[i].translation_sigma) sigma[6 * i + 1] = *data.frames[i].translation_sigma;
  }
  sigma[6 + 2] = 0.75F;
  sigma[6 + 3] = 0.5F;
  EXPECT_EQ(frames["sigma"], EncodeBase64(sigma));
  EXPECT_EQ(frames["stage_ms"].get<std::string>().size(), 3u * 5 * 4 * 4 / 3);
  EXPECT_EQ(frames["counts"].get<std::string>().size(), 3u * 4 * 2 * 4 / 3);
  EXPECT_EQ(run["stages"][0], (json{{"name", "points"}, {"stacked", false}}));
  EXPECT_EQ(run["camera"]["width"], 640);
}

TEST(RunJson, StoresTheMapWithoutInvalidLandmarks) {
  ReportData data = MakeFakeRun(3);
  data.map.lines = {{{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)}, 2},
                    {{Eigen::Vector3d::Constant(NAN), Eigen::Vector3d::Zero()}, 0},
                    {{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}, -1}};
  data.map.points = {{7, 8, 9}, {INFINITY, 0, 0}};
  data.map.world_from_axes = Eigen::Quaterniond::Identity();
  const json map = json::parse(FormatRunJson(data))["map"];
  EXPECT_EQ(map["lines"], EncodeBase64(std::vector<float>{1, 2, 3, 4, 5, 6, 0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(map["line_axes"], EncodeBase64(std::vector<uint8_t>{2, 3}));
  EXPECT_EQ(map["points"], EncodeBase64(std::vector<float>{7, 8, 9}));
  EXPECT_EQ(map["axes"], json({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}));
}

TEST(RunJson, StoresViewsInEighthsOfAPixel) {
  ReportData data = MakeFakeRun(3);
  data.views = {MakeView(1)};
  const json view = json::parse(FormatRunJson(data))["views"][0];
  EXPECT_EQ(view["frame"], 1);
  EXPECT_EQ(view["jpeg"], EncodeBase64("\xff\xd8 picture", 10));
  EXPECT_EQ(view["points"], EncodeBase64(std::vector<uint16_t>{8, 20, 0, 65535}));
  EXPECT_EQ(view["point_depth"], EncodeBase64(std::vector<uint8_t>{1, 0}));
  EXPECT_EQ(view["lines"], EncodeBase64(std::vector<uint16_t>{80, 160, 240, 320, 0, 0, 8, 8}));
  EXPECT_EQ(view["line_colors"], EncodeBase64(std::vector<uint8_t>{2, 4}));
}

TEST(RunJson, IsSafeInsideOfAScriptElement) {
  ReportData data = MakeFakeRun(2);
  data.stages[0].name = "</script><!--\xff";
  const std::string text = FormatRunJson(data);
  EXPECT_THAT(text, Not(HasSubstr("<")));
  EXPECT_THAT(json::parse(text)["stages"][0]["name"].get<std::string>(),
              HasSubstr("</script><!--"));
}

TEST(RunJson, HasNoFramesWithoutFrames) {
  EXPECT_FALSE(json::parse(FormatRunJson({})).contains("frames"));
  const json live = json::parse(FormatLiveRunJson("abc", MakeFakeRun(2)));
  EXPECT_FALSE(live.contains("frames"));
  EXPECT_EQ(live["live"], true);
  EXPECT_EQ(live["run"], "abc");
}

TEST(RunJson, ListsLoopsBetweenFramesOfTheRun) {
  ReportData data = MakeFakeRun(5);
  EXPECT_EQ(json::parse(FormatRunJson(data))["loops"], json::array());
  data.loops = {{4, 0}, {3, -1}, {5, 1}};
  EXPECT_EQ(json::parse(FormatRunJson(data))["loops"], json::parse("[[4, 0]]"));
}

TEST(RunJson, StoresThePathBeforeLoopsAndThoseOfEarlierSessions) {
  ReportData data = MakeFakeRun(3);
  const json plain = json::parse(FormatRunJson(data));
  for (const char* key : {"odometry", "found", "place"}) EXPECT_FALSE(plain.contains(key)) << key;
  EXPECT_FALSE(plain["map"].contains("sessions"));
  data.odometry = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  data.found_frame = 2;
  data.place = {2, "\xff\xd8 run", 7, "\xff\xd8 map"};
  data.map.sessions = {{"monday", {{1, 0, 0}}}, {"tuesday", {{0, 1, 0}, {0, 2, 0}}}};
  const json run = json::parse(FormatRunJson(data));
  EXPECT_EQ(run["odometry"], EncodeBase64(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(run["found"], 2);
  EXPECT_EQ(run["place"], json({{"frame", 2},
                                {"jpeg", EncodeBase64("\xff\xd8 run", 6)},
                                {"keyframe", 7},
                                {"keyframe_jpeg", EncodeBase64("\xff\xd8 map", 6)}}));
  EXPECT_EQ(run["map"]["sessions"][0]["name"], "monday");
  EXPECT_EQ(run["map"]["sessions"][1]["positions"],
            EncodeBase64(std::vector<float>{0, 1, 0, 0, 2, 0}));
}

TEST(RunJson, StoresPlanesAsTriangles) {
  ReportData data = MakeFakeRun(3);
  EXPECT_FALSE(json::parse(FormatRunJson(data))["map"].contains("planes"));
  data.map.planes = {{{{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}}, 1},
                     {{{0, 0, 1}, {0, 1, 1}, {1, 1, std::nan("")}}, 0},
                     {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}}, -1}};
  const json planes = json::parse(FormatRunJson(data))["map"]["planes"];
  EXPECT_EQ(planes["triangles"],
            EncodeBase64(std::vector<float>{0, 0, 2, 0, 1, 2, 1, 1, 2, 0, 0, 2, 1, 1,
                                            2, 1, 0, 2, 0, 0, 1, 0, 1, 1, 1, 1, 1}));
  EXPECT_EQ(planes["axes"], EncodeBase64(std::vector<uint8_t>{1, 1, 3}));
}

TEST(RunJson, UpdatesHoldOnlyWhatIsNew) {
  RunUpdate update;
  update.run = "abc";
  update.state = "running";
  update.map_version = 4;
  const json nothing = json::parse(FormatRunUpdate(update));
  EXPECT_EQ(nothing["state"], "running");
  EXPECT_EQ(nothing["map_version"], 4);
  for (const char* key : {"frames", "map", "views", "moved", "loops", "found", "place"}) {
    EXPECT_FALSE(nothing.contains(key)) << key;
  }

  const ReportData data = MakeFakeRun(5);
  const FrameView view = MakeView(4);
  update.frames = {data.frames[3], data.frames[4]};
  update.first_frame = 3;
  update.start = data.frames[0].timestamp;
  update.map = &data.map;
  update.view = &view;
  update.num_processed = 5;
  update.moved_frames = {data.frames[0]};
  update.moved_frames[0].world_from_cam = Rigid3();
  update.loops = {{4, 0}, {5, 0}};
  update.found_frame = 1;
  update.place = {1, "run", 7, "map"};
  const json all = json::parse(FormatRunUpdate(update));
  EXPECT_EQ(all["moved"]["pose"], EncodeBase64(std::vector<float>{0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(all["moved"]["submap"], EncodeBase64(std::vector<uint16_t>{0}));
  EXPECT_EQ(all["loops"], json::parse("[[4, 0]]"));
  EXPECT_EQ(all["found"], 1);
  EXPECT_EQ(all["place"]["keyframe_jpeg"], EncodeBase64("map", 3));
  EXPECT_EQ(all["frames"]["first"], 3);
  EXPECT_EQ(all["frames"]["time"], EncodeBase64(std::vector<float>{3 / 30.0F, 4 / 30.0F}));
  EXPECT_EQ(all["map"]["line_axes"].get<std::string>().size(), 32u);  // 24 bytes
  EXPECT_EQ(all["views"][0]["frame"], 4);
}

}  // namespace
}  // namespace msc_vo
