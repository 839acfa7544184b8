// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_units.h"

#include <cmath>
#include <set>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

std::string DepthUnitsError(const cv::Mat& depth) {
  constexpr int kStride = 8;           // pixels, along rows and columns
  constexpr float kFarthest = 100.0f;  // metres, beyond all surfaces of an indoor scene
  constexpr size_t kEnough = 10;       // one value may stand for pixels without a measurement
  std::set<float> values;
  for (int y = 0; y < depth.rows; y += kStride) {
    const float* row = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; x += kStride) {
      const float z = row[x];
      if (!(z > 0.0f) || !std::isfinite(z)) continue;
      if (z != std::floor(z)) return "";  // metres are no whole numbers
      values.insert(z);
    }
  }
  if (values.size() < kEnough || *values.rbegin() <= kFarthest) return "";
  return FormatText(
      "depth must be in metres, but all values are whole numbers, up to %g: divide them by the "
      "units per metre (1000 for millimetres)",
      static_cast<double>(*values.rbegin()));
}

}  // namespace msc_vo
