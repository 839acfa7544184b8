// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene_builder.h"

namespace msc_vo {

// Furniture made of boxes. Each piece stands in its own frame: x to its side, y away from the wall
// behind it (or from its middle, where so noted), z up from the floor; metres.

struct Size2 {
  double width = 1.0;
  double height = 1.0;
};

// A wall's stretch along x, from low to high.
struct Span {
  double low = 0.0;
  double high = 0.0;
};

void AddDoor(const Rigid3& frame, const Size2& size, const Eigen::Vector3f& color,
             SceneBuilder* builder);
// `sill` is the height of its lower border.
void AddWindow(const Rigid3& frame, const Size2& size, double sill, SceneBuilder* builder);
// `middle` is the height of its centre.
void AddPicture(const Rigid3& frame, const Size2& size, double middle, SceneBuilder* builder);
void AddBookcase(const Rigid3& frame, const Size2& size, SceneBuilder* builder);
// `columns` doors side by side, of wood or painted in `color`.
void AddCupboard(const Rigid3& frame, const Size2& size, double depth, int columns,
                 const Texture& body, SceneBuilder* builder);
// Kitchen counter: cupboards under a stone top with things on it, tiles on the wall above.
void AddCounter(const Rigid3& frame, double width, SceneBuilder* builder);
void AddSofa(const Rigid3& frame, double width, SceneBuilder* builder);
// Origin in the middle of the piece.
void AddTable(const Rigid3& frame, const Size2& top, double height, SceneBuilder* builder);
void AddChair(const Rigid3& frame, SceneBuilder* builder);
void AddRug(const Rigid3& frame, const Size2& size, SceneBuilder* builder);
void AddCeilingLamp(const Rigid3& frame, const Size2& size, SceneBuilder* builder);
// `count` small boxes that stand on z = height within |x|, |y| of half the area.
void AddClutter(const Rigid3& frame, const Size2& area, double height, int count,
                SceneBuilder* builder);
// Along the spans of a wall, which leave out its doors.
void AddSkirting(const Rigid3& frame, const std::vector<Span>& spans, const Texture& texture,
                 SceneBuilder* builder);

}  // namespace msc_vo
