// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/diagnosis/motion_track.h"

namespace msc_vo {

/// Whether the images can be tracked, and how far features move between them compared with the
/// image width, pixels.
void AddFrameMotionFindings(const MotionTrack& track, int width, Findings* findings);

/// Latency of the depth images: the shift between depth and colour edges grows in proportion to the
/// velocity of the image if depth is taken at another time than its stamp says. Not tested in
/// uniform motion, in which a constant shift explains the edges as well.
void AddLatencyFindings(const MotionTrack& track, Findings* findings);

/// Errors of depth relative to the sigmas of the features. At the largest factor that the odometry
/// uses, depth and images contradict each other; that is a warning unless `findings` already has
/// one, which names the cause.
void AddNoiseFindings(const MotionTrack& track, Findings* findings);

}  // namespace msc_vo
