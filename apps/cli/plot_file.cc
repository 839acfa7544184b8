// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/plot_file.h"

#include <filesystem>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

std::string Extension(const std::string& path) {
  return std::filesystem::path(path).extension().string();
}

}  // namespace

std::string CheckPlotFileName(const std::string& path) {
  if (Extension(path) == ".html" || Extension(path) == ".svg") return "";
  return "must end in .html or .svg, not " + path;
}

void WritePlotFile(const std::string& path, const PlotPage& page) {
  WriteFile(path, Extension(path) == ".svg" ? FormatPageSvg(page) : FormatPageHtml(page));
}

}  // namespace msc_vo
