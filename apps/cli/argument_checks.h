// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace msc_vo {

/// Checks that an argument is a number from `min` to `max`. Unlike CLI::Range, it refuses nan, and
/// negative numbers for unsigned integers.
CLI::Validator NumberFrom(double min, double max);

/// For CLI11: an error unless a path ends in .ply.
std::string CheckPlyFileName(const std::string& path);

/// For CLI11: an error unless a path ends in .html or .svg.
std::string CheckPlotFileName(const std::string& path);

}  // namespace msc_vo
