// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/room_steps.h"

namespace msc_vo {

std::vector<Step> MirrorSteps(std::vector<Step> steps) {
  for (Step& step : steps) {
    step.x = -step.x;
    step.heading = 180.0 - step.heading;
  }
  return steps;
}

std::vector<Step> RoomSteps::EnterByLeft() const {
  return {{-door_, 0.3, 90}, {-door_ + 0.1, 0.85, 90}};
}

std::vector<Step> RoomSteps::PassToRight() const {
  return {{-0.6, 1.15, 95},         {-0.5, 1.2, 90},   {-0.1, 1.35, 45},  {0.35, 1.25, 0},
          {door_ - 0.2, 0.85, -45}, {door_, 0.3, -90}, {door_, -0.5, -90}};
}

std::vector<Step> RoomSteps::TurnBackToLeft() const {
  return {{-0.55, 1.2, 55},           {-0.1, 1.4, 0},     {0.1, 1.1, -50},    {-0.3, 0.85, -90},
          {-door_ + 0.15, 0.55, -90}, {-door_, 0.1, -90}, {-door_, -0.5, -90}};
}

std::vector<Step> RoomSteps::StayAtLeft() const {
  return {{-0.55, 1.2, 60}, {-0.1, 1.35, 20}, {0.2, 1.3, 0}};
}

std::vector<Step> RoomSteps::LookAtBack() const {
  return {{0.4, 1.2, 90}, {-0.1, 1.3, 90}, {-0.4, 1.25, 100}, {-0.5, 1.2, 120}};
}

}  // namespace msc_vo
