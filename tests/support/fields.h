// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <type_traits>

#include "msc_vo/checkpoint/fields.h"

// Iterates over the fields of nested aggregates, so that a test covers fields that are added later.

namespace msc_vo {

template <typename T>
constexpr bool kIsOptional = false;
template <typename T>
constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T>
constexpr bool kIsValue = std::is_arithmetic_v<T> || std::is_enum_v<T> || kIsOptional<T> ||
                          std::is_same_v<T, std::string>;

// Calls `visit` with a pointer to every value in an aggregate and the aggregates that it contains.
template <typename T, typename Visitor>
void VisitValues(T* aggregate, const Visitor& visit) {
  if constexpr (kIsValue<T>) {
    visit(aggregate);
  } else {
    std::apply([&](auto&... fields) { (VisitValues(&fields, visit), ...); }, TieFields(*aggregate));
  }
}

}  // namespace msc_vo
