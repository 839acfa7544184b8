// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/depth_confidence.h"

#include <cstdint>
#include <stdexcept>

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

const char* ToString(DepthConfidence confidence) {
  return EnumName<DepthConfidence::kHigh>(confidence, {"low", "medium", "high"});
}

DepthConfidence DepthConfidenceFromName(const std::string& name) {
  if (const auto confidence = EnumFromName<DepthConfidence::kHigh>(name)) return *confidence;
  throw std::invalid_argument("unknown confidence '" + name + "'; known: low, medium, high");
}

int RemoveUncertainDepth(const cv::Mat& confidence, const ConfidenceValues& values,
                         DepthConfidence least, cv::Mat* depth) {
  if (confidence.type() != CV_8UC1 || confidence.size() != depth->size()) {
    throw std::runtime_error(
        "images of confidence need 1 channel of 8 bits and the size of their "
        "depth image, " +
        std::to_string(depth->cols) + "x" + std::to_string(depth->rows));
  }
  const int least_value = least == DepthConfidence::kLow      ? 0
                          : least == DepthConfidence::kMedium ? values.medium
                                                              : values.high;
  int num_removed = 0;
  for (int y = 0; y < depth->rows; ++y) {
    const uint8_t* level = confidence.ptr<uint8_t>(y);
    uint16_t* z = depth->ptr<uint16_t>(y);
    for (int x = 0; x < depth->cols; ++x) {
      if (level[x] > values.high) {
        throw std::runtime_error("the confidence " + std::to_string(level[x]) + " exceeds " +
                                 std::to_string(values.high) + ", the highest of this layout");
      }
      if (level[x] >= least_value || z[x] == 0) continue;
      z[x] = 0;
      ++num_removed;
    }
  }
  return num_removed;
}

}  // namespace msc_vo
