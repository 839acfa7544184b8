// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

/// Returns `text` as one word of a POSIX shell: as it is, or in single quotes if it is empty or has
/// blanks or special characters.
std::string ShellWord(const std::string& text);

}  // namespace msc_vo
