// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene_builder.h"

namespace msc_vo {

// Furniture made of boxes. The frame of a piece has x to the side, y away from the wall behind it
// and z up; its origin is on the floor at the wall, centred in x, unless noted otherwise. Metres.

struct Size2 {
  double width = 1.0;
  double height = 1.0;
};

/// An interval along the x axis of a wall.
struct Span {
  double low = 0.0;
  double high = 0.0;
};

void AddDoor(const Rigid3& frame, const Size2& size, const Eigen::Vector3f& color,
             SceneBuilder* builder);
/// `sill` is the height of the lower border.
void AddWindow(const Rigid3& frame, const Size2& size, double sill, SceneBuilder* builder);
/// `middle` is the height of the centre.
void AddPicture(const Rigid3& frame, const Size2& size, double middle, SceneBuilder* builder);
void AddBookcase(const Rigid3& frame, const Size2& size, SceneBuilder* builder);
/// A cupboard with `columns` drawers above as many doors.
void AddCupboard(const Rigid3& frame, const Size2& size, double depth, int columns,
                 const Texture& body, SceneBuilder* builder);
/// A kitchen counter: cupboards, a stone top with small boxes on it, tiles and wall cupboards.
void AddCounter(const Rigid3& frame, double width, SceneBuilder* builder);
void AddSofa(const Rigid3& frame, double width, SceneBuilder* builder);
/// The origin of these is the centre of the piece (of a lamp: on the ceiling).
void AddTable(const Rigid3& frame, const Size2& top, double height, SceneBuilder* builder);
void AddChair(const Rigid3& frame, SceneBuilder* builder);
void AddRug(const Rigid3& frame, const Size2& size, SceneBuilder* builder);
void AddCeilingLamp(const Rigid3& frame, const Size2& size, SceneBuilder* builder);
/// `count` small boxes on the plane z = height, distributed over `area` around the origin.
void AddClutter(const Rigid3& frame, const Size2& area, double height, int count,
                SceneBuilder* builder);
/// Skirting boards along the given spans of a wall, between its doors.
void AddSkirting(const Rigid3& frame, const std::vector<Span>& spans, const Texture& texture,
                 SceneBuilder* builder);

}  // namespace msc_vo
