// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

struct RgbdImage;

// What an image has to offer, before any feature is extracted.
struct ImageStatistics {
  double brightness = 0.0;      // mean grey level, 0..255
  double contrast = 0.0;        // standard deviation of the grey level
  double measured_depth = 0.0;  // share of the pixels that have a depth, 0..1
};

// From every eighth pixel of every eighth row: 20 microseconds for 640 x 480.
ImageStatistics MeasureImage(const RgbdImage& image);

}  // namespace msc_vo
