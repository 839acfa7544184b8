// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/relative_pairs.h"

#include <cmath>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

// Poses along x at these metres, one second apart.
std::vector<std::pair<int, int>> PairsAlong(const std::vector<double>& metres,
                                            const RelativeDelta& delta) {
  std::vector<double> stamps;
  std::vector<Eigen::Vector3d> positions;
  for (const double x : metres) {
    stamps.push_back(static_cast<double>(stamps.size()));
    positions.emplace_back(x, 0.0, 0.0);
  }
  return FindRelativePairs(stamps, positions, delta, 0.1);
}

TEST(RelativePairs, SelectsFrames) {
  const std::vector<double> path = {0, 0, 0, 0, 0};
  EXPECT_THAT(PairsAlong(path, {2, DeltaUnit::kFrames, false}),
              ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(PairsAlong(path, {2, DeltaUnit::kFrames, true}),
              ElementsAre(Pair(0, 2), Pair(1, 3), Pair(2, 4)));
  EXPECT_THAT(PairsAlong(path, {5, DeltaUnit::kFrames, true}), IsEmpty());
}

TEST(RelativePairs, SelectsPathLengths) {
  // The path reaches one metre at pose 2, then 1.2 metres after it at pose 4, then 0.8 at the end.
  const std::vector<double> path = {0.0, 0.5, 1.0, 1.5, 2.2, 3.0};
  EXPECT_THAT(PairsAlong(path, {1, DeltaUnit::kMetres, false}), ElementsAre(Pair(2, 4)));
  EXPECT_THAT(PairsAlong(path, {1, DeltaUnit::kMetres, true}), ElementsAre(Pair(0, 2), Pair(1, 3)));
  // Back and forth: the path counts, not the distance.
  EXPECT_THAT(PairsAlong({0, 1, 0, 1, 0}, {2, DeltaUnit::kMetres, false}), ElementsAre(Pair(2, 4)));
}

TEST(RelativePairs, SelectsSeconds) {
  const std::vector<double> path = {0, 0, 0, 0, 0};
  EXPECT_THAT(PairsAlong(path, {2.05, DeltaUnit::kSeconds, false}),
              ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(PairsAlong(path, {2.05, DeltaUnit::kSeconds, true}),
              ElementsAre(Pair(0, 2), Pair(1, 3), Pair(2, 4)));
  EXPECT_THAT(PairsAlong(path, {1.5, DeltaUnit::kSeconds, true}),
              IsEmpty());  // beyond the tolerance
}

TEST(RelativeDelta, IsPositiveAndCountsWholeFrames) {
  for (const DeltaUnit unit : {DeltaUnit::kFrames, DeltaUnit::kMetres, DeltaUnit::kSeconds}) {
    EXPECT_EQ((RelativeDelta{2.0, unit}.Problem()), "");
    EXPECT_EQ((RelativeDelta{1.5, unit}.Problem().empty()), unit != DeltaUnit::kFrames);
    for (const double value : {0.0, -1.0, std::nan("")}) {
      EXPECT_NE((RelativeDelta{value, unit}.Problem()), "") << value;
    }
  }
}

TEST(RelativePairs, HandlesFewPoses) {
  for (const DeltaUnit unit : {DeltaUnit::kFrames, DeltaUnit::kMetres, DeltaUnit::kSeconds}) {
    EXPECT_THAT(PairsAlong({}, {1, unit, true}), IsEmpty());
    EXPECT_THAT(PairsAlong({0}, {1, unit, true}), IsEmpty());
  }
}

}  // namespace
}  // namespace msc_vo
