// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/binary_words.h"

#include <array>

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

// A set of words as bits; iteration is in ascending order.
class WordSet {
 public:
  // Adds the words of all features. Each subset of bits has its own range of words.
  template <typename Feature>
  void Add(const std::vector<Feature>& features, int num_words, int first_table) {
    for (const Feature& feature : features) {
      for (int i = 0; i < num_words; ++i) {
        const BinaryWord table = static_cast<BinaryWord>(first_table + i) << kNumBits;
        const BinaryWord word = table + WordOf(feature.descriptor, i);
        groups_[word / kGroup] |= uint64_t{1} << (word % kGroup);
      }
    }
  }

  std::vector<BinaryWord> Ascending() const {
    std::vector<BinaryWord> words;
    for (BinaryWord i = 0; i < groups_.size(); ++i) {
      for (uint64_t group = groups_[i]; group != 0; group &= group - 1) {
        words.push_back(i * kGroup + static_cast<BinaryWord>(__builtin_ctzll(group)));
      }
    }
    return words;
  }

 private:
  static constexpr BinaryWord kGroup = 64;
  std::array<uint64_t, kNumBinaryWords / kGroup> groups_{};  // one bit per word
};

}  // namespace

std::vector<BinaryWord> WordsOf(const Frame& frame) {
  WordSet words;
  words.Add(frame.points, kWordsPerPoint, 0);
  words.Add(frame.lines, kWordsPerLine, kWordsPerPoint);
  return words.Ascending();
}

}  // namespace msc_vo
