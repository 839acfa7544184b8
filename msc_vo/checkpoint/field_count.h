// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

namespace internal {

template <typename T>
constexpr bool kNever = false;

}  // namespace internal

/// Compiles only if T, whose fields are public, has exactly `count` fields: a structured binding
/// must name all of them. A field that is added to a type but not to its list is thus an error.
template <int count, typename T>
void CheckFieldCount(const T& value) {
  if constexpr (count == 1) {
    [[maybe_unused]] const auto& [f1] = value;
  } else if constexpr (count == 2) {
    [[maybe_unused]] const auto& [f1, f2] = value;
  } else if constexpr (count == 3) {
    [[maybe_unused]] const auto& [f1, f2, f3] = value;
  } else if constexpr (count == 4) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4] = value;
  } else if constexpr (count == 5) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5] = value;
  } else if constexpr (count == 6) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6] = value;
  } else if constexpr (count == 7) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7] = value;
  } else if constexpr (count == 8) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8] = value;
  } else if constexpr (count == 9) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9] = value;
  } else if constexpr (count == 10) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10] = value;
  } else if constexpr (count == 11) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11] = value;
  } else if constexpr (count == 12) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12] = value;
  } else if constexpr (count == 13) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13] = value;
  } else if constexpr (count == 14) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14] =
        value;
  } else if constexpr (count == 15) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14,
                                  f15] = value;
  } else if constexpr (count == 16) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16] = value;
  } else if constexpr (count == 17) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16, f17] = value;
  } else if constexpr (count == 18) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16, f17, f18] = value;
  } else if constexpr (count == 19) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16, f17, f18, f19] = value;
  } else if constexpr (count == 20) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16, f17, f18, f19, f20] = value;
  } else if constexpr (count == 21) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16, f17, f18, f19, f20, f21] = value;
  } else if constexpr (count == 22) {
    [[maybe_unused]] const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15,
                                  f16, f17, f18, f19, f20, f21, f22] = value;
  } else {
    static_assert(internal::kNever<T>, "add a case for this number of fields");
  }
}

}  // namespace msc_vo
