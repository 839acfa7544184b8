// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What commands write to map files and beside them.

#include <csignal>
#include <filesystem>
#include <map>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

// A sequence `room` and home.map, the map of a run over it.
class MapOutputTest : public PreparedFolder {
 protected:
  void Prepare() override {
    RenderSequence(Path("room"), {"--scene", "room", "--frames", "30", "--width", "160"});
    const CommandOutcome outcome = Replay({"--map", Path("home.map")}, "first");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  std::vector<std::string> Arguments(const std::vector<std::string>& more,
                                     const std::string& output = "out",
                                     const std::string& sequence = "room") const {
    std::vector<std::string> arguments = {"replay", Path(sequence), "--quiet", "--output",
                                          Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  CommandOutcome Replay(const std::vector<std::string>& more, const std::string& output = "out",
                        const std::string& sequence = "room") const {
    return RunCommand(Arguments(more, output, sequence));
  }
  // The run is refused before it writes anything.
  void ExpectRefused(const std::vector<std::string>& more, const std::string& option) const {
    const CommandOutcome outcome = Replay(more);
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(more);
    EXPECT_THAT(outcome.output, LineNames("error:", option, "give another"));
    EXPECT_FALSE(HasEntry(Path("out/frames.csv")));
    EXPECT_FALSE(HasEntry(Path("out/report.html")));
  }
  CommandOutcome Export(const std::string& file) const {
    return RunCommand({"map", "export", Path(file), "--output", Path("export")});
  }
  // The contents of the files of an export, by their names.
  std::map<std::string, std::string> ExportedFiles() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(Path("export"))) {
      const std::string path = entry.path().string();
      files[path] = entry.is_directory() ? "" : ReadFile(path);
    }
    return files;
  }
  void WriteList(const std::vector<std::string>& files) const {
    const nlohmann::json list = {{"written_by", "msc_vo map export"}, {"files", files}};
    WriteText("export/export.json", list.dump());
  }
  // Kills a run over `room` with new.map after its first checkpoint.
  void KillRun() const {
    CommandProcess replay(Arguments({"--map", Path("new.map"), "--checkpoint-interval", "0"}));
    for (int i = 0; i < 60000 && !HasEntry(Path("out/checkpoint/state.bin")); ++i) usleep(1000);
    replay.Signal(SIGKILL);
    ASSERT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  }
};

TEST_F(MapOutputTest, RefusesToWriteOverAMap) {
  const std::string map = ReadFile(Path("home.map"));
  fs::create_directory(Path("out"));
  fs::copy_file(Path("home.map"), Path("out/trajectory.txt"));
  fs::copy_file(Path("home.map"), Path("home.mp4"));
  fs::create_hard_link(Path("home.map"), Path("link.map"));
  ExpectRefused({"--map", Path("out/trajectory.txt")}, "--map");
  ExpectRefused({"--localize", Path("out/../out/trajectory.txt")}, "--localize");
  ExpectRefused({"--localize", Path("home.mp4"), "--overlay", Path("home.mp4")}, "--overlay");
  ExpectRefused({"--localize", Path("home.map"), "--log-file", Path("link.map")}, "--log-file");
  ExpectRefused({"--localize", Path("home.map"), "--export", "tum=" + Path("home.map")},
                "--export");
  for (const char* name : {"home.map", "home.mp4", "out/trajectory.txt"}) {
    EXPECT_TRUE(ReadFile(Path(name)) == map) << name;
  }
}

TEST_F(MapOutputTest, RefusesToCreateAMapThatWouldBeWrittenOver) {
  for (const char* name :
       {"out/summary.json", "out/map.ply.partial", "out/checkpoint", "out/checkpoint/a.map"}) {
    ExpectRefused({"--map", Path(name)}, "--map");
    EXPECT_FALSE(HasEntry(Path(name)));
  }
  ExpectRefused({"--map", Path("new.map"), "--export", "tum=" + Path("new.map")}, "--export");
  ExpectRefused({"--map", Path("new.map"), "--log-file=" + Path("new.map")}, "--log-file");
  ExpectRefused({"--map", Path("new.map"), "--log-file", Path("new.map-journal")}, "--log-file");
  EXPECT_FALSE(HasEntry(Path("new.map")));
  ExpectRefused({"--overlay", Path("a.mp4"), "--export", "tum=" + Path("a.mp4")}, "--export");
  EXPECT_FALSE(HasEntry(Path("a.mp4")));
}

TEST_F(MapOutputTest, RefusesToWriteTheVideoOverImages) {
  const std::string video = Path("room/rgb/a.mp4");
  ExpectRefused({"--overlay", video}, video);
}

TEST_F(MapOutputTest, MergesNoMapBesideTheJournalOfAnother) {
  WriteFile(Path("merged.map-journal"), "left from a killed run");
  fs::copy_file(Path("home.map"), Path("copy.map"));
  const CommandOutcome outcome = RunCommand(
      {"map", "merge", Path("home.map"), Path("copy.map"), "--output", Path("merged.map")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", Path("merged.map-journal"), "remove it"));
  EXPECT_FALSE(HasEntry(Path("merged.map")));
}

TEST_F(MapOutputTest, RefusesEmptyNames) {
  for (const char* option : {"--map", "--localize"}) {
    const CommandOutcome outcome = Replay({option, ""});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, Names(option, "empty"));
  }
}

TEST_F(MapOutputTest, ResumesOnlyWithTheMapOfTheRun) {
  KillRun();
  const CommandOutcome other =
      RunCommand({"replay", Path("room"), "--resume", Path("out"), "--map", Path("other.map")});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.output, LineNames("error:", "--map", Path("new.map"), Path("other.map")));
  EXPECT_FALSE(HasEntry(Path("other.map")));

  fs::rename(Path("new.map"), Path("moved.map"));
  const CommandOutcome missing = RunCommand({"replay", "--resume", Path("out"), "--quiet"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, LineNames("error:", Path("new.map"), "does not exist", "--resume"));
  EXPECT_FALSE(HasEntry(Path("new.map")));

  fs::rename(Path("moved.map"), Path("new.map"));
  EXPECT_EQ(RunCommand({"replay", "--resume", Path("out"), "--quiet"}).exit_code, 0);
  EXPECT_EQ(SummarizeMap(Path("new.map")).sessions.size(), 1u);
}

TEST_F(MapOutputTest, LeavesOutASessionWithoutKeyframes) {
  RenderSequence(Path("blank"), {"--scene", "room", "--frames", "10", "--width", "160"});
  for (const std::string& image : ListFolder(Path("blank/rgb"))) {
    cv::imwrite(image, cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(90)));
  }
  const MapFileSummary before = SummarizeMap(Path("home.map"));
  EXPECT_EQ(Replay({"--map", Path("home.map"), "--no-check"}, "out", "blank").exit_code, 3);
  EXPECT_NO_THROW(CheckMap(Path("home.map")));
  const MapFileSummary after = SummarizeMap(Path("home.map"));
  EXPECT_EQ(after.sessions.size(), 1u);
  EXPECT_EQ(after.sessions.front().num_keyframes, before.sessions.front().num_keyframes);
}

TEST_F(MapOutputTest, ReplacesTheFilesOfAnEarlierExport) {
  for (const char* name : {"submap_0/graph.g2o", "submap_0/keyframes_2.txt", "submap_0/notes.txt",
                           "submap_1/points.ply", "submap_2/points.ply", "submap_2/planes.ply",
                           "keyframe_images/900000.jpg", "keyframe_images/900001.jpg"}) {
    WriteText(std::string("export/") + name, "earlier");
  }
  WriteList({"submap_0/graph.g2o", "submap_0/keyframes_2.txt", "submap_1/points.ply",
             "submap_2/planes.ply", "submap_3/none.ply", "keyframe_images/900000.jpg"});
  const CommandOutcome outcome = Export("home.map");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* name : {"submap_0/keyframes_2.txt", "submap_1", "submap_2/planes.ply",
                           "keyframe_images/900000.jpg"}) {
    EXPECT_FALSE(HasEntry(Path("export/") + name)) << name;
  }
  // In no list, whatever their names.
  for (const char* name :
       {"submap_0/notes.txt", "submap_2/points.ply", "keyframe_images/900001.jpg"}) {
    EXPECT_EQ(ReadFile(Path("export/") + name), "earlier") << name;
  }
  EXPECT_NE(ReadFile(Path("export/submap_0/graph.g2o")), "earlier");
  EXPECT_TRUE(HasEntry(Path("export/submap_0/keyframes_1.txt")));
  const auto files = ExportedFiles();
  EXPECT_EQ(Export("home.map").exit_code, 0);
  EXPECT_EQ(ExportedFiles(), files);
}

