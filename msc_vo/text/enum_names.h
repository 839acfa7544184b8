// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

/// Returns the name of a value of an enumeration that counts from 0 to `Last`. `names`: those of
/// all values, in their order.
template <auto Last, size_t Count>
const char* EnumName(decltype(Last) value, const char* const (&names)[Count]) {
  static_assert(Count == static_cast<size_t>(Last) + 1, "every value needs a name");
  const auto index = static_cast<size_t>(value);
  return index < Count ? names[index] : "unknown";
}

/// Returns the names that ToString() gives to the values of an enumeration from 0 to `Last`.
template <auto Last>
std::vector<std::string> EnumNames() {
  std::vector<std::string> names;
  for (size_t i = 0; i <= static_cast<size_t>(Last); ++i) {
    names.emplace_back(ToString(static_cast<decltype(Last)>(i)));
  }
  return names;
}

/// Returns the value of an enumeration that counts from 0 to `Last` whose ToString() is `name`;
/// std::nullopt if there is none.
template <auto Last>
std::optional<decltype(Last)> EnumFromName(const std::string& name) {
  for (size_t i = 0; i <= static_cast<size_t>(Last); ++i) {
    const auto value = static_cast<decltype(Last)>(i);
    if (name == ToString(value)) return value;
  }
  return std::nullopt;
}

}  // namespace msc_vo
