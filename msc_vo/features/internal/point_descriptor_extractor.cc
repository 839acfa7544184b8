// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/point_descriptor_extractor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace msc_vo {

namespace {

constexpr int kPatchRadius = 15;  // pixels
constexpr int kPatchRow = 32;     // width of the patch, rounded up to whole vectors
constexpr int kNumPairs = 8 * std::tuple_size<Descriptor>::value;

// One row of the disc-shaped patch.
struct PatchRow {
  std::array<int16_t, kPatchRow> inside;  // 1 inside the disc, 0 outside
  std::array<int16_t, kPatchRow> x;       // coordinate relative to the centre; 0 outside
};

using PatchRows = std::array<PatchRow, kPatchRadius + 1>;  // by their distance from the centre
PatchRows MakePatchRows() {
  PatchRows rows{};
  for (int y = 0; y <= kPatchRadius; ++y) {
    for (int x = -kPatchRadius; x <= kPatchRadius; ++x) {
      // The disc extends half a pixel beyond the radius.
      const bool is_inside = x * x + y * y <= kPatchRadius * (kPatchRadius + 1);
      rows[y].inside[x + kPatchRadius] = is_inside ? 1 : 0;
      rows[y].x[x + kPatchRadius] = static_cast<int16_t>(is_inside ? x : 0);
    }
  }
  return rows;
}

// Positions of the compared pixels: the first of all pairs, then the second of all pairs.
struct Pattern {
  std::array<float, 2 * kNumPairs> x, y;
};

// Draws each coordinate as the sum of three integers from -5 to 5, approximately a Gaussian of
// 5.5 px: about a fifth of the patch's width, the best distribution in the BRIEF paper.
Pattern MakePattern() {
  std::mt19937 random(1);  // its sequence is defined by the C++ standard
  const auto coordinate = [&random] {
    int sum = 0;
    for (int i = 0; i < 3; ++i) sum += static_cast<int>(random() % 11) - 5;
    return static_cast<float>(sum);
  };
  Pattern pattern;
  for (int i = 0; i < 2 * kNumPairs;) {
    pattern.x[i] = coordinate();
    pattern.y[i] = coordinate();
    if (std::hypot(pattern.x[i], pattern.y[i]) <= kPatchRadius) ++i;
  }
  return pattern;
}

// Rounds a value in (-64, 64) without a branch.
inline int Round(float value) { return static_cast<int>(value + 64.5f) - 64; }

}  // namespace

double PointDescriptorExtractor::Angle(const cv::Point& pixel) const {
  static const PatchRows rows = MakePatchRows();
  int moment_x = 0, moment_y = 0;
  for (int y = -kPatchRadius; y <= kPatchRadius; ++y) {
    const uint8_t* values = gray_.ptr<uint8_t>(pixel.y + y) + pixel.x - kPatchRadius;
    const PatchRow& row = rows[std::abs(y)];
    int sum = 0;
    for (int i = 0; i < kPatchRow; ++i) {
      sum += row.inside[i] * values[i];
      moment_x += row.x[i] * values[i];
    }
    moment_y += y * sum;
  }
  return std::atan2(static_cast<double>(moment_y), static_cast<double>(moment_x));
}

Descriptor PointDescriptorExtractor::Describe(const cv::Point& pixel, double angle) const {
  static const Pattern pattern = MakePattern();
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  const auto step = static_cast<int>(smooth_.step);
  std::array<int, 2 * kNumPairs> offsets;
  for (int i = 0; i < 2 * kNumPairs; ++i) {
    offsets[i] = Round(s * pattern.x[i] + c * pattern.y[i]) * step +
                 Round(c * pattern.x[i] - s * pattern.y[i]);
  }
  const uint8_t* center = smooth_.ptr<uint8_t>(pixel.y) + pixel.x;
  Descriptor descriptor;
  for (size_t byte = 0; byte < descriptor.size(); ++byte) {
    int bits = 0;
    for (int bit = 0; bit < 8; ++bit) {
      const size_t pair = 8 * byte + bit;
      bits |= static_cast<int>(center[offsets[pair]] < center[offsets[kNumPairs + pair]]) << bit;
    }
    descriptor[byte] = static_cast<uint8_t>(bits);
  }
  return descriptor;
}

}  // namespace msc_vo
