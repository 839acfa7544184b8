// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Commands on recordings of telephones.

#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/phone_recordings/phone_folders.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class PhoneCommandTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    const PhoneSource source = ReadPhoneSource(MSC_VO_DATA_FOLDER "/room", 32);
    WriteStrayScanner(source, {}, Path("stray"));
  }
  Json Summary(const std::string& run) const {
    return Json::parse(ReadFile(Path(run + "/summary.json")));
  }
  static void Expect(int exit_code, const CommandOutcome& outcome) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
  }
};

TEST_F(PhoneCommandTest, ReplayComparesWithAReference) {
  Expect(0, RunCommand({"replay", Path("stray"), "--output", Path("out"), "--quiet"}));
  const Json summary = Summary("out");
  EXPECT_EQ(summary["sequence"]["format"], "stray-scanner");
  EXPECT_EQ(summary["sequence"]["reference"], "ARKit");
  EXPECT_EQ(summary["depth_sensor"], "lidar");
  EXPECT_LT(summary["error"]["ape_rmse"].get<double>(), 0.03);
  EXPECT_TRUE(fs::exists(Path("out/reference.txt")));
  EXPECT_FALSE(fs::exists(Path("out/groundtruth.txt")));
  EXPECT_THAT(ReadFile(Path("out/report.html")), testing::HasSubstr("reference (ARKit)"));
}

TEST_F(PhoneCommandTest, CheckNamesTheRecorder) {
  const CommandOutcome outcome = RunCommand({"check", Path("stray")});
  Expect(0, outcome);
  EXPECT_THAT(outcome.output, Names("recorded with: Stray Scanner", "reference (ARKit): 32 poses"));
}

TEST_F(PhoneCommandTest, MasksBelongToTheImagesOfTheVideo) {
  cv::Mat mask = cv::Mat::zeros(240, 320, CV_8UC1);  // half the size of the images
  mask.colRange(0, 120) = 1;
  fs::create_directories(Path("masks"));
  for (int i = 0; i < 31; ++i) cv::imwrite(Path("masks/") + FormatText("%06d.png", i), mask);
  const std::vector<std::string> command = {"replay",   Path("stray"), "--mask",  Path("masks"),
                                            "--output", Path("out"),   "--quiet", "--overwrite"};
  const CommandOutcome missing = RunCommand(command);
  Expect(1, missing);
  EXPECT_THAT(missing.output, Names("masks", "rgb.mp4/000031", "000031.png"));
  EXPECT_FALSE(fs::exists(Path("out")));
  cv::imwrite(Path("masks/000031.png"), mask);
  Expect(0, RunCommand(command));
  EXPECT_LT(Summary("out")["error"]["ape_rmse"].get<double>(), 0.03);
  // All masks are equal.
  Expect(0, RunCommand({"replay", Path("stray"), "--mask", Path("masks/000000.png"), "--output",
                        Path("one"), "--quiet"}));
  EXPECT_EQ(ReadFile(Path("one/trajectory.txt")), ReadFile(Path("out/trajectory.txt")));
  Expect(0, RunCommand({"replay", Path("stray"), "--output", Path("whole"), "--quiet"}));
  EXPECT_NE(ReadFile(Path("whole/trajectory.txt")), ReadFile(Path("out/trajectory.txt")));
  const CommandOutcome zero = RunCommand({"check", Path("stray"), "--mask-zero"});
  Expect(2, zero);  // needs --mask
}

TEST_F(PhoneCommandTest, RecordedFolderGivesTheSameImages) {
  Expect(0, RunCommand({"record", Path("stray"), Path("copy")}));
  const SequenceIndex copy = OpenSequence(Path("copy"));
  EXPECT_EQ(copy.entries.size(), 32u);
  EXPECT_EQ(copy.ground_truth.size(), 32u);
  EXPECT_EQ(copy.reference, "ARKit");
  Expect(0, RunCommand({"replay", Path("copy"), "--output", Path("out"), "--quiet"}));
  Expect(0, RunCommand({"replay", Path("stray"), "--output", Path("out2"), "--quiet"}));
  EXPECT_EQ(ReadFile(Path("out/trajectory.txt")), ReadFile(Path("out2/trajectory.txt")));
}

}  // namespace
}  // namespace msc_vo