TEST_F(MapOutputTest, KeepsAnEarlierExportThatItCannotReplace) {
  ASSERT_EQ(Export("home.map").exit_code, 0);
  WriteText("export/submap_0/points.ply", "earlier");
  const auto files = ExportedFiles();
  std::string damaged = ReadFile(Path("home.map"));
  for (size_t at = damaged.find("JFIF"); at != std::string::npos; at = damaged.find("JFIF", at)) {
    damaged[at] = 'X';
  }
  WriteText("damaged.map", damaged);
  const CommandOutcome outcome = Export("damaged.map");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "damaged.map"));
  EXPECT_EQ(ExportedFiles(), files);

  WriteText("export/submap_0/graph.g2o", "mine");
  WriteList({"submap_0/points.ply"});
  const auto own_files = ExportedFiles();
  const CommandOutcome own = Export("home.map");
  EXPECT_EQ(own.exit_code, 1);
  EXPECT_THAT(own.output, LineNames("error:", "keyframe_images", "another folder"));
  EXPECT_EQ(ExportedFiles(), own_files);
}

TEST_F(MapOutputTest, RefusesAFolderInWhichAnExportIsUnfinished) {
  WriteText("export/export.json.files/notes.txt", "mine");
  const CommandOutcome outcome = Export("home.map");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "export.json.files", "remove it"));
  EXPECT_EQ(ReadFile(Path("export/export.json.files/notes.txt")), "mine");
}

