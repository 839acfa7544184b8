// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Maps that outlive a run: replay --map and --localize, and the command map.

#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <unistd.h>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/map_file/map_images.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/report/base64.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A sequence `room`, and a run `first` over it that has written home.map.
class MapCommandTest : public PreparedFolder {
 protected:
  void Prepare() override {
    RenderSequence(Path("room"), {"--scene", "room", "--frames", "60", "--width", "320"});
    const CommandOutcome outcome = Replay("room", "first", {"--map", Path("home.map")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  CommandOutcome Replay(const std::string& sequence, const std::string& output,
                        const std::vector<std::string>& more) const {
    return RunCommand(Arguments(sequence, output, more));
  }
  std::vector<std::string> Arguments(const std::string& sequence, const std::string& output,
                                     const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"replay", Path(sequence), "--quiet", "--output",
                                          Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  nlohmann::json Summary(const std::string& output) const {
    return nlohmann::json::parse(ReadFile(Path(output + "/summary.json")));
  }
  // Largest distance between the cameras of two runs over the same images, metres; estimated poses
  // of `b` only.
  double LargestDistance(const std::string& a, const std::string& b) const {
    const std::vector<TimedPose> then = ReadTrajectory(Path(a + "/trajectory.txt"));
    const std::vector<TimedPose> now = ReadTrajectory(Path(b + "/trajectory.txt"));
    EXPECT_EQ(then.size(), now.size());
    double largest = 0.0;
    for (size_t i = 0; i < then.size(); ++i) {
      if (!now[i].is_estimated) continue;
      largest = std::max(
          largest,
          (then[i].world_from_cam.translation() - now[i].world_from_cam.translation()).norm());
    }
    return largest;
  }
  // The image of a frame of `sequence`.
  cv::Mat FrameImage(const std::string& sequence, int64_t frame) const {
    const SequenceIndex index = OpenSequence(Path(sequence));
    return cv::imread(index.entries.at(frame).color_path, cv::IMREAD_GRAYSCALE);
  }
  // Whether an image of a map shows a frame of `sequence`.
  bool ShowsFrame(const std::string& jpeg, int64_t frame,
                  const std::string& sequence = "room") const {
    constexpr double kGrayLevels = 12.0;  // root mean square, of JPEG; other keyframes differ by 40
    const cv::Mat image =
        cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_UNCHANGED);
    EXPECT_EQ(image.size(), cv::Size(160, 120));
    cv::Mat small;
    cv::resize(FrameImage(sequence, frame), small, image.size(), 0.0, 0.0, cv::INTER_AREA);
    return cv::norm(image, small) / std::sqrt(image.total()) < kGrayLevels;
  }
  // Each keyframe has the image of its frame. The last session may be that of another sequence.
  void ExpectImages(const std::string& file) const {
    const MapContents contents = LoadMap(Path(file));
    const MapImages images(Path(file));
    for (const SavedSubMap& submap : contents.submaps) {
      for (const auto& [id, keyframe] : submap.map.keyframes()) {
        const bool is_last = id >= contents.sessions.back().first_keyframe;
        const std::string& name =
            contents.sessions[is_last ? contents.sessions.size() - 1 : 0].name;
        EXPECT_TRUE(ShowsFrame(images.Read(id), keyframe.frame->id, name.substr(0, name.find(','))))
            << id;
      }
    }
  }
  // The report shows a frame and a keyframe of home.map that show the same place.
  void ExpectPlace(const std::string& report) const {
    const std::string key = "\"place\":";
    const size_t begin = report.find(key);
    ASSERT_NE(begin, std::string::npos);
    const std::string text = report.substr(begin + key.size());
    const auto place = nlohmann::json::parse(text.substr(0, text.find('}') + 1));
    const Map map = std::move(LoadMap(Path("home.map")).submaps.at(0).map);
    const Keyframe* const keyframe = map.FindKeyframe(place["keyframe"]);
    ASSERT_NE(keyframe, nullptr);
    const std::string jpeg = MapImages(Path("home.map")).Read(place["keyframe"]);
    EXPECT_EQ(place["keyframe_jpeg"], EncodeBase64(jpeg.data(), jpeg.size()));
    // Both sessions are over the same images.
    EXPECT_LT(std::abs(keyframe->frame->id - place["frame"].get<int64_t>()), 15);
  }
  void ExpectMap(const std::string& file, size_t num_sessions) const {
    EXPECT_NO_THROW(CheckMap(Path(file)));
    EXPECT_EQ(SummarizeMap(Path(file)).sessions.size(), num_sessions);
  }
};

TEST_F(MapCommandTest, CreatesAMapWithoutAnEffectOnTheRun) {
  ASSERT_EQ(Replay("room", "plain", {}).exit_code, 0);
  EXPECT_EQ(ReadFile(Path("first/trajectory.txt")), ReadFile(Path("plain/trajectory.txt")));
  EXPECT_FALSE(HasEntry(Path("home.map-journal")));
  const CommandOutcome info = RunCommand({"map", "info", Path("home.map")});
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.output, AllOf(LineNames("version", "5"), LineNames("session", "room"),
                                 LineNames("submap", "0", "keyframes", "points", "lines")));
  const int64_t num_keyframes = SummarizeMap(Path("home.map")).sessions[0].num_keyframes;
  EXPECT_THAT(info.output, HasSubstr("images of " + std::to_string(num_keyframes) + " of " +
                                     std::to_string(num_keyframes) + " keyframes"));
  EXPECT_EQ(RunCommand({"map", "check", Path("home.map")}).exit_code, 0);
}

TEST_F(MapCommandTest, ExportsFilesOfOtherPrograms) {
  const CommandOutcome outcome =
      RunCommand({"map", "export", Path("home.map"), "--output", Path("export")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const MapContents contents = LoadMap(Path("home.map"));
  const Map& map = contents.submaps[0].map;
  const std::string folder = "export/submap_0/";
  EXPECT_THAT(ReadFile(Path(folder + "points.ply")),
              LineNames("element vertex", std::to_string(map.points().size())));
  EXPECT_THAT(ReadFile(Path(folder + "lines.ply")),
              LineNames("element edge", std::to_string(map.lines().size())));
  ASSERT_EQ(ReadTrajectory(Path(folder + "keyframes_1.txt")).size(), map.keyframes().size());
  const std::string graph = ReadFile(Path(folder + "graph.g2o"));
  EXPECT_THAT(graph, AllOf(HasSubstr("VERTEX_SE3:QUAT 0 "), HasSubstr("EDGE_SE3:QUAT 0 ")));
  int num_images = 0;
  for (const auto& [id, keyframe] : map.keyframes()) {
    const std::string path =
        Path(FormatText("export/keyframe_images/%06d.jpg", static_cast<int>(id)));
    num_images += ShowsFrame(ReadFile(path), keyframe.frame->id) ? 1 : 0;
  }
  EXPECT_EQ(num_images, static_cast<int>(map.keyframes().size()));
  EXPECT_EQ(RunCommand({"map", "export", Path("home.map")}).exit_code, 2);
  EXPECT_EQ(RunCommand({"map", "info", Path("home.map"), "--output", Path("x")}).exit_code, 2);
}

TEST_F(MapCommandTest, LeavesOtherFilesAmongTheExportedImages) {
  std::filesystem::create_directories(Path("export/keyframe_images"));
  for (const std::string name : {"999999.jpg", "1.jpg", "kitchen.jpg", "000000.png"}) {
    WriteFile(Path("export/keyframe_images/" + name), "earlier");
  }
  ASSERT_EQ(RunCommand({"map", "export", Path("home.map"), "--output", Path("export")}).exit_code,
            0);
  EXPECT_TRUE(HasEntry(Path("export/keyframe_images/000000.jpg")));
  for (const std::string name : {"999999.jpg", "1.jpg", "kitchen.jpg", "000000.png"}) {
    EXPECT_EQ(ReadFile(Path("export/keyframe_images/" + name)), "earlier") << name;
  }
}

TEST_F(MapCommandTest, ExtendsTheMapBySessionsThatFindThemselvesInIt) {
  const int64_t num_first = SummarizeMap(Path("home.map")).submaps[0].num_points;
  ASSERT_EQ(Replay("room", "second", {"--map", Path("home.map")}).exit_code, 0);
  const auto segments = Summary("second")["segments"];
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0]["earlier_session"], true);
  EXPECT_EQ(segments[1]["world"], 0);
  EXPECT_LT(LargestDistance("first", "second"), 0.02);
  ExpectMap("home.map", 2);
  const MapFileSummary summary = SummarizeMap(Path("home.map"));
  ASSERT_EQ(summary.submaps.size(), 1u);
  EXPECT_GT(summary.sessions[1].num_keyframes, 0);
  EXPECT_LT(summary.submaps[0].num_points, 2 * num_first);
  ExpectImages("home.map");
}

TEST_F(MapCommandTest, LeavesImagesOutOnRequest) {
  const std::vector<std::string> option = {"--map", Path("blind.map"), "--no-map-images"};
  ASSERT_EQ(Replay("room", "blind", option).exit_code, 0);
  EXPECT_EQ(SummarizeMap(Path("blind.map")).num_images, 0);
  EXPECT_LT(std::filesystem::file_size(Path("blind.map")),
            std::filesystem::file_size(Path("home.map")));
  ASSERT_EQ(RunCommand({"map", "export", Path("blind.map"), "--output", Path("export")}).exit_code,
            0);
  EXPECT_FALSE(HasEntry(Path("export/keyframe_images")));
  ASSERT_EQ(Replay("room", "today", {"--localize", Path("blind.map")}).exit_code, 0);
  EXPECT_THAT(ReadFile(Path("today/report.html")),
              AllOf(HasSubstr("\"found\":"), Not(HasSubstr("\"place\":"))));
  // Those of earlier sessions stay.
  const int64_t num_images = SummarizeMap(Path("home.map")).num_images;
  ASSERT_EQ(Replay("room", "second", {"--map", Path("home.map"), "--no-map-images"}).exit_code, 0);
  EXPECT_LE(SummarizeMap(Path("home.map")).num_images, num_images);
  EXPECT_GT(SummarizeMap(Path("home.map")).num_images, 0);
  EXPECT_EQ(Replay("room", "third", {"--no-map-images"}).exit_code, 2);
}

// In real time, the map is saved once, at the end.
TEST_F(MapCommandTest, KeepsImagesOfARunInRealTime) {
  ASSERT_EQ(Replay("room", "live", {"--map", Path("live.map"), "--realtime"}).exit_code, 0);
  ExpectImages("live.map");
}

// Two runs of the same path that know nothing of each other, and one elsewhere.
TEST_F(MapCommandTest, MergesMapsByTheirPlaces) {
  ASSERT_EQ(Replay("room", "second", {"--map", Path("second.map")}).exit_code, 0);
  RenderSequence(Path("corridor"), {"--scene", "corridor", "--frames", "30", "--width", "320"});
  ASSERT_EQ(Replay("corridor", "elsewhere", {"--map", Path("corridor.map")}).exit_code, 0);
  const std::string first = ReadFile(Path("home.map"));
  const CommandOutcome outcome = RunCommand({"map", "merge", Path("home.map"), Path("second.map"),
                                             Path("corridor.map"), "--output", Path("all.map")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(LineNames("second.map", "is joined", "submap 0", "keyframes"),
                                    LineNames("corridor.map", "no common place")));
  EXPECT_TRUE(ReadFile(Path("home.map")) == first);
  ExpectMap("all.map", 3);
  ExpectImages("all.map");
  const MapFileSummary one = SummarizeMap(Path("home.map")), all = SummarizeMap(Path("all.map"));
  ASSERT_EQ(all.submaps.size(), 2u);
  // The map grows with what it shows, not with the visits.
  EXPECT_LT(all.submaps[0].num_points, 1.6 * one.submaps[0].num_points);
  ASSERT_EQ(Replay("room", "third", {"--localize", Path("all.map")}).exit_code, 0);
  EXPECT_LT(LargestDistance("first", "third"), 0.02);
}

TEST_F(MapCommandTest, RefusesToMergeWhatItCannot) {
  EXPECT_EQ(RunCommand({"map", "merge", Path("home.map"), "--output", Path("a.map")}).exit_code, 2);
  EXPECT_EQ(RunCommand({"map", "merge", Path("home.map"), Path("home.map")}).exit_code, 2);
  EXPECT_EQ(RunCommand({"map", "check", Path("home.map"), Path("home.map")}).exit_code, 2);
  const CommandOutcome twice =
      RunCommand({"map", "merge", Path("home.map"), Path("home.map"), "--output", Path("a.map")});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.output, Names(Path("home.map"), "twice"));
  const CommandOutcome outcome = RunCommand(
      {"map", "merge", Path("home.map"), Path("text.map"), "--output", Path("home.map")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, Names("error:", Path("home.map"), "exists"));
  WriteText("text.map", "no map\n");
  const CommandOutcome damaged =
      RunCommand({"map", "merge", Path("home.map"), Path("text.map"), "--output", Path("a.map")});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_THAT(damaged.output, Names("error:", Path("text.map")));
  EXPECT_FALSE(HasEntry(Path("a.map")));
}

TEST_F(MapCommandTest, LocalizesInAMapThatRemains) {
  const std::string bytes = ReadFile(Path("home.map"));
  const CommandOutcome outcome = Replay("room", "today", {"--localize", Path("home.map")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(ReadFile(Path("home.map")) == bytes);
  const int first = Summary("today")["segments"][1]["joined"]["frame"];
  EXPECT_GT(first, 0);
  EXPECT_LT(first, 40);
  const std::string report = ReadFile(Path("today/report.html"));
  ExpectPlace(report);
  EXPECT_THAT(report, AllOf(HasSubstr("found in the map: frame " + std::to_string(first) + ","),
                            HasSubstr("earlier session: room, "),
                            HasSubstr("\"found\":" + std::to_string(first))));
  const std::vector<TimedPose> poses = ReadTrajectory(Path("today/trajectory.txt"));
  ASSERT_EQ(poses.size(), 60u);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(poses[i].is_estimated, i >= first) << i;
  EXPECT_LT(LargestDistance("first", "today"), 0.02);
  // The map may be on a disk that cannot be written.
  std::filesystem::permissions(Path("home.map"), std::filesystem::perms::owner_read);
  EXPECT_EQ(Replay("room", "today", {"--localize", Path("home.map")}).exit_code, 0);
}

TEST_F(MapCommandTest, FailsWhereTheMapIsNeverFound) {
  RenderSequence(Path("corridor"), {"--scene", "corridor", "--frames", "40", "--width", "320"});
  const CommandOutcome lost = Replay("corridor", "lost", {"--localize", Path("home.map")});
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_THAT(lost.output, Names("error:", Path("home.map"), "never found"));
  EXPECT_THAT(ReadFile(Path("lost/report.html")),
              AllOf(HasSubstr("not in the map of earlier sessions"),
                    HasSubstr("earlier session: room, "), Not(HasSubstr("\"found\":"))));
  for (const TimedPose& pose : ReadTrajectory(Path("lost/trajectory.txt"))) {
    EXPECT_FALSE(pose.is_estimated);
  }
  // As a new session it becomes a submap, and a third one finds itself in the right one.
  EXPECT_EQ(Replay("corridor", "apart", {"--map", Path("home.map")}).exit_code, 0);
  EXPECT_EQ(SummarizeMap(Path("home.map")).submaps.size(), 2u);
  EXPECT_EQ(Replay("corridor", "again", {"--map", Path("home.map")}).exit_code, 0);
  EXPECT_EQ(SummarizeMap(Path("home.map")).submaps.size(), 2u);
  EXPECT_EQ(Summary("again")["segments"][2]["world"], 1);
  ExpectMap("home.map", 3);
}

TEST_F(MapCommandTest, RefusesFilesThatItCannotUse) {
  WriteText("text.map", "no map\n");
  for (const char* option : {"--map", "--localize"}) {
    const CommandOutcome outcome = Replay("room", "out", {option, Path("text.map")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, Names("error:", Path("text.map")));
  }
  EXPECT_EQ(ReadFile(Path("text.map")), "no map\n");
  const CommandOutcome missing = Replay("room", "out", {"--localize", Path("none.map")});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, Names(Path("none.map"), "does not exist"));
  EXPECT_EQ(Replay("room", "out", {"--map", Path("a.map"), "--localize", Path("b.map")}).exit_code,
            2);
  EXPECT_EQ(Replay("room", "out", {"--map", Path("no/folder/a.map")}).exit_code, 1);
}

TEST_F(MapCommandTest, RefusesAMapThatAnotherRunExtends) {
  CommandProcess first(
      Arguments("room", "running", {"--map", Path("new.map"), "--checkpoint-interval", "0"}));
  for (int i = 0; i < 60000 && !HasEntry(Path("running/frames.csv")); ++i) usleep(1000);
  for (const std::vector<std::string>& arguments :
       {Arguments("room", "second", {"--map", Path("new.map")}),
        Arguments("room", "third", {"--localize", Path("new.map")}),
        {"map", "info", Path("new.map")}}) {
    const CommandOutcome refused = RunCommand(arguments);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.output, Names("error:", Path("new.map"), "in use"));
  }
  EXPECT_EQ(first.Wait(), 0) << first.output();
  ExpectMap("new.map", 1);
}

// Killed at some image, and continued to the map of a run that was not.
TEST_F(MapCommandTest, KeepsTheMapOfAKilledRunAndResumes) {
  const std::vector<std::string> arguments =
      Arguments("room", "out", {"--map", Path("new.map"), "--checkpoint-interval", "0"});
  {
    CommandProcess replay(arguments);
    for (int i = 0; i < 60000; ++i) {
      usleep(1000);
      if (HasEntry(Path("out/frames.csv")) && ReadFile(Path("out/frames.csv")).size() > 6000) break;
    }
    replay.Signal(SIGKILL);
    ASSERT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  }
  std::filesystem::copy_file(Path("new.map"), Path("copy.map"));
  if (HasEntry(Path("new.map-journal"))) {
    std::filesystem::copy_file(Path("new.map-journal"), Path("copy.map-journal"));
  }
  ExpectMap("copy.map", 1);
  EXPECT_FALSE(LoadMap(Path("copy.map")).submaps.empty());
  const CommandOutcome resumed = RunCommand({"replay", "--resume", Path("out"), "--quiet"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.output;
  ExpectImages("new.map");
  ASSERT_EQ(Replay("room", "second", {"--map", Path("new.map")}).exit_code, 0);
  ExpectMap("new.map", 2);
  EXPECT_EQ(ReadFile(Path("out/trajectory.txt")), ReadFile(Path("first/trajectory.txt")));
}

TEST_F(MapCommandTest, DoesNotResumeIntoAMapOfAnotherRun) {
  {
    CommandProcess replay(
        Arguments("room", "out", {"--map", Path("new.map"), "--checkpoint-interval", "0"}));
    for (int i = 0; i < 60000 && !HasEntry(Path("out/checkpoint/state.bin")); ++i) usleep(1000);
    replay.Signal(SIGKILL);
    ASSERT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  }
  ASSERT_EQ(Replay("room", "other", {"--map", Path("new.map")}).exit_code, 0);
  const std::string bytes = ReadFile(Path("new.map"));
  const CommandOutcome resumed = RunCommand({"replay", "--resume", Path("out"), "--quiet"});
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_THAT(resumed.output, Names("error:", Path("new.map"), "another run", "--resume"));
  EXPECT_TRUE(ReadFile(Path("new.map")) == bytes);
}

TEST_F(MapCommandTest, DoesNotResumeALocalizationInAMapThatHasGrown) {
  {
    CommandProcess replay(
        Arguments("room", "out", {"--localize", Path("home.map"), "--checkpoint-interval", "0"}));
    for (int i = 0; i < 60000 && !HasEntry(Path("out/checkpoint/state.bin")); ++i) usleep(1000);
    replay.Signal(SIGKILL);
    ASSERT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  }
  ASSERT_EQ(Replay("room", "second", {"--map", Path("home.map")}).exit_code, 0);
  const CommandOutcome resumed = RunCommand({"replay", "--resume", Path("out"), "--quiet"});
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_THAT(resumed.output, Names("error:", Path("home.map"), "another run", "--resume"));
}

TEST_F(MapCommandTest, FindsItselfWithAnotherCamera) {
  RenderSequence(Path("large"), {"--scene", "room", "--frames", "60", "--width", "400"});
  const CommandOutcome outcome = Replay("large", "large_out", {"--localize", Path("home.map")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_LT(LargestDistance("first", "large_out"), 0.03);
}

}  // namespace
}  // namespace msc_vo
