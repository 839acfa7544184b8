// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// Features of one image and its depth image.
struct ImageTexture {
  int points = 0;
  int points_with_depth = 0;
  int lines = 0;
  bool planes_determine_pose = false;  ///< their normals span three directions
};

ImageTexture MeasureTexture(const Frame& frame);

/// Whether there are enough points and lines, and what gives poses if there are not.
void AddTextureFindings(const std::vector<ImageTexture>& images, Findings* findings);

}  // namespace msc_vo
