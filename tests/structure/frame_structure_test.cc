// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/frame_structure.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "tests/support/message_matchers.h"
#include "tests/support/structure_frame.h"
#include <gmock/gmock.h>

#include "msc_vo/structure/internal/partner_selection.h"

namespace msc_vo {
namespace {

bool IsSameDepth(const LineDepth& a, const LineDepth& b) {
  return a.start == b.start && a.end == b.end && a.covariance == b.covariance;
}

// Errors over many frames, of the lines along axes or of the free lines.
struct Errors {
  double direction_before = 0.0, direction_after = 0.0;    // degrees, root mean square
  double normalized_before = 0.0, normalized_after = 0.0;  // mean square in sigmas; 2 expected
};
Errors Simulate(const FrameStructureOptions& options, StructureFrameOptions scene, bool free_lines,
                int num_frames) {
  Errors errors;
  int count = 0;
  for (int k = 0; k < num_frames; ++k) {
    scene.seed = 1 + k;
    const StructureFrame frame = MakeStructureFrame(scene);
    std::vector<StructureLine> lines = frame.lines;
    RefineFrameStructure(options, frame.camera, &lines);
    for (size_t i = 0; i < lines.size(); ++i) {
      if (frame.free[i] != free_lines) continue;
      ++count;
      errors.direction_before += frame.SquaredDirectionError(i, frame.lines[i]);
      errors.direction_after += frame.SquaredDirectionError(i, lines[i]);
      errors.normalized_before += frame.SquaredNormalizedError(i, frame.lines[i]);
      errors.normalized_after += frame.SquaredNormalizedError(i, lines[i]);
    }
  }
  errors.direction_before = RadiansToDegrees(std::sqrt(errors.direction_before / count));
  errors.direction_after = RadiansToDegrees(std::sqrt(errors.direction_after / count));
  errors.normalized_before /= count;
  errors.normalized_after /= count;
  return errors;
}

// The parameter is fy.
class FrameStructureTest : public ::testing::TestWithParam<double> {
 protected:
  // A wide gate of 5 degrees, because the directions of these lines are hardly more certain than
  // the default gate.
  FrameStructureTest() {
    scene_.fy = GetParam();
    options_.max_angle = 5.0;
  }
  FrameStructureSummary Refine(const StructureFrame& frame, std::vector<StructureLine>* lines) {
    *lines = frame.lines;
    return RefineFrameStructure(options_, frame.camera, lines);
  }
  StructureFrameOptions scene_;
  FrameStructureOptions options_;
};
INSTANTIATE_TEST_SUITE_P(FocalLength, FrameStructureTest, ::testing::Values(525.0, -480.0));

TEST_P(FrameStructureTest, HalvesDirectionErrorsConsistently) {
  const Errors room = Simulate(options_, scene_, false, 20);
  RecordProperty("before", std::to_string(room.direction_before));
  RecordProperty("after", std::to_string(room.direction_after));
  EXPECT_GT(room.direction_before, 0.8);
  EXPECT_LT(room.direction_after, 0.5 * room.direction_before);
  EXPECT_NEAR(room.normalized_before, 2.0, 0.3);
  EXPECT_LT(room.normalized_after, 2.3);
}

TEST_P(FrameStructureTest, DefaultGateImprovesAccurateFitsMore) {
  options_ = FrameStructureOptions();
  const auto gain = [this](double inverse_depth_sigma) {
    scene_.inverse_depth_sigma = inverse_depth_sigma;
    const Errors room = Simulate(options_, scene_, false, 20);
    return room.direction_after / room.direction_before;
  };
  const double noisy = gain(scene_.inverse_depth_sigma);
  EXPECT_LT(noisy, 1.0);
  EXPECT_LT(gain(0.5 * scene_.inverse_depth_sigma), noisy);
}

TEST_P(FrameStructureTest, ImprovesNoisyDepthInTheMedian) {
  // Very uncertain lines fail the gates, so that the mean is not improved as much as the median.
  scene_.inverse_depth_sigma = 4e-3;
  const StructureFrame frame = MakeStructureFrame(scene_);
  std::vector<StructureLine> lines;
  ASSERT_TRUE(Refine(frame, &lines).usable);
  std::vector<double> before, after;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (frame.free[i]) continue;
    before.push_back(frame.SquaredDirectionError(i, frame.lines[i]));
    after.push_back(frame.SquaredDirectionError(i, lines[i]));
  }
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_LT(std::sqrt(after[after.size() / 2]), 0.5 * std::sqrt(before[before.size() / 2]));
}

TEST_P(FrameStructureTest, HardlyChangesASceneWithoutStructure) {
  scene_.free_ratio = 1.0;
  const Errors errors = Simulate(options_, scene_, true, 20);
  EXPECT_LT(errors.direction_after, 1.15 * errors.direction_before);
  EXPECT_LT(errors.normalized_after, 1.5 * errors.normalized_before);
}

TEST_P(FrameStructureTest, HardlyBiasesFreeLinesAmongStructure) {
  scene_.num_lines = 100;
  const Errors errors = Simulate(options_, scene_, true, 20);
  EXPECT_LT(errors.direction_after, 1.4 * errors.direction_before);
}

TEST_P(FrameStructureTest, CorrectsAnUncertainLineByAnAccuratePartner) {
  // Line 0 is accurate to a tenth of a degree; line 1 is uncertain, with an error of 3 degrees.
  StructureFrame frame = MakeStructureFrame(scene_);
  const LineSegment3 a{{-0.5, 0.2, 2.0}, {0.3, 0.2, 2.5}};
  const LineSegment3 truth{{-0.4, -0.3, 2.4}, {0.4, -0.3, 2.9}};
  std::vector<StructureLine> lines(2);
  for (int i = 0; i < 2; ++i) {
    const LineSegment3& line = i == 0 ? a : truth;
    lines[i].segment = {frame.camera.Project(line.start), frame.camera.Project(line.end)};
    lines[i].sigma = 0.2;
    lines[i].depth.start = 1.0 / line.start.z();
    lines[i].depth.end = (i == 0 ? 1.0 : 0.98) / line.end.z();
    lines[i].depth.covariance = (i == 0 ? 1e-7 : 5e-5) * Eigen::Matrix2d::Identity();
  }
  const std::vector<StructureLine> before = lines;
  const FrameStructureSummary summary = RefineFrameStructure(options_, frame.camera, &lines);
  ASSERT_TRUE(summary.usable);
  EXPECT_EQ(summary.num_parallel, 1);
  EXPECT_EQ(summary.num_perpendicular, 0);
  const auto error = [&](const StructureLine& line, const LineSegment3& to) {
    return RadiansToDegrees(UndirectedAngle(
        BackProject(frame.camera, line.segment, line.depth).Direction(), to.Direction()));
  };
  EXPECT_LT(error(lines[0], a), 0.02);
  EXPECT_GT(error(before[1], truth), 2.0);
  EXPECT_LT(error(lines[1], truth), 0.4);
  // The slope of line 1 has become certain; the sum of its depths has not.
  EXPECT_LT(lines[1].depth.covariance.determinant(),
            0.2 * before[1].depth.covariance.determinant());
}

// Two lines at an angle of four degrees, with the given variance of their inverse depths.
std::vector<StructureLine> FourDegreesOff(const PinholeCamera& camera, double variance) {
  std::vector<StructureLine> lines(2);
  const Eigen::Vector3d d = Eigen::Vector3d(0.8, 0.0, 0.5).normalized();
  const LineSegment3 a{{-0.5, 0.2, 2.0}, Eigen::Vector3d(-0.5, 0.2, 2.0) + d};
  const Eigen::Vector3d turned = ExpSO3(Eigen::Vector3d(0.0, DegreesToRadians(4.0), 0.0)) * d;
  const LineSegment3 b{{-0.4, -0.3, 2.4}, Eigen::Vector3d(-0.4, -0.3, 2.4) + turned};
  for (int i = 0; i < 2; ++i) {
    const LineSegment3& line = i == 0 ? a : b;
    lines[i].segment = {camera.Project(line.start), camera.Project(line.end)};
    lines[i].sigma = 0.2;
    lines[i].depth.start = 1.0 / line.start.z();
    lines[i].depth.end = 1.0 / line.end.z();
    lines[i].depth.covariance = variance * Eigen::Matrix2d::Identity();
  }
  return lines;
}

TEST_P(FrameStructureTest, DoesNotPairAccurateLinesFourDegreesApart) {
  const PinholeCamera camera;
  std::vector<StructureLine> lines = FourDegreesOff(camera, 1e-7);
  const std::vector<StructureLine> before = lines;
  EXPECT_FALSE(RefineFrameStructure(options_, camera, &lines).usable);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(IsSameDepth(lines[i].depth, before[i].depth));
  options_.pair_sigma = 1.5;  // their difference is then within three sigmas
  EXPECT_EQ(RefineFrameStructure(options_, camera, &lines).num_parallel, 1);
}

// The gate in sigmas would accept directions with a sigma of one degree.
TEST_P(FrameStructureTest, DoesNotPairLinesFourDegreesApartByDefault) {
  const PinholeCamera camera;
  const std::vector<StructureLine> lines = FourDegreesOff(camera, 1e-5);
  std::vector<StructureLine> refined = lines;
  EXPECT_EQ(RefineFrameStructure(options_, camera, &refined).num_parallel, 1);
  refined = lines;
  EXPECT_EQ(RefineFrameStructure(FrameStructureOptions(), camera, &refined).num_parallel, 0);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(IsSameDepth(refined[i].depth, lines[i].depth));
}

TEST_P(FrameStructureTest, ChangesDepthsOfPairedLinesOnly) {
  const StructureFrame frame = MakeStructureFrame(scene_);
  std::vector<StructureLine> lines;
  const FrameStructureSummary summary = Refine(frame, &lines);
  ASSERT_TRUE(summary.usable);
  int changed = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].segment.start, frame.lines[i].segment.start);
    EXPECT_EQ(lines[i].segment.end, frame.lines[i].segment.end);
    EXPECT_GT(lines[i].depth.start, 0.0);
    EXPECT_GT(lines[i].depth.covariance.determinant(), 0.0);
    changed += !IsSameDepth(lines[i].depth, frame.lines[i].depth);
  }
  EXPECT_LT(changed, 60);
  EXPECT_GT(changed, 40);
}

