// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/exports/exported_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Occurs in the first kilobyte of every file that FormatNerfstudio() writes.
inline constexpr char kNerfstudioMark[] = "\"generator\": \"msc_vo export\"";

/// An image of nerfstudio's transforms.json.
struct NerfstudioFrame {
  std::string color_path;
  std::string depth_path;  ///< registered to colour; empty: none
  Rigid3 world_from_cam;
};

/// Formats transforms.json: the camera with its lens, and for each frame its files and the pose of
/// the camera in the axes of OpenGL (x right, y up, z backwards). Throws std::runtime_error for a
/// rational lens, which nerfstudio does not know.
std::string FormatNerfstudio(const ExportedCamera& camera,
                             const std::vector<NerfstudioFrame>& frames);

}  // namespace msc_vo
