// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// data/room, the sample sequence of the repository.

#include "tests/apps/command_process.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

const std::string kRoom = std::string(MSC_VO_DATA_FOLDER) + "/room";

class SampleSequenceTest : public TemporaryFolder {};

TEST_F(SampleSequenceTest, PassesTheCheck) {
  const CommandOutcome outcome = RunCommand({"check", kRoom});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("0 errors, 0 warnings"));
}

TEST_F(SampleSequenceTest, IsTrackedInAllFrames) {
  const CommandOutcome outcome = RunCommand({"replay", kRoom, "--output", Path("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("out/summary.json")));
  EXPECT_EQ(summary["frames"]["count"], 32);
  EXPECT_EQ(summary["frames"]["tracked"], 32);
  EXPECT_LT(summary["error"]["ape_rmse"].get<double>(), 0.002);
}

}  // namespace
}  // namespace msc_vo