TEST_P(FrameStructureTest, LimitsPartnersIndependentOfOrder) {
  const StructureFrame frame = MakeStructureFrame(scene_);
  std::vector<StructureLine> lines, reversed(frame.lines.rbegin(), frame.lines.rend());
  const FrameStructureSummary summary = Refine(frame, &lines);
  // Without the limit, 16 lines along each axis have 360 parallel and 770 perpendicular pairs.
  const int num_lines = static_cast<int>(lines.size());
  EXPECT_LE(summary.num_parallel, kMaxPartners * num_lines);
  EXPECT_LE(summary.num_perpendicular, kMaxPartners * num_lines);
  const FrameStructureSummary other = RefineFrameStructure(options_, frame.camera, &reversed);
  EXPECT_EQ(other.num_parallel, summary.num_parallel);
  for (size_t i = 0; i < lines.size(); ++i) {
    const LineDepth& other_depth = reversed[lines.size() - 1 - i].depth;
    EXPECT_NEAR(other_depth.start, lines[i].depth.start, 1e-4);
    EXPECT_NEAR(other_depth.end, lines[i].depth.end, 1e-4);
  }
}

TEST_P(FrameStructureTest, IsIndependentOfTheOrderOfEndPoints) {
  const StructureFrame frame = MakeStructureFrame(scene_);
  std::vector<StructureLine> lines, swapped = frame.lines;
  for (size_t i = 0; i < swapped.size(); i += 2) {
    std::swap(swapped[i].segment.start, swapped[i].segment.end);
    std::swap(swapped[i].depth.start, swapped[i].depth.end);
    swapped[i].depth.covariance.reverseInPlace();
  }
  ASSERT_TRUE(Refine(frame, &lines).usable);
  ASSERT_TRUE(RefineFrameStructure(options_, frame.camera, &swapped).usable);
  for (size_t i = 0; i < lines.size(); ++i) {
    const LineDepth& other_depth = swapped[i].depth;
    EXPECT_NEAR(i % 2 == 0 ? other_depth.end : other_depth.start, lines[i].depth.start, 1e-4);
  }
}

