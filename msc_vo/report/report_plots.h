// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/report/report.h"
#include "msc_vo/report/trajectory_view.h"

namespace msc_vo {

// The plots of the report, each as one SVG element. Time is in seconds since the first frame; data
// must have a frame.

enum class TrajectorySide { kTop, kSide };

/// Estimate, truth, map lines (top view only), keyframes, frames without a pose, start.
std::string PlotTrajectory(const ReportData& data, const TrajectoryView& view, TrajectorySide side);

/// Position error of every frame that has a truth, centimetres.
std::string PlotError(const ReportData& data);

/// Inlier points and lines of every frame.
std::string PlotInliers(const ReportData& data);

/// Style of the map lines of a Manhattan axis; -1: of none.
std::string LineClass(int axis);

/// The stages of tracking that are stacked, on each other, and the whole; milliseconds.
std::string PlotStages(const ReportData& data);

/// Milliseconds of each keyframe step.
std::string PlotMapping(const ReportData& data);

/// "tracked", "weak", "dropped", "unreadable", "predicted", "lost": for the reader and, prefixed
/// with "status-", the style.
const char* ToString(ReportStatus status);

}  // namespace msc_vo
