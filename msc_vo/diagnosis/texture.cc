// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/texture.h"

#include <algorithm>
#include <string>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Features with which tracking rests on both kinds; below, on the other kind alone.
constexpr int kFewPoints = 100, kFewLines = 15;

int MedianOf(const std::vector<Texture>& images, int Texture::*member) {
  std::vector<int> values;
  for (const Texture& image : images) values.push_back(image.*member);
  return Median(std::move(values));
}

}  // namespace

Texture MeasureTexture(const Frame& frame) {
  Texture texture;
  texture.points = static_cast<int>(frame.points.size());
  texture.points_with_depth =
      static_cast<int>(std::count_if(frame.points.begin(), frame.points.end(),
                                     [](const PointFeature& point) { return point.HasDepth(); }));
  texture.lines = static_cast<int>(frame.lines.size());
  return texture;
}

void AddTextureFindings(const std::vector<Texture>& images, Findings* findings) {
  if (images.empty()) return;
  const int points = MedianOf(images, &Texture::points);
  const int with_depth = MedianOf(images, &Texture::points_with_depth);
  const int lines = MedianOf(images, &Texture::lines);
  const std::string text =
      FormatText("texture: %d points, %d of them with depth, and %d lines in the median image",
                 points, with_depth, lines);
  const Measurement measurement{static_cast<double>(with_depth), "points"};
  if (with_depth >= kFewPoints) {
    findings->push_back(Good("images.texture", text, measurement));
    return;
  }
  const char* fix =
      lines >= kFewLines
          ? "little texture: keep lines and structure on (mode msc-vo, the default)"
          : "hardly any feature: more light, a larger distance from blank walls, or lower "
            "features.points.min_fast_threshold";
  findings->push_back(Warning("images.texture", text, fix, measurement));
}

}  // namespace msc_vo
