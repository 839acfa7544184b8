// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// Features of one image.
struct Texture {
  int points = 0;
  int points_with_depth = 0;
  int lines = 0;
};

Texture MeasureTexture(const Frame& frame);

/// Whether there are enough points and lines, and which mode suits the scene.
void AddTextureFindings(const std::vector<Texture>& images, Findings* findings);

}  // namespace msc_vo
