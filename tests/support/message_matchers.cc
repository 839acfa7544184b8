// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/message_matchers.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace msc_vo {
namespace {

bool IsDigit(std::string_view text, size_t i) {
  return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
}

bool IsInWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Whether text[i - 1] and text[i] are parts of one word or number.
bool AreJoined(std::string_view text, size_t i) {
  if (i == 0 || i >= text.size()) return false;
  if (text[i - 1] == '.') return i > 1 && IsDigit(text, i - 2) && IsDigit(text, i);
  if (text[i] == '.') return IsDigit(text, i - 1) && IsDigit(text, i + 1);
  return IsInWord(text[i - 1]) && IsInWord(text[i]);
}

bool IsNamed(std::string_view token, std::string_view message) {
  for (size_t i = message.find(token); i != std::string_view::npos;
       i = message.find(token, i + 1)) {
    const bool is_number = IsDigit(token, token.size() - 1);
    if (!AreJoined(message, i) && !(is_number && AreJoined(message, i + token.size()))) return true;
  }
  return false;
}

bool AreNamed(const std::vector<std::string>& tokens, std::string_view message) {
  return std::all_of(tokens.begin(), tokens.end(),
                     [&](const std::string& token) { return IsNamed(token, message); });
}

}  // namespace

bool NamesMatcher::MatchAndExplain(std::string_view message, std::ostream* explanation) const {
  if (in_one_line_) {
    std::istringstream lines{std::string(message)};
    for (std::string line; std::getline(lines, line);) {
      if (AreNamed(tokens_, line)) return true;
    }
  }
  std::string missing;
  for (const std::string& token : tokens_) {
    if (!IsNamed(token, message)) missing += (missing.empty() ? "" : ", ") + token;
  }
  if (explanation != nullptr && !missing.empty()) *explanation << "which does not name " << missing;
  return missing.empty() && !in_one_line_;
}

void NamesMatcher::DescribeTo(std::ostream* description) const {
  *description << (in_one_line_ ? "has a line that names" : "names");
  for (const std::string& token : tokens_) *description << " \"" << token << '"';
}

void NamesMatcher::DescribeNegationTo(std::ostream* description) const {
  *description << "lacks a name: not (";
  DescribeTo(description);
  *description << ")";
}

std::string LineNaming(const std::string& token, const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    if (IsNamed(token, line)) return line;
  }
  return "";
}

}  // namespace msc_vo
