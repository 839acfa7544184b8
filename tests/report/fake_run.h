// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/report/report.h"

namespace msc_vo {

// A run of `num_frames` frames at 30 Hz on a figure of eight in a room whose up is world z. Frames
// 40..49 are weak, 50..54 predicted, 55..59 lost; every 12th is a keyframe. With ground truth and
// map lines: the room from (-3, -2, 0) to (3, 2, 2.6) and a box in it.
ReportData MakeFakeRun(int num_frames);

}  // namespace msc_vo
