// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// No command overwrites its input.

#include <filesystem>
#include <map>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/recording/window_file.h"
#include "msc_vo/synthetic/window/synthetic_window.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OverwritingTest : public TemporaryFolder {
 protected:
  void Synthesize(const std::string& name) {
    RenderSequence(Path(name), {"--frames", "3", "--width", "160"});
  }
  void ExpectRefused(const std::vector<std::string>& arguments) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, LineNames("error:", "input"));
  }
  // The contents of every file below a folder.
  std::map<std::string, std::string> Contents(const std::string& name) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(Path(name))) {
      if (entry.is_regular_file())
        contents[entry.path().string()] = ReadFile(entry.path().string());
    }
    return contents;
  }
};

TEST_F(OverwritingTest, RefusesResultsInTheFolderOfTheSequence) {
  Synthesize("room");
  fs::create_directory_symlink(Path("room"), Path("link"));
  const auto before = Contents("room");
  for (const char* output : {"room", "room/.", "room/rgb", "link", "link/depth"}) {
    ExpectRefused({"replay", Path("room"), "--quiet", "--output", Path(output)});
    ExpectRefused({"replay", Path("room"), "--quiet", "--output", Path("out"), "--dump-windows",
                   Path(output)});
  }
  ExpectRefused({"benchmark", Path("room"), "--modes", "pl-vo", "--output", Path("link")});
  EXPECT_EQ(Contents("room"), before);
}

TEST_F(OverwritingTest, RefusesBenchmarkResultsInTheFolderOfTheSequence) {
  Synthesize("pl-vo/pl-vo");
  const auto before = Contents("pl-vo");
  const CommandOutcome outcome =
      RunCommand({"benchmark", Path("pl-vo/pl-vo"), "--modes", "pl-vo", "--output", Folder()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "input"));
  EXPECT_EQ(Contents("pl-vo"), before);
}

TEST_F(OverwritingTest, RefusesToOverwriteResultsOfAnotherSequence) {
  Synthesize("chess/seq-01");
  Synthesize("fire/seq-01");
  const auto replay = [&](const std::string& sequence, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"replay", Path(sequence), "--quiet", "--output", Path("out")});
    return RunCommand(options);
  };
  EXPECT_NE(replay("chess/seq-01").exit_code, 1);
  const auto before = Contents("out");
  // The same images in another place are another sequence unless their sizes are the same, too.
  WriteText("fire/seq-01/rgb/" +
                fs::directory_iterator(Path("fire/seq-01/rgb"))->path().filename().string(),
            "another image");
  const CommandOutcome refused = replay("fire/seq-01");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output,
              LineNames("error:", "another sequence", "chess/seq-01", "--overwrite"));
  EXPECT_EQ(Contents("out"), before);

  EXPECT_NE(replay("chess/seq-01").exit_code, 1);  // the same again
  fs::rename(Path("chess"), Path("moved"));
  EXPECT_NE(replay("moved/seq-01").exit_code, 1);
  EXPECT_NE(replay("fire/seq-01", {"--overwrite"}).exit_code, 1);
  EXPECT_THAT(ReadFile(Path("out/sequence.json")), HasSubstr("fire/seq-01"));
}

// Also those of a run that was ended, and those of a version that wrote no sequence.json.
TEST_F(OverwritingTest, RefusesToOverwriteResultsThatNameTheirSequence) {
  Synthesize("room");
  WriteText("killed/sequence.json", R"({"path": "/data/fire/seq-01"})");
  WriteText("earlier/summary.json", R"({"sequence": {"directory": "/data/fire/seq-01"}})");
  WriteText("damaged/summary.json", "{");
  for (const char* output : {"killed", "earlier"}) {
    const CommandOutcome outcome = RunCommand({"replay", Path("room"), "--output", Path(output)});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, LineNames("error:", "another sequence", "/data/fire/seq-01"));
  }
  EXPECT_NE(RunCommand({"replay", Path("room"), "--output", Path("damaged")}).exit_code, 1);
}

