// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/texture.h"

#include <algorithm>
#include <cmath>

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

// The k-th of four independent bytes of a hash, as a number in [0, 1].
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
  static const Color kColors[] = {
      {0.72f, 0.16f, 0.13f}, {0.15f, 0.28f, 0.52f}, {0.91f, 0.85f, 0.68f}, {0.13f, 0.38f, 0.24f},
      {0.87f, 0.60f, 0.15f}, {0.12f, 0.12f, 0.14f}, {0.94f, 0.94f, 0.92f}, {0.43f, 0.22f, 0.42f},
      {0.45f, 0.62f, 0.70f}, {0.50f, 0.33f, 0.20f}};
  return kColors[(hash >> 4) % 10u];
}

Color Plaster(const Texture& texture, const SurfacePoint& p) {
  // Stains of a metre, 4 % deep: under the threshold of every corner detector.
  return texture.color * (0.98f + 0.04f * (ValueNoise(p.s, p.t, texture.seed) - 0.5f));
}

Color Wood(const Texture& texture, const SurfacePoint& p) {
  const float s = p.s / texture.scale, t = p.t / texture.scale;
  const float bend = 0.6f * ValueNoise(1.5f * s, 4.0f * t, texture.seed);
  const float coarse = ValueNoise(1.2f * s, 14.0f * t + 4.0f * bend, texture.seed + 1);
  const float fine = ValueNoise(6.0f * s, 90.0f * t, texture.seed + 2);
  return texture.color * (0.72f + 0.30f * coarse + 0.14f * fine);
}

Color Planks(const Texture& texture, const SurfacePoint& p) {
  const float width = 0.14f * texture.scale, length = 1.3f * texture.scale;  // metres
  const int row = Floor(p.t / width);
  const float s = p.s + length * Byte(HashCell(row, 77, texture.seed), 1);
  const int plank = Floor(s / length);
  const float t_in = p.t - static_cast<float>(row) * width;
  const float s_in = s - static_cast<float>(plank) * length;
  if (t_in < 0.004f || s_in < 0.004f) return texture.accent;
  const uint32_t hash = HashCell(plank, row, texture.seed);
  const SurfacePoint grain{s + 3.0f * Byte(hash, 1), p.t + 5.0f * Byte(hash, 2), 1.0f, 1.0f};
  return Wood(texture, grain) * (0.80f + 0.35f * Byte(hash, 0));
}

Color Tiles(const Texture& texture, const SurfacePoint& p) {
  const float side = 0.2f * texture.scale, grout = 0.006f;  // metres
  const int column = Floor(p.s / side), row = Floor(p.t / side);
  const float s_in = p.s - static_cast<float>(column) * side;
  const float t_in = p.t - static_cast<float>(row) * side;
  if (s_in < grout || t_in < grout) return texture.accent;
  const uint32_t hash = HashCell(column, row, texture.seed);
  const float stain = ValueNoise(25.0f * p.s, 25.0f * p.t, texture.seed);
  const Color base =
      Byte(hash, 1) < 0.12f ? Color(0.5f * (texture.color + texture.accent)) : texture.color;
  return base * (0.90f + 0.12f * Byte(hash, 0) + 0.06f * (stain - 0.5f));
}

// Draws one figure per lattice cell over `color`; `size` is the cell's side in metres.
void DrawFigures(const Texture& texture, const SurfacePoint& p, float size, uint32_t seed,
                 Color* color) {
  const int column = Floor(p.s / size), row = Floor(p.t / size);
  const uint32_t hash = HashCell(column, row, texture.seed ^ seed);
  if ((hash & 7u) < 2u) return;  // a quarter of the cells stays empty
  const uint32_t shape = HashCell(column, row, texture.seed + 31 * seed);
  const float half_s = 0.14f + 0.30f * Byte(shape, 0), half_t = 0.14f + 0.30f * Byte(shape, 1);
  // The figure stays inside its cell, so that one look-up per layer is enough.
  const float center_s = half_s + (1.0f - 2.0f * half_s) * Byte(shape, 2);
  const float center_t = half_t + (1.0f - 2.0f * half_t) * Byte(shape, 3);
  const float ds = (p.s / size - static_cast<float>(column) - center_s) / half_s;
  const float dt = (p.t / size - static_cast<float>(row) - center_t) / half_t;
  const bool disc = (hash & 64u) != 0;
  const bool inside = disc ? ds * ds + dt * dt < 1.0f : std::max(std::abs(ds), std::abs(dt)) < 1.0f;
  if (inside) *color = Palette(hash >> 8);
}

Color Poster(const Texture& texture, const SurfacePoint& p) {
  Color color = texture.color * (0.85f + 0.2f * ValueNoise(4.0f * p.s, 4.0f * p.t, texture.seed));
  const float size = 0.32f * texture.scale;  // metres; halved by every layer
  DrawFigures(texture, p, size, 1, &color);
  DrawFigures(texture, p, 0.5f * size, 2, &color);
  DrawFigures(texture, p, 0.25f * size, 3, &color);
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

Color Rug(const Texture& texture, const SurfacePoint& p) {
  const float border = std::min(std::min(p.s, p.width - p.s), std::min(p.t, p.height - p.t));
  const float fiber = 0.85f + 0.3f * ValueNoise(150.0f * p.s, 150.0f * p.t, texture.seed);
  if (border < 0.25f) {  // metres: four stripes around the field
    const int stripe = Floor(border / 0.0625f);
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

}  // namespace

Eigen::Vector3f EvaluateTexture(const Texture& texture, const SurfacePoint& point) {
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

}  // namespace msc_vo
