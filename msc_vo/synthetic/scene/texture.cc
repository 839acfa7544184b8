// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/texture.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace msc_vo {

namespace {

using Color = Eigen::Vector3f;

// Hash of a lattice cell: 32 well mixed bits.
uint32_t HashCell(int x, int y, uint32_t seed) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9e3779b1u ^ static_cast<uint32_t>(y) * 0x85ebca77u ^
               seed * 0xc2b2ae3du;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

// The k-th of the four independent bytes of a hash, scaled to [0, 1].
float Byte(uint32_t hash, int k) { return static_cast<float>((hash >> (8 * k)) & 255u) / 255.0f; }

int Floor(float x) {
  const int i = static_cast<int>(x);
  return i - (x < static_cast<float>(i) ? 1 : 0);
}

// Smooth noise in [0, 1] with one random value per lattice point.
float ValueNoise(float x, float y, uint32_t seed) {
  const int ix = Floor(x), iy = Floor(y);
  float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
  fx = fx * fx * (3.0f - 2.0f * fx);
  fy = fy * fy * (3.0f - 2.0f * fy);
  const float a = Byte(HashCell(ix, iy, seed), 0), b = Byte(HashCell(ix + 1, iy, seed), 0);
  const float c = Byte(HashCell(ix, iy + 1, seed), 0), d = Byte(HashCell(ix + 1, iy + 1, seed), 0);
  const float low = a + fx * (b - a);
  return low + fy * (c + fx * (d - c) - low);
}

// Muted colours of printed paper and cloth.
Color Palette(uint32_t hash) {
  static const Color colors[] = {
      {0.72f, 0.16f, 0.13f}, {0.15f, 0.28f, 0.52f}, {0.91f, 0.85f, 0.68f}, {0.13f, 0.38f, 0.24f},
      {0.87f, 0.60f, 0.15f}, {0.12f, 0.12f, 0.14f}, {0.94f, 0.94f, 0.92f}, {0.43f, 0.22f, 0.42f},
      {0.45f, 0.62f, 0.70f}, {0.50f, 0.33f, 0.20f}};
  return colors[(hash >> 4) % 10u];
}

Color Plaster(const Texture& texture, const SurfacePoint& p) {
  // Stains of one metre with a contrast of 4 %, below the threshold of any corner detector.
  return texture.color * (0.98f + 0.04f * (ValueNoise(p.s, p.t, texture.seed) - 0.5f));
}

Color Wood(const Texture& texture, const SurfacePoint& p) {
  const float s = p.s / texture.scale, t = p.t / texture.scale;
  const float bend = 0.6f * ValueNoise(1.5f * s, 4.0f * t, texture.seed);
  const float coarse = ValueNoise(1.2f * s, 14.0f * t + 4.0f * bend, texture.seed + 1);
  const float fine = ValueNoise(6.0f * s, 90.0f * t, texture.seed + 2);
  return texture.color * (0.72f + 0.30f * coarse + 0.14f * fine);
}

// Geometry of floor boards in rows along s, metres.
struct PlankLayout {
  explicit PlankLayout(const Texture& texture)
      : width(0.14f * texture.scale), length(1.3f * texture.scale), seed(texture.seed) {}

  // Shift of the joints of a row towards -s.
  float Stagger(int row) const { return length * Byte(HashCell(row, 77, seed), 1); }

