// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

// Number of letters to insert, delete or replace to turn one text into the other (Levenshtein).
int EditDistance(const std::string& a, const std::string& b);

// More differences than this make `name` another word, not a typing error.
int MaxTypingErrors(const std::string& name);

// The one of `names` that was probably meant by `name`; none if it is like none of them.
std::optional<std::string> FindSimilarName(const std::vector<std::string>& names,
                                           const std::string& name);

}  // namespace msc_vo
