// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/command_process.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/accelerometer.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

class SynthesizeCommandTest : public TemporaryFolder {
 protected:
  // Renders one small image.
  CommandOutcome Synthesize(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", Path(name), "--frames",
                                          "1",          "--width",  "160"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
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

}  // namespace
}  // namespace msc_vo
