// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/keyframe_structure.h"

#include <cmath>

#include "tests/support/synthetic_frames.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Root mean square of the sines of the angles between lines and the nearest axis of the box.
double DirectionError(const std::vector<LineSegment3>& lines, const Rigid3& world_from_lines) {
  double squares = 0.0;
  for (const LineSegment3& line : lines) {
    const double cosine = (world_from_lines * line).Direction().cwiseAbs().maxCoeff();
    squares += 1.0 - cosine * cosine;
  }
  return std::sqrt(squares / static_cast<double>(lines.size()));
}

// Gates for lines of single frames without self-calibrated sigmas.
FrameStructureOptions WideGates() {
  FrameStructureOptions options;
  options.max_angle = 5.0;
  return options;
}

std::vector<LineSegment3> LinesInCamera(const Frame& frame) {
  std::vector<LineSegment3> lines;
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    if (frame.lines[i].depth) lines.push_back(frame.LineInCamera(static_cast<int>(i)));
  }
  return lines;
}

TEST(KeyframeStructure, AlignsDirections) {
  const Rigid3 world_from_cam = SyntheticFrames::CamFromWorld(0).Inverse();
  double before = 0.0, after = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SyntheticFrames::Options options;
    options.seed = seed;
    const std::shared_ptr<const Frame> frame = SyntheticFrames(options).MakeFrame(0);
    before += DirectionError(LinesInCamera(*frame), world_from_cam);
    const auto refined = RefineStructure(WideGates(), NoiseScale(), false, frame);
    after += DirectionError(LinesInCamera(*refined), world_from_cam);
  }
  EXPECT_LT(after, 0.75 * before);
}

TEST(KeyframeStructure, ChangesOnlyDepthsOfLines) {
  SyntheticFrames world{SyntheticFrames::Options()};
  const std::shared_ptr<const Frame> frame = world.MakeFrame(0);
  const Rigid3 world_from_cam = SyntheticFrames::CamFromWorld(0).Inverse();
  const double before = DirectionError(LinesInCamera(*frame), world_from_cam);
  const auto refined = RefineStructure(WideGates(), NoiseScale(), false, frame);
  EXPECT_NE(DirectionError(LinesInCamera(*refined), world_from_cam), before);
  // The original frame is unchanged.
  EXPECT_EQ(DirectionError(LinesInCamera(*frame), world_from_cam), before);
  EXPECT_EQ(refined->id, frame->id);
  EXPECT_EQ(refined->points.size(), frame->points.size());
  ASSERT_EQ(refined->lines.size(), frame->lines.size());
  for (size_t i = 0; i < frame->lines.size(); ++i) {
    EXPECT_EQ(refined->lines[i].segment.start, frame->lines[i].segment.start);
    EXPECT_EQ(refined->lines[i].depth.has_value(), frame->lines[i].depth.has_value());
  }
}

TEST(KeyframeStructure, UsesTheNoiseScaleOfTheLines) {
  SyntheticFrames world{SyntheticFrames::Options()};
  const std::shared_ptr<const Frame> frame = world.MakeFrame(0);
  const Rigid3 world_from_cam = SyntheticFrames::CamFromWorld(0).Inverse();
  const auto error_with = [&](double scale) {
    const NoiseScale noise{1.0, scale, scale};
    const auto refined = RefineStructure(FrameStructureOptions(), noise, false, frame);
    return DirectionError(LinesInCamera(*refined), world_from_cam);
  };
  // With the nominal sigmas, most directions are less certain than the default gate is wide.
  EXPECT_LT(error_with(0.6), error_with(1.0));
  EXPECT_LT(error_with(1.0), error_with(100.0));
  EXPECT_EQ(error_with(100.0), DirectionError(LinesInCamera(*frame), world_from_cam));
  // The covariances are returned without the scale.
  const auto refined =
      RefineStructure(FrameStructureOptions(), NoiseScale{1.0, 0.01, 0.01}, false, frame);
  ASSERT_NE(refined, frame);
  for (size_t i = 0; i < frame->lines.size(); ++i) {
    EXPECT_NEAR(
        refined->lines[i].depth->covariance.trace() / frame->lines[i].depth->covariance.trace(),
        1.0, 0.05);
  }
}

TEST(KeyframeStructure, KeepsTheCovarianceOfTheFitIfAsked) {
  SyntheticFrames world{SyntheticFrames::Options()};
  const std::shared_ptr<const Frame> frame = world.MakeFrame(0);
  const auto claimed = RefineStructure(WideGates(), NoiseScale(), false, frame);
  const auto kept = RefineStructure(WideGates(), NoiseScale(), true, frame);
  bool any_smaller = false;
  for (size_t i = 0; i < frame->lines.size(); ++i) {
    if (!frame->lines[i].depth) continue;
    EXPECT_EQ(kept->lines[i].depth->start, claimed->lines[i].depth->start);
    EXPECT_EQ(kept->lines[i].depth->covariance, frame->lines[i].depth->covariance);
    any_smaller = any_smaller || claimed->lines[i].depth->covariance.trace() <
                                     0.9 * frame->lines[i].depth->covariance.trace();
  }
  EXPECT_TRUE(any_smaller);
}

TEST(KeyframeStructure, ReturnsTheSameFrameWithoutPairs) {
  const std::shared_ptr<const Frame> empty = SyntheticFrames::MakeEmptyFrame(0);
  EXPECT_EQ(RefineStructure(FrameStructureOptions(), NoiseScale(), false, empty), empty);
}

}  // namespace
}  // namespace msc_vo
