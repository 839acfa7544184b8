// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_evidence.h"

#include <algorithm>

#include "tests/structure/evidence.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

testing::View RandomView(int num_lines, int num_normals) {
  Random random(1);
  testing::View view;
  testing::AddClutter(num_lines, testing::kLineSigma, &random, &view.lines);
  testing::AddClutter(num_normals, testing::kNormalSigma, &random, &view.normals);
  return view;
}

DirectionEvidence Gather(const testing::View& view) {
  return GatherEvidence(view.lines, view.normals);
}

// Total weight of the lines; the weights of all evidence sum to 1.
double LineWeight(const DirectionEvidence& evidence) {
  double lines = 0.0;
  double all = 0.0;
  for (size_t i = 0; i < evidence.all.size(); ++i) {
    if (evidence.IsLine(i)) lines += evidence.all[i].weight;
    all += evidence.all[i].weight;
  }
  EXPECT_NEAR(all, 1.0, 1e-12);
  return lines;
}

TEST(DirectionEvidence, WeightsBothKindsEquallyIfBothAreNumerous) {
  EXPECT_NEAR(LineWeight(Gather(RandomView(20, 200))), 0.5, 1e-12);
  EXPECT_NEAR(LineWeight(Gather(RandomView(100, 300))), 0.5, 1e-12);
}

TEST(DirectionEvidence, WeightsFewDirectionsByTheirNumber) {
  EXPECT_NEAR(LineWeight(Gather(RandomView(10, 200))), 0.5 / 1.5, 1e-12);
  EXPECT_NEAR(LineWeight(Gather(RandomView(20, 50))), 1.0 / 1.25, 1e-12);
  EXPECT_NEAR(LineWeight(Gather(RandomView(5, 0))), 1.0, 1e-12);
}

TEST(DirectionEvidence, CountsLinesAndNormals) {
  const DirectionEvidence evidence = Gather(RandomView(7, 11));
  EXPECT_EQ(evidence.num_lines, 7u);
  EXPECT_EQ(evidence.NumNormals(), 11u);
  EXPECT_TRUE(evidence.IsLine(6));
  EXPECT_FALSE(evidence.IsLine(7));
}

TEST(DirectionEvidence, DropsUncertainDirections) {
  testing::View view = RandomView(10, 10);
  view.lines[3].sigma = kMaxEvidenceSigma + DegreesToRadians(0.1);
  view.normals[4].sigma = kMaxEvidenceSigma + DegreesToRadians(0.1);
  view.normals[5].sigma = kMaxEvidenceSigma - DegreesToRadians(0.1);
  const DirectionEvidence evidence = Gather(view);
  EXPECT_EQ(evidence.num_lines, 9u);
  EXPECT_EQ(evidence.NumNormals(), 9u);
}

TEST(DirectionEvidence, IsIndependentOfTheOrder) {
  testing::View view = RandomView(10, 30);
  const DirectionEvidence evidence = Gather(view);
  std::reverse(view.lines.begin(), view.lines.end());
  std::reverse(view.normals.begin(), view.normals.end());
  const DirectionEvidence reversed = Gather(view);
  ASSERT_EQ(reversed.all.size(), evidence.all.size());
  for (size_t i = 0; i < evidence.all.size(); ++i) {
    EXPECT_EQ(reversed.all[i].direction, evidence.all[i].direction) << i;
  }
}

TEST(DirectionEvidence, HasUnitDirections) {
  const testing::Evidence lines = {{Eigen::Vector3d(0.0, 3.0, 4.0), DegreesToRadians(1.0)}};
  const DirectionEvidence evidence = GatherEvidence(lines, {});
  ASSERT_EQ(evidence.all.size(), 1u);
  EXPECT_TRUE(evidence.all[0].direction.isApprox(Eigen::Vector3d(0.0, 0.6, 0.8)));
}

}  // namespace
}  // namespace msc_vo
