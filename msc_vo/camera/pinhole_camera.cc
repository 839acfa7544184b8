// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/pinhole_camera.h"

#include <algorithm>
#include <locale>
#include <sstream>

namespace msc_vo {

namespace {

constexpr int kMaxSide = 16384;  // pixels
// Focal lengths relative to the longer side of the image: fields of view of 175 and 0.3 degrees.
constexpr double kMinFocalLength = 0.02;
constexpr double kMaxFocalLength = 200.0;
// Largest ratio of the two focal lengths: pixels are nearly square.
constexpr double kMaxAspect = 2.0;

}  // namespace

bool PinholeCamera::IsValid(std::string* error) const {
  const int longer_side = std::max(width, height);
  const double shortest = kMinFocalLength * longer_side;
  const double longest = kMaxFocalLength * longer_side;
  const auto is_within = [error](const char* name, double value, double from, double to) {
    if (value >= from && value <= to) return true;  // false for NaN
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << "camera: " << name << " = " << value << " must be from " << from << " to " << to
         << " pixels" << (*name == 'c' ? "; is it of another image size?" : "");
    *error = text.str();
    return false;
  };
  return is_within("width", width, 1, kMaxSide) && is_within("height", height, 1, kMaxSide) &&
         is_within("fx", fx, shortest, longest) &&
         is_within(fy < 0.0 ? "-fy" : "fy", std::abs(fy), fx / kMaxAspect, fx * kMaxAspect) &&
         is_within("cx", cx, 0.0, width) && is_within("cy", cy, 0.0, height);
}

}  // namespace msc_vo
