// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/window.h"
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/depth_noise.h"
#include "msc_vo/mapping/landmark_fusion.h"
#include "msc_vo/mapping/scene_axes.h"
#include "msc_vo/mapping/structural_pairs.h"
#include "msc_vo/problems/window_problem.h"

namespace msc_vo {

struct MapperOptions {
  FusionOptions fusion;
  WindowSelectionOptions selection;
  DepthNoiseOptions depth_noise;
  SceneAxesOptions axes;
  StructuralPairOptions pairs;
  WindowOptions window;
  CullingOptions culling;

  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
