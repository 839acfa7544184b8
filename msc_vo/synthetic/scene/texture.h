// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

enum class TextureKind {
  kPlain,     ///< one colour
  kPlaster,   ///< one colour with faint, smooth stains: no corners
  kWood,      ///< grain along s
  kPlanks,    ///< floor boards along s with staggered joints
  kTiles,     ///< square tiles with grout
  kPoster,    ///< random rectangles and discs of three sizes
  kBooks,     ///< spines side by side, standing on t = 0
  kRug,       ///< border stripes and a lattice of diamonds
  kSpeckle,   ///< small blocks of random brightness: fabric, stone
  kOutdoors,  ///< sky above trees, for windows
};

/// A procedural texture: a colour for every point of a surface, without stored images.
struct Texture {
  TextureKind kind = TextureKind::kPlain;
  Eigen::Vector3f color{0.8f, 0.8f, 0.8f};   ///< red, green, blue, 0..1
  Eigen::Vector3f accent{0.3f, 0.3f, 0.3f};  ///< of grout, joints, motifs
  float scale = 1.0f;                        ///< size of the pattern's elements; 1: life size
  uint32_t seed = 0;
  bool mirrored = false;  ///< the pattern runs from the far end of the side s to its start
};

/// A point on a rectangle: coordinates along its sides, and the lengths of the sides; metres.
struct SurfacePoint {
  float s = 0.0f, t = 0.0f;
  float width = 1.0f, height = 1.0f;
};

/// Colour of a point, 0..1, unlit and unfiltered.
Eigen::Vector3f EvaluateTexture(const Texture& texture, const SurfacePoint& point);

/// Straight edges of the pattern on a rectangle of width x height metres, in (s, t): both borders
/// of the joints of planks and tiles, the stripes of rugs, the sides of a poster's rectangles. Not
/// included are the border of the rectangle, the spines of books (whose colour fades towards the
/// edge, so detected positions vary) and grain, which is not straight.
std::vector<LineSegment2> TextureEdges(const Texture& texture, float width, float height);

}  // namespace msc_vo
