// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

/// The name of a file without folder and ending.
std::string StemOf(const std::string& path);

/// Natural order of file names: runs of digits are compared as numbers, so "2.png" precedes
/// "10.png".
bool NaturalLess(const std::string& a, const std::string& b);

/// Sorts the names of files: in alphabetical order if they have equal lengths and differ in
/// hexadecimal digits only, or else in natural order.
void SortNames(std::vector<std::string>* names);

/// The stem of the path of an image, split into its runs of digits and the text around them.
struct NameParts {
  std::vector<std::string> digits;
  std::vector<std::string> texts;  ///< before, between and behind the runs; may be empty
};

NameParts SplitName(const std::string& stem);

}  // namespace msc_vo
