// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Compares EvaluateTrajectory with reference_errors.py, which computes the definitions of the
// program evo with numpy.

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <string>

#include "tests/evaluation/curved_path.h"
#include "tests/evaluation/python_process.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

constexpr double kNumpyTolerance = 1e-7;

void ExpectEqual(const ErrorStatistics& ours, const nlohmann::json& theirs, double factor = 1.0) {
  EXPECT_NEAR(factor * ours.rmse, theirs["rmse"], kNumpyTolerance);
  EXPECT_NEAR(factor * ours.mean, theirs["mean"], kNumpyTolerance);
  EXPECT_NEAR(factor * ours.median, theirs["median"], kNumpyTolerance);
  EXPECT_NEAR(factor * ours.std, theirs["std"], kNumpyTolerance);
  EXPECT_NEAR(factor * ours.min, theirs["min"], kNumpyTolerance);
  EXPECT_NEAR(factor * ours.max, theirs["max"], kNumpyTolerance);
  EXPECT_NEAR(factor * factor * ours.sse, theirs["sse"], kNumpyTolerance * ours.count);
}

struct Case {
  Alignment alignment;
  RelativeDelta delta;
};

std::string ToText(const Case& test) {
  constexpr const char* kUnits[] = {"frames", "metres", "seconds"};
  return std::string(ToString(test.alignment)) + " " + std::to_string(test.delta.value) + " " +
         kUnits[static_cast<int>(test.delta.unit)] +
         (test.delta.all_pairs ? " all" : " consecutive");
}

class FieldDefinitionsTest : public testing::TestWithParam<Case> {};

TEST_P(FieldDefinitionsTest, AgreeWithNumpy) {
  const std::string python = PythonWithNumpy();
  if (python.empty()) GTEST_SKIP() << "python3 with numpy is not installed";
  const fs::path folder =
      fs::path(testing::TempDir()) / ("field_definitions_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::vector<TimedPose> truth = CurvedPath(200, 20.0);
  // Another world and another scale, so that the alignments differ.
  const std::vector<TimedPose> estimate =
      Transformed(Rigid3(ExpSO3({0.2, -0.3, 0.1}), {0.4, -0.2, 0.1}),
                  Disturbed(truth, 0.02, 0.01, 0.0, 7), 1.3);
  WriteExactly(folder / "truth.txt", truth);
  WriteExactly(folder / "estimate.txt", estimate);
  const std::string output =
      OutputOf(python + " '" MSC_VO_REFERENCE_ERRORS "' '" + (folder / "truth.txt").string() +
               "' '" + (folder / "estimate.txt").string() + "' " + ToText(GetParam()));
  fs::remove_all(folder);
  ASSERT_FALSE(output.empty());
  const nlohmann::json numpy = nlohmann::json::parse(output);

  EvaluationOptions options;
  options.alignment = GetParam().alignment;
  options.rpe_delta = GetParam().delta;
  const TrajectoryError error = EvaluateTrajectory(truth, estimate, options);
  ASSERT_TRUE(error.usable);
  EXPECT_NEAR(error.scale, numpy["scale"], kNumpyTolerance);
  EXPECT_EQ(error.rpe.translation.count, numpy["pairs"]);
  EXPECT_GT(error.rpe.translation.count, 5);
  ExpectEqual(error.ape, numpy["ape"]);
  ExpectEqual(error.rpe.translation, numpy["rpe"]);
  ExpectEqual(error.rpe.rotation, numpy["rpe_deg"], RadiansToDegrees(1.0));
}

INSTANTIATE_TEST_SUITE_P(All, FieldDefinitionsTest,
                         testing::Values(Case{Alignment::kSe3, {1.0, DeltaUnit::kFrames, false}},
                                         Case{Alignment::kSe3, {7.0, DeltaUnit::kFrames, false}},
                                         Case{Alignment::kSe3, {7.0, DeltaUnit::kFrames, true}},
                                         Case{Alignment::kSe3, {0.5, DeltaUnit::kMetres, false}},
                                         Case{Alignment::kSe3, {0.5, DeltaUnit::kMetres, true}},
                                         Case{Alignment::kSe3, {0.75, DeltaUnit::kSeconds, false}},
                                         Case{Alignment::kSe3, {0.75, DeltaUnit::kSeconds, true}},
                                         Case{Alignment::kSim3, {1.0, DeltaUnit::kFrames, false}},
                                         Case{Alignment::kSim3, {0.5, DeltaUnit::kMetres, true}},
                                         Case{Alignment::kOrigin, {1.0, DeltaUnit::kFrames, true}},
                                         Case{Alignment::kNone, {0.5, DeltaUnit::kMetres, false}}),
                         [](const auto& parameter) {
                           std::string name = ToText(parameter.param);
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace msc_vo
