// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/furniture.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

using Vec = Eigen::Vector3d;
using Color = Eigen::Vector3f;

const Color kOak(0.62f, 0.44f, 0.27f);
const Color kPine(0.80f, 0.63f, 0.42f);
const Color kWalnut(0.38f, 0.25f, 0.16f);
const Color kWhite(0.88f, 0.88f, 0.85f);
const Color kSteel(0.45f, 0.46f, 0.48f);
const Color kDark(0.10f, 0.09f, 0.09f);

Color RandomWood(SceneBuilder* builder) {
  const Color woods[] = {kOak, kPine, kWalnut};
  return woods[builder->random().Index(3)];
}

Color RandomFabric(SceneBuilder* builder) {
  Random& random = builder->random();
  return Color(static_cast<float>(random.Uniform(0.25, 0.7)),
               static_cast<float>(random.Uniform(0.25, 0.6)),
               static_cast<float>(random.Uniform(0.25, 0.6)));
}

// Translates a frame along its own axes.
Rigid3 Shifted(const Rigid3& frame, const Vec& by) { return frame * Rigid3({1, 0, 0, 0}, by); }

}  // namespace

void AddDoor(const Rigid3& frame, const Size2& size, const Color& color, SceneBuilder* builder) {
  const double half = 0.5 * size.width, top = size.height;
  const double post = 0.08;  // width of the frame around the leaf
  const Texture posts = builder->NewTexture(TextureKind::kPlain, 0.92f * color);
  const Texture leaf = builder->NewTexture(TextureKind::kPlain, color);
  const Texture panel = builder->NewTexture(TextureKind::kPlain, 1.06f * color);
  const Texture handle = builder->NewTexture(TextureKind::kPlain, kSteel);
  builder->AddBox(frame, {-half - post, 0, 0}, {-half, 0.05, top + post}, posts);
  builder->AddBox(frame, {half, 0, 0}, {half + post, 0.05, top + post}, posts);
  builder->AddBox(frame, {-half, 0, top}, {half, 0.05, top + post}, posts);
  builder->AddBox(frame, {-half, 0, 0}, {half, 0.015, top}, leaf);
  builder->AddBox(frame, {-half + 0.14, 0.015, 0.2}, {half - 0.14, 0.03, 0.85}, panel);
  builder->AddBox(frame, {-half + 0.14, 0.015, 1.1}, {half - 0.14, 0.03, top - 0.18}, panel);
  builder->AddBox(frame, {half - 0.1, 0.015, 0.93}, {half - 0.06, 0.025, 1.07}, handle);
  builder->AddBox(frame, {half - 0.19, 0.06, 1.0}, {half - 0.07, 0.075, 1.02}, handle);
}

void AddWindow(const Rigid3& frame, const Size2& size, double sill, SceneBuilder* builder) {
  const double half = 0.5 * size.width, top = sill + size.height;
  const double bar = 0.06;  // width of the frame and of the bars between the panes
  const Texture white = builder->NewTexture(TextureKind::kPlain, kWhite);
  const Texture view = builder->NewTexture(TextureKind::kOutdoors, kWhite);
  builder->AddBox(frame, {-half, 0, sill}, {half, 0.005, top}, view, &view);
  for (const double x : {-half, -0.5 * bar, half - bar}) {
    builder->AddBox(frame, {x, 0.005, sill}, {x + bar, 0.06, top}, white);
  }
  for (const double z : {sill, sill + 0.68 * size.height, top - bar}) {
    builder->AddBox(frame, {-half + bar, 0.005, z}, {-0.5 * bar, 0.05, z + bar}, white);
    builder->AddBox(frame, {0.5 * bar, 0.005, z}, {half - bar, 0.05, z + bar}, white);
  }
  builder->AddBox(frame, {-half - 0.08, 0, sill - 0.04}, {half + 0.08, 0.2, sill}, white);
}

void AddPicture(const Rigid3& frame, const Size2& size, double middle, SceneBuilder* builder) {
  const double half = 0.5 * size.width, low = middle - 0.5 * size.height;
  const double high = middle + 0.5 * size.height, bar = 0.035;
  const Texture rim =
      builder->NewTexture(TextureKind::kPlain, builder->random().Uniform() < 0.5 ? kDark : kPine);
  const Texture paper = builder->NewTexture(TextureKind::kPoster, {0.85f, 0.82f, 0.74f}, kDark,
                                            static_cast<float>(size.width));
  builder->AddBox(frame, {-half, 0, low}, {half, 0.01, high}, rim, &paper);
  builder->AddBox(frame, {-half - bar, 0, low}, {-half, 0.03, high}, rim);
  builder->AddBox(frame, {half, 0, low}, {half + bar, 0.03, high}, rim);
  builder->AddBox(frame, {-half - bar, 0, low - bar}, {half + bar, 0.03, low}, rim);
  builder->AddBox(frame, {-half - bar, 0, high}, {half + bar, 0.03, high + bar}, rim);
}

