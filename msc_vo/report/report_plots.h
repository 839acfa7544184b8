// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <string>

#include "msc_vo/report/report.h"
#include "msc_vo/report/trajectory_view.h"

namespace msc_vo {

enum class TrajectorySide { kTop, kSide };

/// An SVG element with estimate, odometry, ground truth, earlier sessions, keyframes, frames
/// without an estimated pose, start, and where the run was found; in the top view also the map
/// lines. The data must have a frame.
std::string PlotTrajectory(const ReportData& data, const TrajectoryView& view, TrajectorySide side);

/// CSS class of the map lines along a Manhattan axis; -1: without axis.
std::string LineClass(int axis);

/// CSS classes of the trajectory in the submap, and of the earlier session, with this index.
std::string SubMapClass(size_t index);
std::string SessionClass(size_t index);

/// "found in the map: frame 15, 0.50 s". The data must have a found frame.
std::string DescribeFound(const ReportData& data);

/// "tracked", "weak", "dropped", "unreadable", "predicted", "lost". The CSS class of a status is
/// this name after "status-".
const char* ToString(ReportStatus status);

}  // namespace msc_vo
