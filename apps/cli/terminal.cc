// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/terminal.h"

#include <cstdlib>

#include <unistd.h>

namespace msc_vo {

namespace {

std::string Environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

const char* Start(Color color) {
  switch (color) {
    case Color::kRed:
      return "\x1b[31m";
    case Color::kYellow:
      return "\x1b[33m";
  }
  return "";
}

}  // namespace

bool HasColors(int file_descriptor) {
  return isatty(file_descriptor) == 1 && Environment("NO_COLOR").empty() &&
         Environment("TERM") != "dumb";
}

std::string Colored(const std::string& text, Color color, int file_descriptor) {
  if (!HasColors(file_descriptor)) return text;
  return Start(color) + text + "\x1b[0m";
}

}  // namespace msc_vo
