// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/point_matcher.h"

#include "tests/support/synthetic_frames.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

Descriptor Flip(Descriptor descriptor, int bits) {
  for (int i = 0; i < bits; ++i) descriptor[i / 8] ^= static_cast<uint8_t>(1u << (i % 8));
  return descriptor;
}

class PointMatcherTest : public ::testing::Test {
 protected:
  // Adds a feature and rebuilds the grid.
  void AddFeature(double x, double y, const Descriptor& descriptor, int level = 0) {
    PointFeature feature;
    feature.pixel = {x, y};
    feature.level = level;
    feature.descriptor = descriptor;
    frame_.points.push_back(feature);
    frame_.grid = FeatureGrid(frame_.camera, frame_.points);
  }
  static PointCandidate Candidate(LandmarkId id, double x, double y, const Descriptor& descriptor,
                                  int level = 0) {
    PointCandidate candidate;
    candidate.id = id;
    candidate.pixel = {x, y};
    candidate.descriptor = descriptor;
    candidate.level = level;
    return candidate;
  }

  Frame frame_;
  PointMatcherOptions options_;
  Descriptor zero_{};
};

TEST_F(PointMatcherTest, SelectsTheNearestDescriptorWithinTheRadius) {
  AddFeature(100, 100, Flip(zero_, 40));
  AddFeature(104, 100, Flip(zero_, 5));
  AddFeature(140, 100, zero_);  // the same descriptor, too far away
  const auto matches = MatchPoints(options_, frame_, {Candidate(7, 101, 100, zero_)}, 10.0, {});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].feature, 1);
  EXPECT_EQ(matches[0].id, 7);
}

TEST_F(PointMatcherTest, RejectsDistantAmbiguousTakenAndDynamicFeatures) {
  AddFeature(100, 100, Flip(zero_, 100));
  EXPECT_TRUE(MatchPoints(options_, frame_, {Candidate(7, 100, 100, zero_)}, 10.0, {}).empty());
  AddFeature(102, 100, Flip(zero_, 30));
  AddFeature(98, 100, Flip(zero_, 31));
  EXPECT_TRUE(MatchPoints(options_, frame_, {Candidate(7, 100, 100, zero_)}, 10.0, {}).empty());
  const auto matches =
      MatchPoints(options_, frame_, {Candidate(7, 100, 100, zero_)}, 10.0, {false, true, false});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].feature, 2);
  frame_.points[2].dynamic = true;
  EXPECT_TRUE(
      MatchPoints(options_, frame_, {Candidate(7, 100, 100, zero_)}, 10.0, {false, true, false})
          .empty());
}

TEST_F(PointMatcherTest, RequiresASimilarLevel) {
  AddFeature(100, 100, zero_, 4);
  EXPECT_TRUE(MatchPoints(options_, frame_, {Candidate(7, 100, 100, zero_, 1)}, 10, {}).empty());
  EXPECT_EQ(MatchPoints(options_, frame_, {Candidate(7, 100, 100, zero_, 3)}, 10, {}).size(), 1u);
}

// A keyframe of larger images has such levels. Its pixels are smaller, and so is the radius.
TEST_F(PointMatcherTest, MatchesLevelsFinerThanTheImage) {
  AddFeature(100, 100, zero_, -8);
  const auto matches = [this](double x, int level) {
    return MatchPoints(options_, frame_, {Candidate(7, x, 100, zero_, level)}, 10.0, {}).size();
  };
  EXPECT_EQ(matches(102, -8), 1u);
  EXPECT_EQ(matches(103, -8), 0u);  // 10 pixels / 1.2^8 = 2.3 pixels
  EXPECT_EQ(matches(100, 0), 0u);
}

TEST_F(PointMatcherTest, AssignsAFeatureToItsBestCandidate) {
  AddFeature(100, 100, Flip(zero_, 10));
  const auto matches =
      MatchPoints(options_, frame_,
                  {Candidate(1, 100, 100, zero_), Candidate(2, 101, 100, Flip(zero_, 8)),
                   Candidate(3, 101, 100, Flip(zero_, 8))},
                  10.0, {});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].id, 2);
}

TEST_F(PointMatcherTest, ProjectsPointsInFrontAndInsideTheImage) {
  PointCandidate candidate;
  candidate.position = {0, 0, 2};
  EXPECT_TRUE(ProjectCandidate(frame_.camera, Rigid3(), &candidate));
  EXPECT_TRUE(candidate.pixel.isApprox(Eigen::Vector2d(319.5, 239.5)));
  candidate.position = {0, 0, -2};
  EXPECT_FALSE(ProjectCandidate(frame_.camera, Rigid3(), &candidate));
  candidate.position = {5, 0, 2};
  EXPECT_FALSE(ProjectCandidate(frame_.camera, Rigid3(), &candidate));
}

}  // namespace
}  // namespace msc_vo