  float width, length;
  float joint = 0.004f;  // width of the dark joints
  uint32_t seed;
};

Color Planks(const Texture& texture, const SurfacePoint& p) {
  const PlankLayout layout(texture);
  const int row = Floor(p.t / layout.width);
  const float s = p.s + layout.Stagger(row);
  const int plank = Floor(s / layout.length);
  const float t_in = p.t - static_cast<float>(row) * layout.width;
  const float s_in = s - static_cast<float>(plank) * layout.length;
  if (t_in < layout.joint || s_in < layout.joint) return texture.accent;
  const uint32_t hash = HashCell(plank, row, texture.seed);
  const SurfacePoint grain{s + 3.0f * Byte(hash, 1), p.t + 5.0f * Byte(hash, 2), 1.0f, 1.0f};
  return Wood(texture, grain) * (0.80f + 0.35f * Byte(hash, 0));
}

constexpr float kGrout = 0.006f;                                         // metres
float TileSide(const Texture& texture) { return 0.2f * texture.scale; }  // metres, grout included

Color Tiles(const Texture& texture, const SurfacePoint& p) {
  const float side = TileSide(texture);
  const int column = Floor(p.s / side), row = Floor(p.t / side);
  const float s_in = p.s - static_cast<float>(column) * side;
  const float t_in = p.t - static_cast<float>(row) * side;
  if (s_in < kGrout || t_in < kGrout) return texture.accent;
  const uint32_t hash = HashCell(column, row, texture.seed);
  const float stain = ValueNoise(25.0f * p.s, 25.0f * p.t, texture.seed);
  const Color base =
      Byte(hash, 1) < 0.12f ? Color(0.5f * (texture.color + texture.accent)) : texture.color;
  return base * (0.90f + 0.12f * Byte(hash, 0) + 0.06f * (stain - 0.5f));
}

// A rectangle or disc of a poster; lengths relative to the side of its lattice cell.
struct Figure {
  bool is_disc = false;
  float center_s = 0.0f, center_t = 0.0f;
  float half_s = 0.0f, half_t = 0.0f;
  Color color = Color::Zero();
};

// The figure in a lattice cell; a quarter of the cells is empty.
std::optional<Figure> FigureOfCell(const Texture& texture, int column, int row, uint32_t seed) {
  const uint32_t hash = HashCell(column, row, texture.seed ^ seed);
  if ((hash & 7u) < 2u) return std::nullopt;
  const uint32_t shape = HashCell(column, row, texture.seed + 31 * seed);
  Figure figure;
  figure.is_disc = (hash & 64u) != 0;
  figure.half_s = 0.14f + 0.30f * Byte(shape, 0);
  figure.half_t = 0.14f + 0.30f * Byte(shape, 1);
  // The figure lies inside its cell, so one look-up per layer is sufficient.
  figure.center_s = figure.half_s + (1.0f - 2.0f * figure.half_s) * Byte(shape, 2);
  figure.center_t = figure.half_t + (1.0f - 2.0f * figure.half_t) * Byte(shape, 3);
  figure.color = Palette(hash >> 8);
  return figure;
}

// A poster has several layers of figures, each on top of the previous one and with cells of half
// the size; their seeds are 1, 2, ...
constexpr uint32_t kPosterLayers = 3;
float PosterCell(const Texture& texture, uint32_t layer) {
  return 0.32f * texture.scale / static_cast<float>(1u << (layer - 1));  // metres
}

Color Poster(const Texture& texture, const SurfacePoint& p) {
  Color color = texture.color * (0.85f + 0.2f * ValueNoise(4.0f * p.s, 4.0f * p.t, texture.seed));
  for (uint32_t layer = 1; layer <= kPosterLayers; ++layer) {
    const float size = PosterCell(texture, layer);
    const int column = Floor(p.s / size), row = Floor(p.t / size);
    const std::optional<Figure> figure = FigureOfCell(texture, column, row, layer);
    if (!figure) continue;
    const float ds = (p.s / size - static_cast<float>(column) - figure->center_s) / figure->half_s;
    const float dt = (p.t / size - static_cast<float>(row) - figure->center_t) / figure->half_t;
    const bool inside =
        figure->is_disc ? ds * ds + dt * dt < 1.0f : std::max(std::abs(ds), std::abs(dt)) < 1.0f;
    if (inside) color = figure->color;
  }
  return color;
}

Color Books(const Texture& texture, const SurfacePoint& p) {
  const float width = 0.038f * texture.scale;  // metres, of a mean spine
  const auto edge = [&](int i) {
    return (static_cast<float>(i) + 0.6f * (Byte(HashCell(i, 5, texture.seed), 0) - 0.5f)) * width;
  };
  int book = Floor(p.s / width);
  if (p.s < edge(book)) --book;
  if (p.s >= edge(book + 1)) ++book;
  const uint32_t hash = HashCell(book, 9, texture.seed);
  const float height = p.height * (0.68f + 0.27f * Byte(hash, 0));
  if (p.t > height || Byte(hash, 3) < 0.06f) return texture.accent;  // above the book, or a gap
  const float across = (p.s - edge(book)) / (edge(book + 1) - edge(book));
  const float along = p.t / height;
  const Color cover = Palette(hash >> 7) * (0.7f + 0.3f * Byte(hash, 2));
  const float label = 0.25f + 0.4f * Byte(hash, 1);
  if (std::abs(along - label) < 0.12f && across > 0.2f && across < 0.8f) {
    const bool ink = (HashCell(Floor(p.s / 0.004f), Floor(p.t / 0.008f), hash) & 3u) == 0;
    return ink ? Color(0.15f, 0.13f, 0.12f) : Color(0.90f, 0.86f, 0.75f);
  }
  return cover * (1.0f - 0.5f * (2.0f * across - 1.0f) * (2.0f * across - 1.0f));  // round spine
}

constexpr int kRugStripes = 4;
constexpr float kRugStripe = 0.0625f;  // metres

Color Rug(const Texture& texture, const SurfacePoint& p) {
  const float border = std::min(std::min(p.s, p.width - p.s), std::min(p.t, p.height - p.t));
  const float fiber = 0.85f + 0.3f * ValueNoise(150.0f * p.s, 150.0f * p.t, texture.seed);
  if (border < kRugStripes * kRugStripe) {
    const int stripe = Floor(border / kRugStripe);
    return (stripe % 2 == 0 ? texture.accent : Color(0.88f, 0.80f, 0.62f)) * fiber;
  }
  const float size = 0.22f * texture.scale;  // metres
  const int column = Floor(p.s / size), row = Floor(p.t / size);
  const float ds = std::abs(p.s / size - static_cast<float>(column) - 0.5f);
  const float dt = std::abs(p.t / size - static_cast<float>(row) - 0.5f);
  const uint32_t hash = HashCell(column, row, texture.seed);
  Color color = texture.color;
  if (ds + dt < 0.46f) color = texture.accent;
  if (ds + dt < 0.30f) color = Palette(hash);
  if (std::max(ds, dt) < 0.08f) color = Palette(hash >> 9);
  return color * fiber;
}

Color Speckle(const Texture& texture, const SurfacePoint& p) {
  const float size = 0.012f * texture.scale;  // metres
  const uint32_t hash = HashCell(Floor(p.s / size), Floor(p.t / size), texture.seed);
  const float weave = 0.35f * Byte(hash, 0) * Byte(hash, 1);
  const float shade = 0.9f + 0.2f * ValueNoise(8.0f * p.s, 8.0f * p.t, texture.seed);
  return (texture.color + weave * (texture.accent - texture.color)) * shade;
}

Color Outdoors(const Texture& texture, const SurfacePoint& p) {
  const float up = p.t / p.height;
  const float crown = 0.25f + 0.35f * ValueNoise(2.5f * p.s, 0.0f, texture.seed) +
                      0.10f * ValueNoise(11.0f * p.s, 3.0f * p.t, texture.seed + 1);
  if (up > crown) return Color(0.75f, 0.84f, 0.93f) + (1.0f - up) * Color(0.2f, 0.12f, 0.05f);
  const float leaves = ValueNoise(22.0f * p.s, 22.0f * p.t, texture.seed + 2);
  return Color(0.22f, 0.34f, 0.16f) * (0.6f + 0.9f * leaves);
}

// Collects the straight edges of a pattern, clipped to the rectangle.
class EdgeCollector {
 public:
  EdgeCollector(float width, float height) : width_(width), height_(height) {}

