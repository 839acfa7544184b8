// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// msc_vo export.

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

class ExportCommandTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
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

// The transform between two worlds is unknown.
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
