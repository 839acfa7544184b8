// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

// PNG, JPEG and other image files of a folder in natural order of their names ("2.png" before
// "10.png"); full paths. Empty if there is no such folder. `prefix` and `suffix` select names by
// their beginning and by the end of their stem.
std::vector<std::string> ListImages(const std::string& folder, const std::string& prefix = "",
                                    const std::string& suffix = "");

// Whether digits in `a` and `b`, read as numbers, and everything else as text, put `a` first.
bool NaturalLess(const std::string& a, const std::string& b);

// The last run of digits in the stem of a path ("frame-000012.color" -> 12).
std::optional<int64_t> FrameNumber(const std::string& path);

// Time that the name of an image tells, seconds: "1.033333.png" is a time, a date of this century
// in any TimeUnit too; other numbers of 16 digits or more count nanoseconds, and the rest count
// frames at kDefaultFrameRate. None: no number.
std::optional<double> StampFromName(const std::string& path);

// Pairs colour and depth images that carry the same frame number; images without a partner are
// left out, with a warning. Time = frame number / kDefaultFrameRate.
void PairByFrameNumber(const std::vector<std::string>& color_paths,
                       const std::vector<std::string>& depth_paths, SequenceIndex* index);

struct ImageSize {
  int width = 0;  // pixels
  int height = 0;
};
// Throws std::runtime_error, naming the file, if it is no image.
ImageSize ReadImageSize(const std::string& path);

}  // namespace msc_vo
