// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/report/plot_page.h"

namespace msc_vo {

/// For CLI11: an error unless a path ends in .html or .svg.
std::string CheckPlotFileName(const std::string& path);

/// Writes a page (.html) or an image (.svg). Throws std::runtime_error, naming the file, if it
/// cannot be written.
void WritePlotFile(const std::string& path, const PlotPage& page);

}  // namespace msc_vo
