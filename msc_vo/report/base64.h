// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace msc_vo {

/// Base64 of RFC 4648, with padding.
std::string EncodeBase64(const void* bytes, size_t size);

/// Base64 of the values in memory order, which is little-endian on all supported machines.
template <typename T>
std::string EncodeBase64(const std::vector<T>& values) {
  return EncodeBase64(values.data(), values.size() * sizeof(T));
}

}  // namespace msc_vo
