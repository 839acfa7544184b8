// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <random>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

// A frame whose features have nothing but random descriptors.
inline Frame RandomFeatures(int num_points, int num_lines, std::mt19937* random) {
  Frame frame;
  frame.points.resize(num_points);
  frame.lines.resize(num_lines);
  ForEachFeatures(frame, [random](auto& features) {
    for (auto& feature : features) {
      for (uint8_t& byte : feature.descriptor) byte = static_cast<uint8_t>((*random)());
    }
  });
  return frame;
}

// The same place in another view: each bit differs with the given probability.
inline Frame WithFlippedBits(Frame frame, double probability, std::mt19937* random) {
  std::bernoulli_distribution flips(probability);
  ForEachFeatures(frame, [&](auto& features) {
    for (auto& feature : features) {
      for (uint8_t& byte : feature.descriptor) {
        for (int bit = 0; bit < 8; ++bit)
          byte = static_cast<uint8_t>(byte ^ (flips(*random) << bit));
      }
    }
  });
  return frame;
}

}  // namespace msc_vo