TEST_P(FrameStructureTest, IsDeterministic) {
  const StructureFrame frame = MakeStructureFrame(scene_);
  std::vector<StructureLine> a, b;
  ASSERT_TRUE(Refine(frame, &a).usable);
  ASSERT_TRUE(Refine(frame, &b).usable);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(IsSameDepth(a[i].depth, b[i].depth));
}

TEST_P(FrameStructureTest, AcceptsNoneOrOneLine) {
  std::vector<StructureLine> none;
  EXPECT_FALSE(RefineFrameStructure(options_, PinholeCamera(), &none).usable);
  std::vector<StructureLine> one(1, MakeStructureFrame(scene_).lines[0]);
  const StructureLine before = one[0];
  EXPECT_FALSE(RefineFrameStructure(options_, PinholeCamera(), &one).usable);
  EXPECT_TRUE(IsSameDepth(one[0].depth, before.depth));
}

TEST_P(FrameStructureTest, NamesTheInvalidLine) {
  const StructureFrame frame = MakeStructureFrame(scene_);
  const auto message = [&](const auto& spoil) -> std::string {
    std::vector<StructureLine> lines = frame.lines;
    spoil(&lines[7]);
    try {
      RefineFrameStructure(options_, frame.camera, &lines);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(message([](StructureLine* l) { l->depth.start = -0.1; }),
              Names("line 7", "inverse depth"));
  EXPECT_THAT(message([](StructureLine* l) { l->sigma = 0.0; }), Names("line 7", "sigma"));
  EXPECT_THAT(message([](StructureLine* l) { l->segment.end = l->segment.start; }),
              Names("line 7", "segment"));
  EXPECT_THAT(message([](StructureLine* l) { l->depth.covariance.setZero(); }),
              Names("line 7", "covariance"));
  EXPECT_THAT(
      message([](StructureLine* l) { l->depth.end = std::numeric_limits<double>::quiet_NaN(); }),
      Names("line 7", "depth", "finite"));
}

TEST_P(FrameStructureTest, ChecksItsOptions) {
  std::string error;
  EXPECT_TRUE(options_.IsValid(&error));
  const auto is_valid = [&](auto FrameStructureOptions::*member, auto value) {
    FrameStructureOptions options;
    options.*member = value;
    return options.IsValid(&error);
  };
  EXPECT_FALSE(is_valid(&FrameStructureOptions::max_angle, 45.0));
  EXPECT_THAT(error, Names("max_angle"));
  EXPECT_FALSE(is_valid(&FrameStructureOptions::pair_sigma, 0.0));
  EXPECT_THAT(error, Names("pair_sigma"));
  options_.pair_sigma = -1.0;
  std::vector<StructureLine> none;
  EXPECT_THROW(RefineFrameStructure(options_, PinholeCamera(), &none), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
