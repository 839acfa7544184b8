// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/argument_checks.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

bool HasExtension(const std::string& path, const char* extension) {
  return std::filesystem::path(path).extension() == extension;
}

}  // namespace

CLI::Validator NumberFrom(double min, double max) {
  const std::string range = FormatText("[%.12g - %.12g]", min, max);
  return CLI::Validator(
      [min, max, range](const std::string& text) {
        const std::optional<double> value = ParseNumber(text);
        return value && *value >= min && *value <= max ? std::string()
                                                       : "Value " + text + " not in range " + range;
      },
      "in " + range);
}

CLI::Validator WholeNumberFrom(double min, double max) {
  const std::string range = FormatText("from %.0f to %.0f", min, max);
  return CLI::Validator(
      [min, max, range](std::string& text) {
        const std::optional<double> value = ParseNumber(text);
        if (!value || !(*value >= min && *value <= max) || *value != std::floor(*value)) {
          return "must be a whole number " + range + ", not " + text;
        }
        text = FormatText("%.0f", *value);
        return std::string();
      },
      "whole, " + range);
}

std::string CheckPlyFileName(const std::string& path) {
  if (HasExtension(path, ".ply")) return "";
  return "a surface is a PLY file, whose name must end in .ply, not " + path;
}

std::string CheckPlotFileName(const std::string& path) {
  if (HasExtension(path, ".html") || HasExtension(path, ".svg")) return "";
  return "must end in .html or .svg, not " + path;
}

}  // namespace msc_vo
