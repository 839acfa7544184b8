// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// Checks a sequence before a run. Returns the warnings. Throws std::runtime_error with the first
/// error, with which no run can succeed, and the `advice`.
std::vector<std::string> CheckBeforeRun(const RgbdDecoder& decoder, const std::string& advice);

}  // namespace msc_vo
