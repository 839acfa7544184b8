// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <string>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CheckCommandTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"), {"--frames", "6", "--width", "160"});
  }
  // Swaps the bytes of all depth images.
  void SwapBytes() {
    for (const auto& entry : std::filesystem::directory_iterator(Path("room/depth"))) {
      cv::Mat depth = cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED);
      for (auto p = depth.begin<uint16_t>(); p != depth.end<uint16_t>(); ++p) {
        *p = static_cast<uint16_t>(*p << 8 | *p >> 8);
      }
      ASSERT_TRUE(cv::imwrite(entry.path().string(), depth));
    }
  }
};

TEST_F(CheckCommandTest, PrintsFindingsAsJson) {
  SwapBytes();
  const CommandOutcome outcome = RunCommand({"check", Path("room"), "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(json["format"], "tum");
  EXPECT_EQ(json["errors"], 1);
  int num_errors = 0;
  for (const auto& finding : json["findings"]) {
    if (finding["severity"] != "error") continue;
    ++num_errors;
    EXPECT_EQ(finding["check"], "depth.byte_order");
    EXPECT_THAT(finding["text"].get<std::string>(), HasSubstr("swapped"));
    EXPECT_THAT(finding["fix"].get<std::string>(), Names("byte", "PNG"));
    EXPECT_GT(finding["value"].get<double>(), 0.75);
    EXPECT_EQ(finding["unit"], "ratio");
  }
  EXPECT_EQ(num_errors, 1);
}

TEST_F(CheckCommandTest, TestsTheCalibrationOnRequest) {
  const CommandOutcome plain = RunCommand({"check", Path("room")});
  EXPECT_THAT(plain.output, AllOf(Names("--deep", "0 errors"), Not(Names("focal length"))));
  RenderSequence(Path("more"), {"--frames", "30", "--width", "160"});
  const CommandOutcome deep = RunCommand({"check", Path("more"), "--deep"});
  EXPECT_THAT(deep.output, Not(Names("--deep")));
  EXPECT_THAT(LineNaming("focal length", deep.output), testing::StartsWith("ok "));
}

TEST_F(CheckCommandTest, ReplayStopsBeforeAnImpossibleRun) {
  SwapBytes();
  const CommandOutcome stopped =
      RunCommand({"replay", Path("room"), "--output", Path("out"), "--quiet"});
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_THAT(stopped.output, LineNames("error:", "bytes", "swapped"));
  EXPECT_FALSE(std::filesystem::exists(Path("out")));
  const CommandOutcome forced =
      RunCommand({"replay", Path("room"), "--output", Path("out"), "--quiet", "--no-check"});
  EXPECT_THAT(forced.output, Not(HasSubstr("bytes")));
  EXPECT_TRUE(std::filesystem::exists(Path("out")));
}

TEST_F(CheckCommandTest, ReplayWarnsOfImagesThatShowNothing) {
  for (const auto& entry : std::filesystem::directory_iterator(Path("room/rgb"))) {
    ASSERT_TRUE(cv::imwrite(entry.path().string(), cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(0))));
  }
  const CommandOutcome outcome =
      RunCommand({"replay", Path("room"), "--output", Path("out"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, LineNames("warning:", "100 %", "black"));
}

}  // namespace
}  // namespace msc_vo
