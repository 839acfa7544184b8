// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/registration_edges.h"

#include <algorithm>
#include <string>

namespace msc_vo {

namespace {

constexpr int kMaxImages = 20;

}  // namespace

void CompareEdges(const RgbdDecoder& decoder, const std::vector<int>& images,
                  const Calibration& corrected, EdgeComparison* comparison) {
  const RgbdDecoder after(decoder.index(), corrected);
  for (const int index : images) {
    try {
      const RgbdImage image = decoder.Decode(index);
      comparison->Add(image.gray, image.depth, after.Decode(index).depth);
    } catch (const UnreadableImage&) {
      continue;
    }
  }
}

bool EdgesAgree(const RgbdDecoder& decoder, const Calibration& corrected) {
  std::string error;
  if (!corrected.IsValid(&error)) return false;
  std::vector<int> images;
  const int count = std::min(kMaxImages, decoder.size());
  for (int i = 0; i < count; ++i) images.push_back(i * decoder.size() / count);
  EdgeComparison comparison;
  CompareEdges(decoder, images, corrected, &comparison);
  return comparison.Agrees();
}

}  // namespace msc_vo
