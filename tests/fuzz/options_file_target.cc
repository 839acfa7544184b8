// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A configuration: YAML, or the settings of ORB-SLAM.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/config/options_file.h"

namespace msc_vo {
namespace {

void CheckOptions(Configuration* configuration) {
  for (const Option& option : ListOptions(configuration)) {
    const std::optional<double> number = NumberOf(option);
    const bool is_camera = option.path.rfind("camera.", 0) == 0;
    Require(!number || (is_camera || option.range->Contains(*number)),
            option.path + " is in its range");
  }
  std::string error;
  Require(configuration->odometry.IsValid(&error) || !error.empty(), "an error is described");
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  const std::string path = folder.Write("options.yaml", AsText(data, size));
  Configuration configuration;
  if (!Accepts(path, [&] { ReadConfiguration(path, &configuration); })) return 0;
  CheckOptions(&configuration);
  const std::string copy =
      folder.Write("copy.yaml", FormatConfiguration(configuration, OptionSelection::kAll));
  Configuration again;
  ReadConfiguration(copy, &again);
  const std::vector<OptionText> expected = ChangedOptions(configuration);
  const std::vector<OptionText> found = ChangedOptions(again);
  Require(found.size() == expected.size(), "what is written is read back");
  for (size_t i = 0; i < found.size(); ++i) {
    Require(found[i].path == expected[i].path && found[i].value == expected[i].value,
            "what is written is read back: " + expected[i].path);
  }
  return 0;
}
