// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

/// Levenshtein distance: the least number of characters to insert, delete or replace to turn one
/// text into the other.
int EditDistance(const std::string& a, const std::string& b);

/// Largest edit distance that still counts as a typing error in `name`.
int MaxTypingErrors(const std::string& name);

/// Returns the element of `names` with the smallest edit distance to the misspelt `name`; none if
/// all are further than MaxTypingErrors().
std::optional<std::string> FindSimilarName(const std::vector<std::string>& names,
                                           const std::string& name);

}  // namespace msc_vo
