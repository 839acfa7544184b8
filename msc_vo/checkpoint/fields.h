// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

// The fields of plain structs, which need no list of them: a field that is added takes part.

namespace msc_vo {

namespace internal {

constexpr size_t kMaxFields = 24;

struct AnyValue {
  template <typename T>
  operator T() const;
};
template <typename T, typename Indices, typename = void>
constexpr bool kTakesValues = false;
template <typename T, size_t... I>
constexpr bool kTakesValues<T, std::index_sequence<I...>,
                            std::void_t<decltype(T{(static_cast<void>(I), AnyValue{})...})>> = true;

}  // namespace internal

/// Number of fields of an aggregate, at least 1 and at most kMaxFields: the largest number of
/// values that its braces accept. Does not compile with a field that is an optional matrix of
/// Eigen.
template <typename T, size_t max = internal::kMaxFields + 1>
constexpr size_t NumFields() {
  static_assert(!std::is_empty_v<T>, "a struct without fields");
  if constexpr (internal::kTakesValues<T, std::make_index_sequence<max>>) {
    static_assert(max <= internal::kMaxFields, "more fields than can be counted");
    return max;
  } else {
    return NumFields<T, max - 1>();
  }
}

namespace internal {

// A number of fields that is not that of the struct does not compile.
#define MSC_VO_TIE_FIELDS(count, ...)                                                \
  template <typename T>                                                              \
  auto TieFields(T& aggregate, std::integral_constant<size_t, count> /* fields */) { \
    auto& [__VA_ARGS__] = aggregate;                                                 \
    return std::tie(__VA_ARGS__);                                                    \
  }
MSC_VO_TIE_FIELDS(1, a)
MSC_VO_TIE_FIELDS(2, a, b)
MSC_VO_TIE_FIELDS(3, a, b, c)
MSC_VO_TIE_FIELDS(4, a, b, c, d)
MSC_VO_TIE_FIELDS(5, a, b, c, d, e)
MSC_VO_TIE_FIELDS(6, a, b, c, d, e, f)
MSC_VO_TIE_FIELDS(7, a, b, c, d, e, f, g)
MSC_VO_TIE_FIELDS(8, a, b, c, d, e, f, g, h)
MSC_VO_TIE_FIELDS(9, a, b, c, d, e, f, g, h, i)
MSC_VO_TIE_FIELDS(10, a, b, c, d, e, f, g, h, i, j)
MSC_VO_TIE_FIELDS(11, a, b, c, d, e, f, g, h, i, j, k)
MSC_VO_TIE_FIELDS(12, a, b, c, d, e, f, g, h, i, j, k, l)
MSC_VO_TIE_FIELDS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
MSC_VO_TIE_FIELDS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
MSC_VO_TIE_FIELDS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
MSC_VO_TIE_FIELDS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
MSC_VO_TIE_FIELDS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
MSC_VO_TIE_FIELDS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
MSC_VO_TIE_FIELDS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
MSC_VO_TIE_FIELDS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
MSC_VO_TIE_FIELDS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
MSC_VO_TIE_FIELDS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
MSC_VO_TIE_FIELDS(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
MSC_VO_TIE_FIELDS(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
#undef MSC_VO_TIE_FIELDS

}  // namespace internal

/// Compiles only if T, whose fields are public, has exactly `count` fields.
template <size_t count, typename T>
void CheckFieldCount(const T& value) {
  internal::TieFields(value, std::integral_constant<size_t, count>());
}

/// References to the fields of an aggregate in the order in which they are declared. Does not
/// compile for more than 24: add a line above.
template <typename T>
auto TieFields(T& aggregate) {
  constexpr size_t kCount = NumFields<std::remove_const_t<T>>();
  return internal::TieFields(aggregate, std::integral_constant<size_t, kCount>());
}

/// Whether archives write a T field by field: it is an aggregate, and does not list its state in a
/// function Serialize(Archive&).
template <typename T, typename Archive, typename = void>
constexpr bool kIsPlainStruct = std::is_aggregate_v<T>;
template <typename T, typename Archive>
constexpr bool kIsPlainStruct<
    T, Archive, std::void_t<decltype(std::declval<T&>().Serialize(std::declval<Archive&>()))>> =
    false;

}  // namespace msc_vo
