// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Sequences recorded through a rational and a fisheye lens.

#include <cmath>

#include "tests/apps/rendered_camera_test.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;
using testing::Not;

// The coefficients of an Azure Kinect, at a focal length whose corners are as far from the axis as
// those of its images.
constexpr char kRational[] =
    "--lens=rational:0.403863,-2.602884,0.000894,-0.000042,1.511878,0.284275,-2.420721,1.435424";
constexpr char kFisheye[] = "--lens=fisheye:0.02,-0.012,0.006,-0.0015";

class LensTest : public RenderedCameraTest {};

TEST_F(LensTest, IsAsAccurateAsAPinholeCamera) {
  const double pinhole = ErrorOf("pinhole", {"--focal-length=120"});
  EXPECT_LT(ErrorOf("rational", {"--focal-length=120", kRational}), 1.5 * pinhole);
  EXPECT_THAT(ReadFile(Path("rational/camera.txt")), HasSubstr("\nlens rational 0.40386"));
  EXPECT_EQ(Summary("rational")["camera"]["lens"], "rational");

  const double fisheye = ErrorOf("fisheye", {"--focal-length=110", kFisheye});
  EXPECT_LT(fisheye, 1.5 * pinhole);
  const nlohmann::json camera = Summary("fisheye")["camera"];
  EXPECT_EQ(camera["recorded"]["fx"], 110.0);
  EXPECT_NEAR(camera["fx"], 119.5 / std::tan(50.0 * M_PI / 180.0), 1e-9);
  EXPECT_GT(ErrorOf("untold", {"--focal-length=110", kFisheye, "--untold"},
                    {"--set", "mapping.self_calibration=false"}),
            2.0 * fisheye);
  EXPECT_THAT(ReadFile(Path("untold/camera.txt")), Not(HasSubstr("lens")));
}

TEST_F(LensTest, RejectsImpossibleLenses) {
  const auto synthesize = [this](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", Path("out"), "--frames", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  };
  CommandOutcome outcome = synthesize({"--lens=wide:0,0,0,0"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, Names("--lens", "'wide'", "radial-tangential", "rational"));
  outcome = synthesize({"--lens=fisheye:0,0,0"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, Names("--lens", "k1 k2 k3 k4"));
  EXPECT_EQ(synthesize({"--lens=fisheye:0,0,a,0"}).exit_code, 2);
  outcome = synthesize({"--lens=fisheye:-3,0,0,0"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, LineNames("error:", "fold"));
}

}  // namespace
}  // namespace msc_vo