// The system releases the lock of a process that was killed.
TEST_F(MapOutputTest, ReplacesWhatAKilledProcessHasLeft) {
  const std::vector<std::string> merge = {"map",           "merge",    Path("home.map"),
                                          Path("old.map"), "--output", Path("all.map")};
  fs::copy_file(Path("home.map"), Path("old.map"));
  for (const std::string folder : {"export/export.json.files", "all.map.unfinished"}) {
    WriteText(folder + "/msc_vo.lock", "");
    WriteText(folder + "/merged.map", "half");
    WriteText(folder + "/submap_0/half.ply", "half");
    const bool is_export = folder.find("export") == 0;
    const auto run = [&] { return is_export ? Export("home.map") : RunCommand(merge); };
    const int lock = open(Path(folder + "/msc_vo.lock").c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(flock(lock, LOCK_EX), 0);
    const CommandOutcome running = run();
    EXPECT_EQ(running.exit_code, 1);
    EXPECT_THAT(running.output, LineNames("error:", Path(folder), "another process"));
    EXPECT_EQ(ReadFile(Path(folder + "/merged.map")), "half");
    close(lock);
    const CommandOutcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_FALSE(HasEntry(Path(folder)));
  }
  EXPECT_FALSE(HasEntry(Path("export/submap_0/half.ply")));
  EXPECT_EQ(SummarizeMap(Path("all.map")).sessions.size(), 2u);
}

TEST_F(MapOutputTest, LeavesNothingIfItIsInterrupted) {
  fs::copy_file(Path("home.map"), Path("old.map"));
  for (const bool merges : {true, false}) {
    const std::string output = Path(merges ? "all.map" : "export");
    const std::string unfinished = merges ? output + ".unfinished" : output + "/export.json.files";
    for (int attempt = 0;; ++attempt) {  // the command may end before the signal
      ASSERT_LT(attempt, 20);
      std::vector<std::string> arguments = {"map", merges ? "merge" : "export", Path("home.map")};
      if (merges) arguments.push_back(Path("old.map"));
      arguments.insert(arguments.end(), {"--output", output});
      CommandProcess process(arguments);
      const std::string last = merges ? output : output + "/export.json";
      for (int i = 0; i < 60000 && !HasEntry(unfinished) && !HasEntry(last); ++i) usleep(100);
      process.Signal(SIGTERM);
      if (process.Wait() == 130) {
        EXPECT_THAT(process.output(), LineNames("interrupted", output, "not written"));
        break;
      }
      fs::remove_all(output);
    }
    EXPECT_FALSE(HasEntry(output));
    EXPECT_FALSE(HasEntry(unfinished));
  }
}

TEST_F(MapOutputTest, NamesTheFolderThatItCannotWrite) {
  const CommandOutcome outcome =
      RunCommand({"map", "export", Path("home.map"), "--output", "/proc"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "/proc:", "cannot be written"));
  EXPECT_THAT(outcome.output, testing::Not(testing::HasSubstr("export.json")));
}

TEST_F(MapOutputTest, RefusesToExportIntoASequence) {
  for (const char* folder : {"room", "room/rgb", "room/depth/"}) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"map", "export", Path("home.map"), "--output", Path(folder)},
             {"export", Path("home.map"), "colmap", Path(folder)}}) {
      const CommandOutcome outcome = RunCommand(arguments);
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_THAT(outcome.output, LineNames("error:", Path(folder), "input", "another path"));
    }
  }
  EXPECT_FALSE(HasEntry(Path("room/submap_0")));
  EXPECT_EQ(RunCommand({"map", "export", Path("home.map"), "--output", Path("room/map")}).exit_code,
            0);
}

