// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/registration_edges.h"

#include <algorithm>
#include <string>

#include "msc_vo/sensor/depth_edges.h"

namespace msc_vo {

namespace {

constexpr int kMaxImages = 20;

}  // namespace

bool EdgesAgree(const RgbdDecoder& decoder, const Calibration& corrected) {
  std::string error;
  if (!corrected.IsValid(&error)) return false;
  const RgbdDecoder after(decoder.index(), corrected);
  EdgeComparison comparison;
  const int count = std::min(kMaxImages, decoder.size());
  for (int i = 0; i < count; ++i) {
    const int index = i * decoder.size() / count;
    try {
      const RgbdImage image = decoder.Decode(index);
      comparison.Add(image.gray, image.depth, after.Decode(index).depth);
    } catch (const UnreadableImage&) {
      continue;
    }
  }
  return comparison.Agrees();
}

}  // namespace msc_vo
