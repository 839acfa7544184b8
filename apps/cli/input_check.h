// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// Checks a sequence before its images are used, see CheckSequenceQuickly(). Returns the warnings.
/// Throws std::runtime_error with the first error, with which no result is right; `advice` is added
/// to its message.
std::vector<std::string> CheckInput(const RgbdDecoder& decoder, const std::string& advice = "");

}  // namespace msc_vo