void AddBookcase(const Rigid3& frame, const Size2& size, SceneBuilder* builder) {
  const double half = 0.5 * size.width, depth = 0.3, board = 0.025;
  const Texture wood = builder->NewTexture(TextureKind::kWood, RandomWood(builder));
  builder->AddBox(frame, {-half, 0, 0}, {-half + board, depth, size.height}, wood);
  builder->AddBox(frame, {half - board, 0, 0}, {half, depth, size.height}, wood);
  builder->AddBox(frame, {-half + board, 0, size.height - board},
                  {half - board, depth, size.height}, wood);
  const int rows = std::max(1, static_cast<int>(std::round(size.height / 0.36)));
  const double pitch = (size.height - board) / rows;
  for (int row = 0; row < rows; ++row) {
    const double z = row * pitch;
    builder->AddBox(frame, {-half + board, 0, z}, {half - board, depth, z + board}, wood);
    const Texture books = builder->NewTexture(TextureKind::kBooks, kWhite, kDark);
    const double back = builder->random().Uniform(0.18, 0.25);  // depth of the books
    builder->AddBox(frame, {-half + board, 0, z + board}, {half - board, back, z + pitch}, wood,
                    &books);
  }
}

void AddCupboard(const Rigid3& frame, const Size2& size, double depth, int columns,
                 const Texture& body, SceneBuilder* builder) {
  const double half = 0.5 * size.width, column = size.width / columns;
  const Texture knob = builder->NewTexture(TextureKind::kPlain, kSteel);
  builder->AddBox(frame, {-half, 0, 0}, {half, depth, size.height}, body);
  for (int i = 0; i < columns; ++i) {
    const double x = -half + i * column;
    Texture door = body;
    door.seed += static_cast<uint32_t>(i + 1);
    // A drawer above a door, 2 cm in front of the body, with a visible gap between them.
    const double split = size.height - 0.22;
    builder->AddBox(frame, {x + 0.01, depth, 0.08}, {x + column - 0.01, depth + 0.02, split - 0.01},
                    door);
    builder->AddBox(frame, {x + 0.01, depth, split + 0.01},
                    {x + column - 0.01, depth + 0.02, size.height - 0.02}, door);
    const double middle = x + 0.5 * column;
    builder->AddBox(frame, {middle - 0.06, depth + 0.02, split + 0.09},
                    {middle + 0.06, depth + 0.04, split + 0.105}, knob);
    builder->AddBox(frame, {x + column - 0.08, depth + 0.02, split - 0.2},
                    {x + column - 0.06, depth + 0.04, split - 0.06}, knob);
  }
}

void AddCounter(const Rigid3& frame, double width, SceneBuilder* builder) {
  const double half = 0.5 * width, depth = 0.55;
  const Texture front = builder->NewTexture(TextureKind::kWood, RandomWood(builder), kDark, 1.5f);
  const Texture stone =
      builder->NewTexture(TextureKind::kSpeckle, {0.30f, 0.31f, 0.33f}, {0.75f, 0.75f, 0.72f});
  const Texture tiles =
      builder->NewTexture(TextureKind::kTiles, {0.82f, 0.84f, 0.82f}, {0.42f, 0.47f, 0.50f}, 0.6f);
  AddCupboard(frame, {width, 0.86}, depth, std::max(1, static_cast<int>(width / 0.55)), front,
              builder);
  builder->AddBox(frame, {-half - 0.02, 0, 0.86}, {half + 0.02, depth + 0.04, 0.9}, stone);
  builder->AddBox(frame, {-half, 0, 0.9}, {half, 0.012, 1.42}, tiles, &tiles);
  AddClutter(Shifted(frame, {0, 0.5 * depth, 0}), {width - 0.3, depth - 0.2}, 0.9, 7, builder);
  const Rigid3 upper = Shifted(frame, {0, 0, 1.42});
  AddCupboard(upper, {width, 0.65}, 0.32, std::max(1, static_cast<int>(width / 0.55)), front,
              builder);
}

