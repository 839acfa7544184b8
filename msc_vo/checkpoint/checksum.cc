// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/checksum.h"

#include <algorithm>
#include <cstring>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

uint64_t Checksum(std::string_view bytes, uint64_t previous) {
  uint64_t checksum = previous;
  while (!bytes.empty()) {
    uint64_t word = 0;
    const size_t size = std::min(bytes.size(), sizeof(word));
    std::memcpy(&word, bytes.data(), size);
    bytes.remove_prefix(size);
    // Each step is invertible, so that a difference in one word never vanishes.
    checksum = (checksum ^ word) * 0x9e3779b97f4a7c15;
    checksum ^= checksum >> 29;
  }
  return checksum;
}

std::string ChecksumText(std::string_view bytes) {
  return FormatText("%016llx", static_cast<unsigned long long>(Checksum(bytes)));
}

}  // namespace msc_vo
