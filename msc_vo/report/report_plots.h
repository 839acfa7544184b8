// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/report/report.h"
#include "msc_vo/report/trajectory_view.h"

namespace msc_vo {

// The plots of the report, each as one SVG element. Times are in seconds since the first frame. The
// data must have a frame.

enum class TrajectorySide { kTop, kSide };

/// Estimate, ground truth, keyframes, frames without an estimated pose, start; in the top view also
/// the map lines.
std::string PlotTrajectory(const ReportData& data, const TrajectoryView& view, TrajectorySide side);

/// Position error in millimetres of every frame that has ground truth.
std::string PlotError(const ReportData& data);

/// Inlier points and lines of every frame.
std::string PlotInliers(const ReportData& data);

/// CSS class of the map lines along a Manhattan axis; -1: without axis.
std::string LineClass(int axis);

/// The stages of tracking, stacked, and the whole; milliseconds.
std::string PlotStages(const ReportData& data);

/// Milliseconds of each keyframe step.
std::string PlotMapping(const ReportData& data);

/// "tracked", "weak", "dropped", "unreadable", "predicted", "lost". The CSS class of a status is
/// this name after "status-".
const char* ToString(ReportStatus status);

}  // namespace msc_vo
