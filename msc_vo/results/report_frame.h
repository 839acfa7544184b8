// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/report/report.h"

namespace msc_vo {

/// Converts a frame for the report: its pose in the world of the odometry, stage times in the order
/// of ReportStages(), no position error.
ReportFrame MakeReportFrame(const FrameResult& frame);
std::vector<ReportFrame> ReportFrames(const std::vector<FrameResult>& frames);

/// Stages of tracking in order of time. Points, lines and depth are parts of "features".
std::vector<ReportStage> ReportStages();

}  // namespace msc_vo