TEST_F(OverwritingTest, BenchmarkRefusesToOverwriteResultsOfAnotherSequence) {
  Synthesize("chess/seq-01");
  Synthesize("fire/seq-01");
  Synthesize("office");
  const auto benchmark = [&](const std::string& sequence, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"benchmark", Path(sequence), "--quiet", "--modes", "pl-vo",
                                     "--output", Path("out")});
    return RunCommand(options).output;
  };
  const std::string first = benchmark("chess/seq-01");
  const auto before = Contents("out");
  for (const char* sequence : {"fire/seq-01", "office"}) {
    EXPECT_THAT(benchmark(sequence), Names("another sequence", "--overwrite"));
  }
  EXPECT_EQ(Contents("out"), before);
  EXPECT_THAT(benchmark("chess/seq-01"), testing::Not(Names("--overwrite")));
  EXPECT_THAT(benchmark("office", {"--overwrite"}), testing::Not(Names("--overwrite")));
}

TEST_F(OverwritingTest, BenchmarkReplacesOnlyTablesOfBenchmarks) {
  Synthesize("room");
  WriteText("site/index.html", "mine\n");
  const std::vector<std::string> benchmark = {"benchmark", Path("room"), "--quiet",   "--modes",
                                              "pl-vo",     "--output",   Path("site")};
  const CommandOutcome refused = RunCommand(benchmark);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output, LineNames("error:", Path("site/index.html"), "--overwrite"));
  EXPECT_EQ(ReadFile(Path("site/index.html")), "mine\n");
  fs::remove(Path("site/index.html"));
  for (int i = 0; i < 2; ++i) {
    EXPECT_THAT(RunCommand(benchmark).output, testing::Not(HasSubstr("exists")));
  }
  EXPECT_TRUE(HasEntry(Path("site/index.html")));
  WriteText("merged/benchmark.md", "mine\n");
  EXPECT_THAT(RunCommand({"benchmark", "--merge", Path("site"), "--output", Path("merged")}).output,
              LineNames("error:", Path("merged/benchmark.md"), "--overwrite"));
  EXPECT_EQ(ReadFile(Path("merged/benchmark.md")), "mine\n");
}

TEST_F(OverwritingTest, RefusesToOverwriteTheConfiguration) {
  Synthesize("room");
  WriteText("out/summary.json", "mode: pl-vo\n");
  ExpectRefused(
      {"replay", Path("room"), "--output", Path("out"), "--config", Path("out/summary.json")});
  EXPECT_EQ(ReadFile(Path("out/summary.json")), "mode: pl-vo\n");
}

TEST_F(OverwritingTest, RefusesToOverwriteWindowsAndDevices) {
  SyntheticWindowOptions options;
  options.num_keyframes = 4;
  options.num_points = 50;
  options.num_lines = 10;
  WriteWindow(Path("window.txt"), BundleAdjustmentOptions(), MakeSyntheticWindow(options).data);
  fs::create_symlink(Path("window.txt"), Path("link.txt"));
  const std::string before = ReadFile(Path("window.txt"));
  for (const char* output : {"window.txt", "link.txt"}) {
    ExpectRefused({"solve-window", Path("window.txt"), "--output", Path(output)});
  }
  EXPECT_EQ(ReadFile(Path("window.txt")), before);
  WriteText("notes.txt", "mine\n");
  ExpectRefused({"solve-window", Path("window.txt"), "--output", Path("notes.txt")});
  EXPECT_EQ(ReadFile(Path("notes.txt")), "mine\n");
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(
        RunCommand({"solve-window", Path("window.txt"), "--output", Path("solved.txt")}).exit_code,
        0);
  }

  fs::create_symlink("/dev/full", Path("full"));  // never the real one: tests may run as root
  const CommandOutcome device =
      RunCommand({"solve-window", Path("window.txt"), "--output", Path("full")});
  EXPECT_EQ(device.exit_code, 1);
  EXPECT_THAT(device.output, LineNames("error:", Path("full"), "device"));
  EXPECT_TRUE(fs::is_symlink(Path("full")));
}

