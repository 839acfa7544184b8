// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace msc_vo {

/// Checksum of no bytes.
constexpr uint64_t kEmptyChecksum = 0x6d73635f766f3031;

/// Checksum that detects damage, not forgery: it differs if any one word of eight bytes differs.
/// `previous` is the checksum of the bytes before, whose number must be a multiple of eight.
uint64_t Checksum(std::string_view bytes, uint64_t previous = kEmptyChecksum);
/// The checksum of the bytes as 16 hexadecimal digits.
std::string ChecksumText(std::string_view bytes);

}  // namespace msc_vo
