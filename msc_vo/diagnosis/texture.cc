// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/texture.h"

#include <algorithm>
#include <string>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/matching/plane_matcher.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Features with which tracking rests on both kinds; below, on the other kind alone.
constexpr int kFewPoints = 100, kFewLines = 15;

int MedianOf(const std::vector<ImageTexture>& images, int ImageTexture::*member) {
  std::vector<int> values;
  for (const ImageTexture& image : images) values.push_back(image.*member);
  return Median(std::move(values));
}

// What to do about too few points with depth.
std::string FixFor(const std::vector<ImageTexture>& images, int points, int lines) {
  const auto by_planes = std::count_if(images.begin(), images.end(), [](const ImageTexture& image) {
    return image.planes_determine_pose;
  });
  std::string help;
  if (by_planes > 0) {
    help = FormatText(
        "; keep lines, structure and planes on (mode msc-vo, the default): planes in three "
        "directions can give the pose in %td of %zu decoded images",
        by_planes, images.size());
  } else if (lines >= kFewLines) {
    help = "; keep lines and structure on (mode msc-vo, the default)";
  }
  if (points >= kFewPoints) {
    return "few points have depth: stay within the range of the sensor; avoid sunlight, glass and "
           "shiny surfaces" +
           help;
  }
  if (lines >= kFewLines) return "little texture" + help;
  return "hardly any feature: more light, a larger distance from blank walls, or lower "
         "features.points.min_fast_threshold" +
         help;
}

}  // namespace

ImageTexture MeasureTexture(const Frame& frame) {
  ImageTexture texture;
  texture.points = static_cast<int>(frame.points.size());
  texture.points_with_depth =
      static_cast<int>(std::count_if(frame.points.begin(), frame.points.end(),
                                     [](const PointFeature& point) { return point.HasDepth(); }));
  texture.lines = static_cast<int>(frame.lines.size());
  texture.planes_determine_pose = DetermineAPose(frame.planes);
  return texture;
}

void AddTextureFindings(const std::vector<ImageTexture>& images, Findings* findings) {
  if (images.empty()) return;
  const int points = MedianOf(images, &ImageTexture::points);
  const int with_depth = MedianOf(images, &ImageTexture::points_with_depth);
  const int lines = MedianOf(images, &ImageTexture::lines);
  const std::string text =
      FormatText("texture: %d points, %d of them with depth, and %d lines in the median image",
                 points, with_depth, lines);
  const Measurement measurement{static_cast<double>(with_depth), "points"};
  const bool shows_nothing =
      std::all_of(images.begin(), images.end(),
                  [](const ImageTexture& image) { return image.points == 0 && image.lines == 0; });
  if (shows_nothing) {
    findings->push_back(Error(
        "images.texture",
        FormatText(
            "none of %zu decoded images shows a point or a line: none of them can begin a map",
            images.size()),
        "check lens cap, light and exposure; keep away from blank walls at the beginning",
        measurement));
    return;
  }
  if (with_depth >= kFewPoints) {
    findings->push_back(Good("images.texture", text, measurement));
    return;
  }
  findings->push_back(Warning("images.texture", text, FixFor(images, points, lines), measurement));
}

}  // namespace msc_vo