// Also files that no reader of the sequence reads.
TEST_F(OverwritingTest, FuseReplacesOnlySurfacesInTheFolderOfTheSequence) {
  Synthesize("room");
  WriteText("room/models/chair.ply", "ply\n");
  const auto before = Contents("room");
  const auto fuse = [this](const std::string& output) -> std::vector<std::string> {
    return {"fuse",     Path("room"), Path("room/groundtruth.txt"), "--voxel", "0.05",
            "--output", Path(output)};
  };
  ExpectRefused(fuse("room/edges.ply"));
  ExpectRefused(fuse("room/models/chair.ply"));
  EXPECT_EQ(Contents("room"), before);
#ifdef MSC_VO_HAS_FUSION
  for (int i = 0; i < 2; ++i) EXPECT_EQ(RunCommand(fuse("room/surface.ply")).exit_code, 0);
  WriteText("chair.ply", "ply\n");
  ExpectRefused(fuse("room/../chair.ply"));
  EXPECT_EQ(RunCommand(fuse("room/../surface.ply")).exit_code, 0);
  EXPECT_EQ(RunCommand(fuse("room/../surface.ply")).exit_code, 0);
  ExpectRefused({"export", Path("room/groundtruth.txt"), "ply", Path("room/edges.ply"),
                 "--sequence", Path("room")});
#endif
}

