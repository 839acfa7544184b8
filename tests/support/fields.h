// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

// Iterates over the fields of nested aggregates, so that a test covers fields that are added later.

namespace msc_vo {

// Number of fields of an aggregate: the largest number of values that its braces accept.
struct AnyValue {
  template <typename T>
  operator T() const;
};
template <typename T, typename Fields, typename = void>
constexpr bool kAccepts = false;
template <typename T, size_t... I>
constexpr bool kAccepts<T, std::index_sequence<I...>,
                        std::void_t<decltype(T{(static_cast<void>(I), AnyValue{})...})>> = true;
template <typename T, size_t N = 40>
constexpr size_t NumFields() {
  if constexpr (kAccepts<T, std::make_index_sequence<N>>) {
    return N;
  } else {
    return NumFields<T, N - 1>();
  }
}

// References to the fields of an aggregate. Larger aggregates do not compile: add a line.
#define MSC_VO_TIE_FIELDS(number, ...)                                                \
  template <typename T>                                                               \
  auto TieFields(T& aggregate, std::integral_constant<size_t, number> /* fields */) { \
    auto& [__VA_ARGS__] = aggregate;                                                  \
    return std::tie(__VA_ARGS__);                                                     \
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
#undef MSC_VO_TIE_FIELDS

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
    std::apply([&](auto&... fields) { (VisitValues(&fields, visit), ...); },
               TieFields(*aggregate, std::integral_constant<size_t, NumFields<T>()>()));
  }
}

}  // namespace msc_vo
