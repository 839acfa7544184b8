// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/report/report.h"

namespace msc_vo {

/// Alternative text of the SVG element that DrawScene() returns.
extern const char kSceneDescription[];

/// Perspective view of the map lines, coloured by Manhattan axis, with trajectory and keyframes, as
/// one SVG element with a legend. The viewpoint is above and behind the cameras: it looks in their
/// mean viewing direction, or forward in the top view if they have none, and down at an angle. The
/// data must have a frame.
std::string DrawScene(const ReportData& data);

}  // namespace msc_vo