TEST_F(OverwritingTest, ExportReplacesOnlyFilesOfItsOwnInTheFolderOfTheSequence) {
  Synthesize("room");
  ASSERT_EQ(RunCommand({"replay", Path("room"), "--quiet", "--output", Path("out")}).exit_code, 0);
  WriteText("room/transforms.json", "{\"camera_model\": \"OPENCV\"}\n");
  WriteText("room/imu/data.csv", "#timestamp [ns]\n");
  const auto before = Contents("room");
  ExpectRefused({"export", Path("out"), "nerfstudio", Path("room/transforms.json")});
  for (const char* format : {"tum", "kitti", "euroc", "mcap"}) {
    ExpectRefused({"export", Path("out"), format, Path("room/imu/data.csv")});
    ExpectRefused({"export", Path("out"), format, Path("room/rgb/1.000000.png")});
  }
  EXPECT_EQ(Contents("room"), before);
  for (int i = 0; i < 2; ++i) {
    const CommandOutcome outcome =
        RunCommand({"export", Path("out"), "nerfstudio", Path("room/mine.json")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  for (int i = 0; i < 2; ++i) {
    const CommandOutcome outcome =
        RunCommand({"export", Path("out"), "tum", Path("room/poses.txt")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}

TEST_F(OverwritingTest, ExportReplacesOnlyExportsOfTheSameFormatAnywhere) {
  Synthesize("room");
  ASSERT_EQ(RunCommand({"replay", Path("room"), "--quiet", "--output", Path("out")}).exit_code, 0);
  // The header of EuRoC's ground truth, a row of KITTI's, a ground truth, another program's MCAP.
  WriteText("data.csv",
            "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
            "q_RS_z [],v_RS_R_x [m s^-1]\n");
  WriteText("00.txt",
            "1.000000e+00 9.043680e-12 2.326809e-11 5.551115e-17 9.043683e-12 1.000000e+00 "
            "2.392370e-10 3.330669e-16 2.326810e-11 2.392370e-10 9.999999e-01 -4.440892e-16\n");
  WriteText("bag.mcap", "\x89MCAP0\r\n");
  fs::copy_file(Path("out/trajectory.txt"), Path("groundtruth.txt"));
  const std::vector<std::string> others = {"data.csv", "00.txt", "bag.mcap", "groundtruth.txt",
                                           "out/trajectory.txt"};
  std::map<std::string, std::string> before;
  for (const std::string& name : others) before[name] = ReadFile(Path(name));
  std::vector<std::string> formats = {"tum", "kitti", "euroc", "nerfstudio"};
#ifdef MSC_VO_HAS_MCAP
  formats.emplace_back("mcap");
#endif
  for (const std::string& format : formats) {
    for (const std::string& name : others)
      ExpectRefused({"export", Path("out"), format, Path(name)});
    const std::vector<std::string> own = {"export", Path("out"), format, Path("own." + format)};
    for (int i = 0; i < 2; ++i) {
      const CommandOutcome outcome = RunCommand(own);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    }
  }
  for (const std::string& name : others) EXPECT_EQ(ReadFile(Path(name)), before[name]) << name;
  EXPECT_EQ(RunCommand({"export", Path("out"), "kitti", Path("00.txt"), "--overwrite"}).exit_code,
            0);
  fs::copy_file(Path("own.tum"), Path("room/groundtruth.txt"),
                fs::copy_options::overwrite_existing);
  const auto truth = Contents("room");
  ExpectRefused({"export", Path("out/trajectory.txt"), "tum", Path("room/groundtruth.txt")});
  for (const char* file : {"room/groundtruth.txt", "room/rgb.txt", "room/rgb/1.000000.png"}) {
    ExpectRefused({"export", Path("out"), "kitti", Path(file), "--overwrite"});
  }
  EXPECT_EQ(Contents("room"), truth);
}

TEST_F(OverwritingTest, ReplayWritesIntoNoFolderOfOtherFiles) {
  Synthesize("room");
  Synthesize("other");
  WriteText("mine/groundtruth.txt", "0 0 0 0 0 0 0 1\n");
  const auto other = Contents("other"), mine = Contents("mine");
  const auto replay = [this](const std::string& output) -> std::vector<std::string> {
    return {"replay", Path("room"), "--quiet", "--output", Path(output)};
  };
  for (const char* folder : {"other", "other/rgb"}) {
    ExpectRefused(replay(folder));
    std::vector<std::string> overwriting = replay(folder);
    overwriting.emplace_back("--overwrite");
    ExpectRefused(overwriting);
    ExpectRefused({"replay", Path("room"), "--quiet", "--output", Path("new"), "--dump-windows",
                   Path(folder)});
  }
  const CommandOutcome outcome = RunCommand(replay("mine"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", Path("mine/groundtruth.txt"), "--overwrite"));
  EXPECT_EQ(Contents("other"), other);
  EXPECT_EQ(Contents("mine"), mine);
  for (int i = 0; i < 2; ++i) EXPECT_NE(RunCommand(replay("out")).exit_code, 1);
}

TEST_F(OverwritingTest, ReplayCanBeRepeatedWithItsExports) {
  Synthesize("room");
  fs::create_directories(Path("room/out/exports"));
  const auto replay = [&](const std::string& text, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"replay",         Path("room"), "--quiet", "--output",
                                          Path("room/out"), "--export",   text};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  };
  for (const std::string& text :
       {"kitti=" + Path("room/out/exports/poses.txt"), "tum=" + Path("room/poses.txt")}) {
    for (int i = 0; i < 2; ++i) EXPECT_EQ(replay(text).exit_code, 0) << text;
  }
  // Others may have written such files, too.
  const std::string euroc = "euroc=" + Path("room/poses.csv");
  EXPECT_EQ(replay(euroc).exit_code, 0);
  const CommandOutcome again = replay(euroc);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.output, LineNames("error:", Path("room/poses.csv"), "--overwrite"));
  EXPECT_EQ(replay(euroc, {"--overwrite"}).exit_code, 0);
  fs::copy_file(Path("room/poses.txt"), Path("room/groundtruth.txt"),
                fs::copy_options::overwrite_existing);
  const std::string truth = ReadFile(Path("room/groundtruth.txt"));
  for (const char* format : {"kitti=", "tum="}) {
    EXPECT_EQ(replay(format + Path("room/groundtruth.txt"), {"--overwrite"}).exit_code, 1);
  }
  EXPECT_EQ(ReadFile(Path("room/groundtruth.txt")), truth);
}

// Also beside a sequence.json that is not of a run over the sequence.
TEST_F(OverwritingTest, ResultsOfOtherSequencesAreInputInTheFolderOfTheSequence) {
  Synthesize("room");
  fs::create_directory(Path("other"));
  for (const std::string& json : {R"({"path": ")" + Path("other") + R"("})", std::string("{}")}) {
    WriteText("room/dump/sequence.json", json);
    WriteText("room/dump/chair.ply", "ply\n");
    WriteText("room/dump/camera.yaml", "camera:\n");
    const auto before = Contents("room");
    ExpectRefused({"fuse", Path("room"), Path("room/groundtruth.txt"), "--output",
                   Path("room/dump/chair.ply")});
    ExpectRefused({"calibrate", Path("room"), "--output", Path("room/dump/camera.yaml")});
    EXPECT_EQ(Contents("room"), before) << json;
  }
}

TEST_F(OverwritingTest, ExportsOfMapsReplaceOnlyExportsOfMaps) {
  Synthesize("room");
  const std::string map = Path("x.map");
  ASSERT_EQ(RunCommand({"replay", Path("room"), "--quiet", "--output", Path("out"), "--map", map})
                .exit_code,
            0);
  WriteText("room/images.txt", "# my list\n");
  WriteText("room/imu.csv", "#timestamp [ns]\n");
  WriteText("room/sparse/points3D.bin", "a model");
  const auto before = Contents("room");
  const auto refuse = [&](const std::vector<std::string>& arguments, const std::string& file) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, LineNames("error:", Path(file), "remove"));
  };
  refuse({"export", map, "g2o", Path("room/imu.csv")}, "room/imu.csv");
  refuse({"export", map, "colmap", Path("room")}, "room/images.txt");
  refuse({"export", map, "colmap", Path("room/sparse"), "--binary", "--sequence", Path("room")},
         "room/sparse/points3D.bin");
  refuse({"replay", Path("room"), "--output", Path("new"), "--map", Path("new.map"), "--export",
          "g2o=" + Path("room/imu.csv")},
         "room/imu.csv");
  EXPECT_FALSE(HasEntry(Path("new/trajectory.txt")));
  EXPECT_EQ(Contents("room"), before);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(RunCommand({"export", map, "g2o", Path("room/graph.g2o")}).exit_code, 0);
    EXPECT_EQ(RunCommand({"export", map, "colmap", Path("room/model")}).exit_code, 0);
  }
}

TEST_F(OverwritingTest, CalibrateReplacesOnlyCamerasInTheFolderOfTheSequence) {
  Synthesize("room");
  WriteText("room/plot.html", "<title>A plot</title>");
  WriteText("room/camera.yaml", "# written by msc_vo calibrate\n");
  const auto before = Contents("room");
  ExpectRefused({"calibrate", Path("room"), "--output", Path("room/truth.json")});
  ExpectRefused({"calibrate", Path("room"), "--plot", Path("room/plot.html")});
  EXPECT_EQ(Contents("room"), before);
  const CommandOutcome again =
      RunCommand({"calibrate", Path("room"), "--quiet", "--output", Path("room/camera.yaml")});
  EXPECT_THAT(again.output, testing::Not(HasSubstr("written over")));
}

TEST_F(OverwritingTest, SynthesizeReplacesLinksInsteadOfTheirTargets) {
  Synthesize("room");
  const auto before = Contents("room");
  fs::create_directory(Path("copy"));
  for (const auto& entry : fs::directory_iterator(Path("room"))) {
    fs::create_symlink(entry.path(), fs::path(Path("copy")) / entry.path().filename());
  }
  const CommandOutcome outcome = RunCommand({"synthesize", Path("copy"), "--frames", "2", "--width",
                                             "160", "--seed", "7", "--overwrite"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(Contents("room"), before);
}

}  // namespace
}  // namespace msc_vo
