// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Options as text: parsing, formatting, and suggestions for unknown names.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "msc_vo/config/option_list.h"
#include "msc_vo/text/similar_name.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::optional<bool> ParseBool(const std::string& text) {
  for (const char* yes : {"true", "True", "yes", "on"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"false", "False", "no", "off"}) {
    if (text == no) return false;
  }
  return std::nullopt;
}

std::optional<double> ParseFinite(const std::string& text) {
  const std::optional<double> value = ParseNumber(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> ParseInt(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

// Parses "[1, 2, 3]" or "1,2,3"; none unless it has `size` finite numbers.
std::optional<std::vector<double>> ParseList(std::string text, size_t size) {
  text = Trimmed(text);
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']') {
    text = text.substr(1, text.size() - 2);
  }
  std::vector<double> values;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const std::optional<double> value = ParseFinite(Trimmed(item));
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (values.size() != size) return std::nullopt;
  return values;
}

// Assigns the parsed value; returns false if there is none.
template <typename Target, typename T>
bool Assign(const std::optional<T>& parsed, Target* target) {
  if (parsed) *target = *parsed;
  return parsed.has_value();
}

// The same for a number, which must be in its range.
template <typename Target, typename T>
bool Assign(const std::optional<T>& parsed, const std::optional<Range>& range, Target* target) {
  if (parsed && range && !range->Contains(*parsed)) return false;
  return Assign(parsed, target);
}

std::string FormatList(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + FormatNumber(value);
  return text + "]";
}

struct Setter {
  const std::string& text;
  const std::optional<Range>& range;
  std::string* expected;

  bool operator()(bool* value) const {
    *expected = "true or false";
    return Assign(ParseBool(text), value);
  }
  bool operator()(int* value) const { return SetInt(value); }
  bool operator()(std::optional<int>* value) const { return SetInt(value); }
  bool operator()(double* value) const { return SetDouble(value); }
  bool operator()(std::optional<double>* value) const { return SetDouble(value); }
  bool operator()(std::string* value) const {
    *value = text;
    return true;
  }
  bool operator()(const NumberList& list) const {
    *expected = "a list of " + std::to_string(list.size) + " numbers, like " + Example(list.size);
    return Assign(ParseList(text, list.size), list.values);
  }
  bool operator()(const Choice& choice) const {
    *expected = "one of";
    for (const std::string& name : choice.names) *expected += " " + name;
    const auto found = std::find(choice.names.begin(), choice.names.end(), text);
    if (found == choice.names.end()) return false;
    choice.set(static_cast<int>(found - choice.names.begin()));
    return true;
  }

 private:
  static std::string Example(size_t size) {
    const std::vector<double> zeros(size, 0.0);
    return FormatList(zeros);
  }
  template <typename Target>
  bool SetInt(Target* value) const {
    *expected = "a whole number" + RangeText();
    return Assign(ParseInt(text), range, value);
  }
  template <typename Target>
  bool SetDouble(Target* value) const {
    *expected = "a number" + RangeText();
    return Assign(ParseFinite(text), range, value);
  }
  std::string RangeText() const {
    return range && range->IsBounded() ? " from " + ToString(*range) : "";
  }
};

struct Formatter {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const double* value) const { return FormatNumber(*value); }
  std::string operator()(const std::string* value) const { return *value; }
  std::string operator()(const std::optional<int>* value) const {
    return *value ? std::to_string(**value) : "";
  }
  std::string operator()(const std::optional<double>* value) const {
    return *value ? FormatNumber(**value) : "";
  }
  std::string operator()(const NumberList& list) const {
    return list.values->empty() ? "" : FormatList(*list.values);
  }
  std::string operator()(const Choice& choice) const { return choice.names.at(choice.get()); }
};

std::string LastPart(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// The option whose path is most similar to `path`; null if none is similar.
const Option* FindSimilar(const std::vector<Option>& options, const std::string& path) {
  const Option* nearest = nullptr;
  int smallest = MaxTypingErrors(LastPart(path)) + 1;
  int smallest_of_path = 0;  // decides ties
  for (const Option& option : options) {
    // A correct name in a wrong section counts as one error.
    const int of_path = EditDistance(path, option.path);
    const int distance = std::min(of_path, EditDistance(LastPart(path), LastPart(option.path)) + 1);
    if (distance < smallest || (distance == smallest && (!nearest || of_path < smallest_of_path))) {
      smallest = distance;
      smallest_of_path = of_path;
      nearest = &option;
    }
  }
  return nearest;
}

}  // namespace

bool SetOption(const Option& option, const std::string& text, std::string* expected) {
  return std::visit(Setter{text, option.range, expected}, option.value);
}

std::string FormatOption(const Option& option) { return std::visit(Formatter{}, option.value); }

std::string FormatValidValues(const Option& option) {
  if (const Choice* choice = std::get_if<Choice>(&option.value)) return Joined(choice->names, ", ");
  if (const NumberList* list = std::get_if<NumberList>(&option.value)) {
    return std::to_string(list->size) + " numbers";
  }
  if (std::holds_alternative<bool*>(option.value)) return "true, false";
  return option.range ? ToString(*option.range) : "";
}

std::vector<OptionText> ChangedOptions(const Configuration& configuration) {
  Configuration given = configuration;
  Configuration defaults;
  const std::vector<Option> default_options = ListOptions(&defaults);
  std::vector<OptionText> changed;
  const std::vector<Option> options = ListOptions(&given);
  for (size_t i = 0; i < options.size(); ++i) {
    const std::string value = FormatOption(options[i]);
    if (value != FormatOption(default_options[i])) changed.push_back({options[i].path, value});
  }
  return changed;
}

const Option* FindByPath(const std::vector<Option>& options, const std::string& path) {
  const auto option = std::find_if(options.begin(), options.end(),
                                   [&](const Option& known) { return known.path == path; });
  return option == options.end() ? nullptr : &*option;
}

std::string UnknownOptionMessage(const std::vector<Option>& options, const std::string& path,
                                 const std::string& advice) {
  const Option* similar = FindSimilar(options, path);
  return "unknown option '" + path + "'; " +
         (similar ? "did you mean '" + similar->path + "'?" : advice);
}

}  // namespace msc_vo
