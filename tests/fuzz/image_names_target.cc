// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Names of images: their order, frame numbers and times.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/image_name.h"
#include "msc_vo/datasets/named_images.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  const std::string text(AsText(data, size));
  const size_t end = std::min(text.find('\n'), text.size());
  const std::string a = text.substr(0, end), b = text.substr(std::min(end + 1, text.size()));
  Require(!(NaturalLess(a, b) && NaturalLess(b, a)), "an order");
  Require(a == b || NaturalLess(a, b) || NaturalLess(b, a), "an order of different names");
  const NamedImages images = ReadImageNames({a, b});
  for (const double time : images.times) Require(std::isfinite(time), "finite times");
  for (const int64_t number : images.numbers) Require(number >= 0, "frame numbers count from 0");
  Require(images.times.empty() || images.times.size() == images.paths.size(), "a time per image");
  if (!images.times.empty() || !images.numbers.empty()) ++num_accepted;
  return 0;
}