TEST_F(MapOutputTest, RefusesListsThatNoExportHasWritten) {
  WriteText("kept.txt", "mine");
  for (const char* text :
       {"{}", "[", R"({"written_by": "msc_vo map export", "files": ["../kept.txt"]})",
        R"({"written_by": "msc_vo map export", "files": ["a/../../kept.txt"]})",
        R"({"written_by": "another program", "files": ["submap_0/points.ply"]})"}) {
    WriteText("export/export.json", text);
    const CommandOutcome outcome = Export("home.map");
    EXPECT_EQ(outcome.exit_code, 1) << text;
    EXPECT_THAT(outcome.output, LineNames("error:", "export.json", "another folder"));
  }
  EXPECT_EQ(ReadFile(Path("kept.txt")), "mine");
}

TEST_F(MapOutputTest, RefusesToExportOverTheMap) {
  fs::create_directories(Path("export/submap_0"));
  fs::copy_file(Path("home.map"), Path("export/submap_0/points.ply"));
  const CommandOutcome outcome = Export("export/submap_0/points.ply");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "points.ply", "another folder"));
  EXPECT_TRUE(ReadFile(Path("export/submap_0/points.ply")) == ReadFile(Path("home.map")));
  WriteList({"submap_0/points.ply"});
  const CommandOutcome listed = Export("export/submap_0/points.ply");
  EXPECT_EQ(listed.exit_code, 1);
  EXPECT_THAT(listed.output, LineNames("error:", "points.ply", "another folder"));
  EXPECT_TRUE(ReadFile(Path("export/submap_0/points.ply")) == ReadFile(Path("home.map")));

  fs::create_directories(Path("model"));
  fs::copy_file(Path("home.map"), Path("model/points3D.txt"));
  const CommandOutcome model =
      RunCommand({"export", Path("model/points3D.txt"), "colmap", Path("model")});
  EXPECT_EQ(model.exit_code, 1);
  EXPECT_THAT(model.output, LineNames("error:", "points3D.txt", "input"));
  EXPECT_TRUE(ReadFile(Path("model/points3D.txt")) == ReadFile(Path("home.map")));
}

TEST_F(MapOutputTest, RefusesAMapWithoutKeyframes) {
  MapContents contents;
  contents.sessions.push_back({0, "nowhere"});
  SaveMap(Path("none.map"), std::move(contents));
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"map", "export", Path("none.map"), "--output", Path("export")},
           {"map", "merge", Path("none.map"), Path("home.map"), "--output", Path("all.map")},
           {"map", "merge", Path("home.map"), Path("none.map"), "--output", Path("all.map")},
           {"export", Path("none.map"), "g2o", Path("all.g2o")}}) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, LineNames("error:", Path("none.map"), "has no keyframes"));
  }
  for (const char* name : {"export", "all.map", "all.g2o"}) EXPECT_FALSE(HasEntry(Path(name)));
}

}  // namespace
}  // namespace msc_vo
