// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/report/report.h"

namespace msc_vo {

// A run of `num_frames` frames at 30 Hz on a figure of eight in a room whose up is world z: frames
// 40..49 weak, 50..54 predicted, 55..59 lost, keyframes every 12 frames, with truth and lines.
ReportData MakeFakeRun(int num_frames);

}  // namespace msc_vo
