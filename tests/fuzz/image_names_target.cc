// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Names of images: their order, frame numbers and time stamps.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/image_name.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  const std::string text(AsText(data, size));
  const size_t end = std::min(text.find('\n'), text.size());
  const std::string a = text.substr(0, end), b = text.substr(std::min(end + 1, text.size()));
  Require(!(NaturalLess(a, b) && NaturalLess(b, a)), "an order");
  Require(a == b || NaturalLess(a, b) || NaturalLess(b, a), "an order of different names");
  for (const std::string& name : {a, b}) {
    const std::optional<int64_t> number = FrameNumber(name);
    Require(!number || *number >= 0, "frame numbers count from 0");
    const std::optional<double> stamp = StampFromName(name);
    Require(!stamp || std::isfinite(*stamp), "finite stamps");
    if (stamp) ++num_accepted;
  }
  return 0;
}
