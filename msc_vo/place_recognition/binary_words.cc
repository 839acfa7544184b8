// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/binary_words.h"

#include <algorithm>

#include "msc_vo/frame/descriptor.h"

namespace msc_vo {

namespace {

// Bits of a word. More make words rarer and queries faster, fewer make them survive other views.
constexpr int kNumBits = 14;
constexpr int kWordsPerPoint = 4;
constexpr int kWordsPerLine = 3;
static_assert(kNumBinaryWords == (kWordsPerPoint + kWordsPerLine) << kNumBits);

bool BitOf(const Descriptor& descriptor, int bit) { return (descriptor[bit / 8] >> (bit % 8)) & 1; }

// Word `index` of a descriptor. No two words of it share a bit. The odd stride spreads the bits of
// a word over the descriptor, since neighbours are correlated.
BinaryWord WordOf(const Descriptor& descriptor, int index) {
  constexpr int kStride = 73;
  constexpr int kDescriptorBits = 256;
  BinaryWord word = 0;
  for (int i = 0; i < kNumBits; ++i) {
    const int bit = (index * kNumBits + i) * kStride % kDescriptorBits;
    word = 2 * word + BitOf(descriptor, bit);
  }
  return word;
}

// Appends words of all features. The words of each index begin at a number of their own.
template <typename Feature>
void Append(const std::vector<Feature>& features, int num_words, int first_table,
            std::vector<BinaryWord>* words) {
  for (const Feature& feature : features) {
    for (int i = 0; i < num_words; ++i) {
      const BinaryWord table = static_cast<BinaryWord>(first_table + i) << kNumBits;
      words->push_back(table + WordOf(feature.descriptor, i));
    }
  }
}

}  // namespace

std::vector<BinaryWord> WordsOf(const Frame& frame) {
  std::vector<BinaryWord> words;
  words.reserve(kWordsPerPoint * frame.points.size() + kWordsPerLine * frame.lines.size());
  Append(frame.points, kWordsPerPoint, 0, &words);
  Append(frame.lines, kWordsPerLine, kWordsPerPoint, &words);
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace msc_vo
