// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace msc_vo {

// See Names() and LineNames().
class NamesMatcher {
 public:
  using is_gtest_matcher = void;

  NamesMatcher(std::vector<std::string> tokens, bool in_one_line)
      : tokens_(std::move(tokens)), in_one_line_(in_one_line) {}

  bool MatchAndExplain(std::string_view message, std::ostream* explanation) const;
  void DescribeTo(std::ostream* description) const;
  void DescribeNegationTo(std::ostream* description) const;

 private:
  std::vector<std::string> tokens_;
  bool in_one_line_;
};

// Matches a message that contains each token, in any order: a position "camera.txt:2", an option, a
// value, or the one word that a concept is called by. A test so written survives other wording. A
// token is not found inside a longer word or number: "5" is not in "25", "0.5", or "5.5", "scale"
// not in "rescale", but in "scaled".
template <typename... Token>
NamesMatcher Names(const Token&... tokens) {
  return {{std::string(tokens)...}, false};
}

// Matches a text with a line that contains each token: for the output of a command, where numbers
// occur in many lines.
template <typename... Token>
NamesMatcher LineNames(const Token&... tokens) {
  return {{std::string(tokens)...}, true};
}

// The first line of a text that names a token; empty if none does.
std::string LineNaming(const std::string& token, const std::string& text);

}  // namespace msc_vo
