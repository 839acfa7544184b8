// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/synthetic/scene/room_module.h"
#include "msc_vo/synthetic/scene/tour.h"

namespace msc_vo {

/// Reflects steps at x = 0.
std::vector<Step> MirrorSteps(std::vector<Step> steps);

/// Parts of walks through a room with two doors, in its frame. A room is entered with a view of its
/// back wall (90 degrees) and left with a view of the corridor (-90 degrees).
class RoomSteps {
 public:
  explicit RoomSteps(const RoomPlan& plan) : door_(plan.door) {}

  std::vector<Step> EnterByLeft() const;
  /// From the middle out of the right door, turning clockwise.
  std::vector<Step> PassToRight() const;
  /// From the left door around in the room and out of the left door, turning clockwise.
  std::vector<Step> TurnBackToLeft() const;
  /// From the left door to the middle, where the walk ends.
  std::vector<Step> StayAtLeft() const;
  /// From the right door to the middle with a view of the back wall, where the walk ends.
  std::vector<Step> LookAtBack() const;

 private:
  double door_;
};

}  // namespace msc_vo
