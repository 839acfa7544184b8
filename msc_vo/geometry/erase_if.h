// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <vector>

namespace msc_vo {

/// Removes the items for which `predicate` is true; as std::erase_if() of C++20.
template <typename T, typename Predicate>
void EraseIf(std::vector<T>* items, const Predicate& predicate) {
  items->erase(std::remove_if(items->begin(), items->end(), predicate), items->end());
}

}  // namespace msc_vo
