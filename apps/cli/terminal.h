// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

enum class Color { kRed, kYellow };

/// Whether text on a file descriptor may be coloured: it is a terminal other than "dumb", and the
/// environment variable NO_COLOR is not set or empty (https://no-color.org).
bool HasColors(int file_descriptor);

/// The text with the escape sequences of the colour; unchanged if the file descriptor has no
/// colours.
std::string Colored(const std::string& text, Color color, int file_descriptor);

}  // namespace msc_vo
