// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Opens a recording of OpenNI2 (.oni). The time stamps of all frames are read, which decodes the
/// file once; frames are read on demand. Mirrored recordings are mirrored back. The calibration is
/// nominal, from the field of view that the recording names. Colour and depth are paired as
/// PairByTime() does. Throws std::runtime_error naming the file and the fix, also if there is no
/// OpenNI2.
SequenceIndex OpenOniFile(const std::string& path);

/// Opens a live camera of OpenNI2; `uri` is that of the device, empty: the first one. Depth is
/// registered to colour, both are synchronised and not mirrored if the device can do so. Time
/// stamps are seconds since 1970. The calibration is nominal, from the field of view. Throws
/// std::runtime_error if there is no such camera or no OpenNI2.
SequenceIndex OpenOpenNiCamera(const std::string& uri = "");

}  // namespace msc_vo
