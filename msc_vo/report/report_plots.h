// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/report/report.h"
#include "msc_vo/report/trajectory_view.h"

namespace msc_vo {

enum class TrajectorySide { kTop, kSide };

/// An SVG element with estimate, ground truth, keyframes, frames without an estimated pose, start;
/// in the top view also the map lines. The data must have a frame.
std::string PlotTrajectory(const ReportData& data, const TrajectoryView& view, TrajectorySide side);

/// CSS class of the map lines along a Manhattan axis; -1: without axis.
std::string LineClass(int axis);

/// "tracked", "weak", "dropped", "unreadable", "predicted", "lost". The CSS class of a status is
/// this name after "status-".
const char* ToString(ReportStatus status);

}  // namespace msc_vo
