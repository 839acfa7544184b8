// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace msc_vo {

/// Checks that an argument is a number from `min` to `max`. Unlike CLI::Range, it refuses nan, and
/// negative numbers for unsigned integers.
CLI::Validator NumberFrom(double min, double max);

/// Checks that an argument is a whole number from `min` to `max`, at most 2^53, and writes it in
/// digits, which CLI11 converts to every type of integer: 1e3 is 1000. For Option::transform().
CLI::Validator WholeNumberFrom(double min, double max);

/// For CLI11: an error unless a path ends in .ply.
std::string CheckPlyFileName(const std::string& path);

/// For CLI11: an error unless a path ends in .html or .svg.
std::string CheckPlotFileName(const std::string& path);

}  // namespace msc_vo
