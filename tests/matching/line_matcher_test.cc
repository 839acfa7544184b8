// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/line_matcher.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

LineSegment2 Segment(double x0, double y0, double x1, double y1) {
  LineSegment2 segment;
  segment.start = Eigen::Vector2d(x0, y0);
  segment.end = Eigen::Vector2d(x1, y1);
  return segment;
}

// Number of matches of one feature with one candidate along y = 100 from x = 100 to 200.
size_t NumMatches(const LineSegment2& segment, int flipped_bytes = 0, double radius = 5.0) {
  Frame frame;
  LineFeature feature;
  feature.segment = segment;
  for (int i = 0; i < flipped_bytes; ++i) feature.descriptor[i] = 0xff;
  frame.lines = {feature};
  LineCandidate candidate;
  candidate.image = Segment(100, 100, 200, 100);
  return MatchLines(LineMatcherOptions(), frame, {candidate}, radius, {}).size();
}

TEST(LineMatcher, MatchesTheSameLineAndFragmentsOfIt) {
  EXPECT_EQ(NumMatches(Segment(100, 100, 200, 100)), 1u);
  EXPECT_EQ(NumMatches(Segment(120, 102, 150, 103)), 1u);
  EXPECT_EQ(NumMatches(Segment(50, 100, 400, 100)), 1u);
}

TEST(LineMatcher, AppliesEveryGate) {
  EXPECT_EQ(NumMatches(Segment(100, 106, 200, 106)), 0u);      // distance
  EXPECT_EQ(NumMatches(Segment(100, 90, 200, 110)), 0u);       // angle of 11 degrees
  EXPECT_EQ(NumMatches(Segment(200, 100, 100, 100)), 0u);      // opposite direction
  EXPECT_EQ(NumMatches(Segment(180, 100, 280, 100)), 0u);      // overlap of a fifth
  EXPECT_EQ(NumMatches(Segment(100, 100, 200, 100), 11), 0u);  // descriptor distance of 88 bits
}

TEST(LineMatcher, PrefersTheNearerOfEqualDescriptors) {
  Frame frame;
  frame.lines.resize(1);
  frame.lines[0].segment = Segment(100, 100, 200, 100);
  LineCandidate far;
  far.id = 1;
  far.image = Segment(100, 103, 200, 103);
  LineCandidate near;
  near.id = 2;
  near.image = Segment(100, 101, 200, 101);
  const auto matches = MatchLines(LineMatcherOptions(), frame, {far, near}, 5.0, {});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].id, 2);
}

TEST(LineMatcher, ExcludesTakenAndDynamicFeatures) {
  Frame frame;
  frame.lines.resize(1);
  frame.lines[0].segment = Segment(100, 100, 200, 100);
  LineCandidate candidate;
  candidate.image = Segment(100, 101, 200, 101);
  EXPECT_EQ(MatchLines(LineMatcherOptions(), frame, {candidate}, 5.0, {false}).size(), 1u);
  EXPECT_TRUE(MatchLines(LineMatcherOptions(), frame, {candidate}, 5.0, {true}).empty());
  frame.lines[0].dynamic = true;
  EXPECT_TRUE(MatchLines(LineMatcherOptions(), frame, {candidate}, 5.0, {}).empty());
}

TEST(LineMatcher, ProjectsTheVisiblePart) {
  const PinholeCamera camera;
  LineCandidate candidate;
  // Starts behind the camera and outside the image, ends inside.
  candidate.segment.start = Eigen::Vector3d(0, 0, -1);
  candidate.segment.end = Eigen::Vector3d(0.5, 0, 2);
  ASSERT_TRUE(ProjectCandidate(camera, Rigid3(), &candidate));
  EXPECT_NEAR(candidate.image.end.x(), camera.cx + camera.fx * 0.25, 1e-9);
  EXPECT_TRUE(camera.IsInside(candidate.image.start, -1e-6));
  candidate.segment.end = Eigen::Vector3d(0.5, 0, -2);
  EXPECT_FALSE(ProjectCandidate(camera, Rigid3(), &candidate));
}

}  // namespace
}  // namespace msc_vo
