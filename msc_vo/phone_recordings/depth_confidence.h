// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Confidence of a depth measurement, as ARKit gives it for each pixel.
enum class DepthConfidence { kLow, kMedium, kHigh };

/// "low", "medium" or "high".
const char* ToString(DepthConfidence confidence);
/// Throws std::invalid_argument if there is no such confidence.
DepthConfidence DepthConfidenceFromName(const std::string& name);

/// The values of pixels in images of confidence.
struct ConfidenceValues {
  int medium = 1;
  int high = 2;  ///< larger values are refused
};

/// Removes depths whose confidence is below `least`. Returns the number of depths removed.
/// `confidence` is CV_8UC1 of the size of `depth` (CV_16UC1; 0: no measurement). Throws
/// std::runtime_error if type, size or values are others.
int RemoveUncertainDepth(const cv::Mat& confidence, const ConfidenceValues& values,
                         DepthConfidence least, cv::Mat* depth);

}  // namespace msc_vo
