// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/frame/frame.h"
#include "msc_vo/matching/frame_matches.h"

namespace msc_vo {

/// Gives a depth to lines beyond the range of the sensor that bound a plane, such as the edges at
/// the end of a corridor: that of the plane which the depth image shows beside the line, extended
/// up to it. No other line lies between, and what is on the other side of the line has no depth
/// near it. Lines of `matches` are left as they are, because further depths from the same pixels
/// would be no further measurements. Returns the frame itself if no line gets a depth.
std::shared_ptr<const Frame> MeasureFarLines(const FrameMatches& matches,
                                             std::shared_ptr<const Frame> frame);

}  // namespace msc_vo
