// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Describes the error of a depth image (CV_32FC1) that is not in metres but in raw units of a
/// sensor: all of its depths are whole numbers, and too large for metres. Empty without an error.
std::string DepthUnitsError(const cv::Mat& depth);

}  // namespace msc_vo
