// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// NAME=VALUE of --set.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/config/option_list.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static Configuration configuration;
  static const std::vector<Option> options = ListOptions(&configuration);
  const std::string setting(AsText(data, size));
  const size_t equals = setting.find('=');
  if (equals == std::string::npos) return 0;
  const std::string path = setting.substr(0, equals);
  const Option* option = FindByPath(options, path);
  if (!option) {
    Require(!UnknownOptionMessage(options, path, "").empty(), "a message for an unknown option");
    return 0;
  }
  const std::string before = FormatOption(*option);
  std::string expected;
  if (!SetOption(*option, setting.substr(equals + 1), &expected)) {
    Require(!expected.empty(), "the valid values are described");
    Require(FormatOption(*option) == before, "a refused value changes nothing");
    return 0;
  }
  ++num_accepted;
  const std::optional<double> number = NumberOf(*option);
  Require(!number || (std::isfinite(*number) && option->range->Contains(*number)),
          path + " is finite and in its range");
  const std::string value = FormatOption(*option);
  Require(SetOption(*option, value, &expected) && FormatOption(*option) == value,
          path + " is read back as it is written");
  return 0;
}
