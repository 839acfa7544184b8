// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/binary_words.h"

#include <algorithm>
#include <iterator>
#include <random>

#include "tests/place_recognition/random_features.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

int NumShared(const std::vector<BinaryWord>& a, const std::vector<BinaryWord>& b) {
  std::vector<BinaryWord> shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
  return static_cast<int>(shared.size());
}

TEST(BinaryWords, AreDifferentAscendingAndInRange) {
  std::mt19937 random(1);
  const std::vector<BinaryWord> words = WordsOf(RandomFeatures(300, 50, &random));
  EXPECT_TRUE(std::is_sorted(words.begin(), words.end()));
  EXPECT_EQ(std::adjacent_find(words.begin(), words.end()), words.end());
  EXPECT_LT(words.back(), kNumBinaryWords);
  EXPECT_THAT(WordsOf({}), testing::IsEmpty());
}

TEST(BinaryWords, OfPointsAndOfLinesDiffer) {
  std::mt19937 random(2);
  Frame points = RandomFeatures(40, 0, &random);
  Frame lines;
  for (const PointFeature& point : points.points) {
    lines.lines.emplace_back();
    lines.lines.back().descriptor = point.descriptor;
  }
  EXPECT_EQ(NumShared(WordsOf(points), WordsOf(lines)), 0);
}

// A single other bit leaves all words of a feature but one.
TEST(BinaryWords, ShareNoBits) {
  std::mt19937 random(3);
  const Frame frame = RandomFeatures(1, 0, &random);
  const std::vector<BinaryWord> words = WordsOf(frame);
  for (int bit = 0; bit < 256; ++bit) {
    Frame other = frame;
    other.points[0].descriptor[bit / 8] ^= static_cast<uint8_t>(1 << (bit % 8));
    EXPECT_GE(NumShared(words, WordsOf(other)), static_cast<int>(words.size()) - 1);
  }
}

}  // namespace
}  // namespace msc_vo
