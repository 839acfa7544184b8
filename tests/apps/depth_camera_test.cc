// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Sequences with a depth camera beside the colour camera.

#include "tests/apps/rendered_camera_test.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;
using testing::Not;

class DepthCameraTest : public RenderedCameraTest {};

TEST_F(DepthCameraTest, IsAsAccurateAsRegisteredDepth) {
  const std::string rig = "--rig=218,0.05,-0.01,3";
  const double registered = ErrorOf("registered", {});
  const double told = ErrorOf("told", {rig});
  EXPECT_LT(told, 1.5 * registered);
  EXPECT_GT(ErrorOf("untold", {rig, "--untold"}), 2.0 * told);

  EXPECT_THAT(ReadFile(Path("told/camera.txt")), HasSubstr("depth_camera 218 218 "));
  EXPECT_THAT(ReadFile(Path("untold/camera.txt")), Not(HasSubstr("depth_camera")));
  EXPECT_EQ(Summary("told")["camera"]["depth_camera"]["translation"][0], 0.05);
  EXPECT_FALSE(Summary("untold")["camera"].contains("depth_camera"));
  const CommandOutcome check = RunCommand({"check", Path("told")});
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_THAT(check.output, Names("depth camera", "fx", "218.000"));
  EXPECT_THAT(check.output, Names("0.0500", "-0.0100", "3.00"));
}

TEST_F(DepthCameraTest, RejectsImpossibleRigs) {
  const auto synthesize = [this](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", Path("rig"), "--frames", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  };
  EXPECT_EQ(synthesize({"--rig=218,0.05"}).exit_code, 2);
  EXPECT_EQ(synthesize({"--untold"}).exit_code, 2);
  const CommandOutcome far = synthesize({"--rig=585,25,0,0"});
  EXPECT_EQ(far.exit_code, 2);
  EXPECT_THAT(far.output, LineNames("error:", "--rig must be at most 1 m, not 25 m"));
}

}  // namespace
}  // namespace msc_vo