  void AddAlongS(float t, float s_low, float s_high) {
    const float low = std::max(s_low, 0.0f), high = std::min(s_high, width_);
    if (t > 0.0f && t < height_ && low < high) edges_.push_back({{low, t}, {high, t}});
  }
  void AddAlongT(float s, float t_low, float t_high) {
    const float low = std::max(t_low, 0.0f), high = std::min(t_high, height_);
    if (s > 0.0f && s < width_ && low < high) edges_.push_back({{s, low}, {s, high}});
  }
  void AddRectangle(float s_low, float s_high, float t_low, float t_high) {
    for (const float t : {t_low, t_high}) AddAlongS(t, s_low, s_high);
    for (const float s : {s_low, s_high}) AddAlongT(s, t_low, t_high);
  }

  float width() const { return width_; }
  float height() const { return height_; }
  const std::vector<LineSegment2>& edges() const { return edges_; }

 private:
  float width_, height_;
  std::vector<LineSegment2> edges_;
};

// Collects both borders of every joint.
void CollectPlanks(const Texture& texture, EdgeCollector* edges) {
  const PlankLayout layout(texture);
  for (int row = 0; static_cast<float>(row) * layout.width < edges->height(); ++row) {
    const float low = static_cast<float>(row) * layout.width, stagger = layout.Stagger(row);
    for (const float t : {low, low + layout.joint}) edges->AddAlongS(t, 0.0f, edges->width());
    for (int plank = 0; static_cast<float>(plank) * layout.length < edges->width() + stagger;
         ++plank) {
      const float s = static_cast<float>(plank) * layout.length - stagger;
      for (const float joint : {s, s + layout.joint}) {
        edges->AddAlongT(joint, low + layout.joint, low + layout.width);
      }
    }
  }
}

void CollectTiles(const Texture& texture, EdgeCollector* edges) {
  const float side = TileSide(texture);
  for (int i = 0; static_cast<float>(i) * side < std::max(edges->width(), edges->height()); ++i) {
    for (const float at : {static_cast<float>(i) * side, static_cast<float>(i) * side + kGrout}) {
      edges->AddAlongS(at, 0.0f, edges->width());
      edges->AddAlongT(at, 0.0f, edges->height());
    }
  }
}

// Collects the sides of the rectangles; later layers may hide parts of them.
void CollectPoster(const Texture& texture, EdgeCollector* edges) {
  for (uint32_t layer = 1; layer <= kPosterLayers; ++layer) {
    const float size = PosterCell(texture, layer);
    for (int row = 0; static_cast<float>(row) * size < edges->height(); ++row) {
      for (int column = 0; static_cast<float>(column) * size < edges->width(); ++column) {
        const std::optional<Figure> figure = FigureOfCell(texture, column, row, layer);
        if (!figure || figure->is_disc) continue;
        const float s = (static_cast<float>(column) + figure->center_s) * size;
        const float t = (static_cast<float>(row) + figure->center_t) * size;
        edges->AddRectangle(s - figure->half_s * size, s + figure->half_s * size,
                            t - figure->half_t * size, t + figure->half_t * size);
      }
    }
  }
}

void CollectRug(EdgeCollector* edges) {
  for (int stripe = 1; stripe <= kRugStripes; ++stripe) {
    const float inset = static_cast<float>(stripe) * kRugStripe;
    edges->AddRectangle(inset, edges->width() - inset, inset, edges->height() - inset);
  }
}

}  // namespace