void AddSofa(const Rigid3& frame, double width, SceneBuilder* builder) {
  const double half = 0.5 * width;
  const Color color = RandomFabric(builder);
  const Texture fabric = builder->NewTexture(TextureKind::kSpeckle, color, 0.4f * color, 1.2f);
  builder->AddBox(frame, {-half, 0.02, 0.06}, {half, 0.25, 0.85}, fabric);
  builder->AddBox(frame, {-half, 0.25, 0.06}, {-half + 0.2, 0.9, 0.62}, fabric);
  builder->AddBox(frame, {half - 0.2, 0.25, 0.06}, {half, 0.9, 0.62}, fabric);
  builder->AddBox(frame, {-half + 0.2, 0.25, 0.06}, {half - 0.2, 0.88, 0.42}, fabric);
  for (int i = 0; i < 3; ++i) {
    const double x = -half + 0.3 + i * (width - 0.95) / 2.0;
    const Texture cushion =
        builder->NewTexture(TextureKind::kPoster, RandomFabric(builder), kDark, 0.5f);
    builder->AddBox(frame, {x, 0.25, 0.42}, {x + 0.38, 0.37, 0.78}, cushion);
  }
}

void AddTable(const Rigid3& frame, const Size2& top, double height, SceneBuilder* builder) {
  const double x = 0.5 * top.width, y = 0.5 * top.height, leg = 0.06;
  const Texture wood = builder->NewTexture(TextureKind::kWood, RandomWood(builder));
  builder->AddBox(frame, {-x, -y, height - 0.04}, {x, y, height}, wood);
  for (const double lx : {-x + 0.03, x - 0.03 - leg}) {
    for (const double ly : {-y + 0.03, y - 0.03 - leg}) {
      builder->AddBox(frame, {lx, ly, 0}, {lx + leg, ly + leg, height - 0.04}, wood);
    }
  }
  AddClutter(frame, {top.width - 0.3, top.height - 0.3}, height, 6, builder);
}

void AddChair(const Rigid3& frame, SceneBuilder* builder) {
  const double half = 0.21, leg = 0.04, seat = 0.45;
  const Texture wood = builder->NewTexture(TextureKind::kWood, RandomWood(builder));
  builder->AddBox(frame, {-half, -half, seat - 0.04}, {half, half, seat}, wood);
  for (const double x : {-half, half - leg}) {
    builder->AddBox(frame, {x, half - leg, 0}, {x + leg, half, seat - 0.04}, wood);
    builder->AddBox(frame, {x, -half, 0}, {x + leg, -half + leg, 0.9}, wood);
  }
  for (const double z : {0.55, 0.68, 0.81}) {
    builder->AddBox(frame, {-half + leg, -half, z}, {half - leg, -half + 0.02, z + 0.07}, wood);
  }
}

void AddRug(const Rigid3& frame, const Size2& size, SceneBuilder* builder) {
  const double x = 0.5 * size.width, y = 0.5 * size.height;
  const Texture rug =
      builder->NewTexture(TextureKind::kRug, RandomFabric(builder), {0.30f, 0.10f, 0.10f});
  builder->AddBox(frame, {-x, -y, 0}, {x, y, 0.008}, rug);
}

void AddCeilingLamp(const Rigid3& frame, const Size2& size, SceneBuilder* builder) {
  const double x = 0.5 * size.width, y = 0.5 * size.height;
  // Brighter than white, because the lamp emits light.
  const Texture glow = builder->NewTexture(TextureKind::kPlain, {2.2f, 2.2f, 2.0f});
  builder->AddBox(frame, {-x, -y, -0.08}, {x, y, 0}, glow);
}

void AddClutter(const Rigid3& frame, const Size2& area, double height, int count,
                SceneBuilder* builder) {
  Random& random = builder->random();
  for (int i = 0; i < count; ++i) {
    // Each box has its own strip of the area, so boxes do not intersect.
    const double strip = area.width / count;
    const double x = -0.5 * area.width + (i + 0.5) * strip;
    const double y = random.Uniform(-0.3, 0.3) * area.height;
    const double half_x = random.Uniform(0.25, 0.42) * strip, half_y = random.Uniform(0.05, 0.1);
    const double tall = random.Uniform(0.04, 0.3);
    const bool printed = random.Uniform() < 0.6;
    const Texture texture =
        printed ? builder->NewTexture(TextureKind::kPoster, RandomFabric(builder), kDark, 0.35f)
                : builder->NewTexture(TextureKind::kPlain, 1.2f * RandomFabric(builder));
    builder->AddBox(frame, {x - half_x, y - half_y, height},
                    {x + half_x, y + half_y, height + tall}, texture);
  }
}

void AddSkirting(const Rigid3& frame, const std::vector<Span>& spans, const Texture& texture,
                 SceneBuilder* builder) {
  for (const Span& span : spans) {
    builder->AddBox(frame, {span.low, 0, 0}, {span.high, 0.015, 0.09}, texture);
  }
}

}  // namespace msc_vo