Eigen::Vector3f EvaluateTexture(const Texture& texture, const SurfacePoint& at) {
  SurfacePoint point = at;
  if (texture.mirrored) point.s = point.width - point.s;
  switch (texture.kind) {
    case TextureKind::kPlain:
      return texture.color;
    case TextureKind::kPlaster:
      return Plaster(texture, point);
    case TextureKind::kWood:
      return Wood(texture, point);
    case TextureKind::kPlanks:
      return Planks(texture, point);
    case TextureKind::kTiles:
      return Tiles(texture, point);
    case TextureKind::kPoster:
      return Poster(texture, point);
    case TextureKind::kBooks:
      return Books(texture, point);
    case TextureKind::kRug:
      return Rug(texture, point);
    case TextureKind::kSpeckle:
      return Speckle(texture, point);
    case TextureKind::kOutdoors:
      return Outdoors(texture, point);
  }
  return texture.color;
}

std::vector<LineSegment2> TextureEdges(const Texture& texture, float width, float height) {
  EdgeCollector edges(width, height);
  if (texture.kind == TextureKind::kPlanks) CollectPlanks(texture, &edges);
  if (texture.kind == TextureKind::kTiles) CollectTiles(texture, &edges);
  if (texture.kind == TextureKind::kPoster) CollectPoster(texture, &edges);
  if (texture.kind == TextureKind::kRug) CollectRug(&edges);
  std::vector<LineSegment2> found = edges.edges();
  if (texture.mirrored) {
    for (LineSegment2& edge : found) {
      edge.start.x() = width - edge.start.x();
      edge.end.x() = width - edge.end.x();
    }
  }
  return found;
}

}  // namespace msc_vo
