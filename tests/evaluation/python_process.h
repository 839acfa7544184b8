// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace msc_vo {

// The output of a shell command; empty if it fails.
inline std::string OutputOf(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  std::string output;
  std::array<char, 4096> buffer;
  while (const size_t count = fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), count);
  }
  return pclose(pipe) == 0 ? output : "";
}

// A Python with numpy, which the first python3 on the path may lack; empty if there is none.
inline std::string PythonWithNumpy() {
  for (const std::string python : {"python3", "/usr/bin/python3"}) {
    if (!OutputOf(python + " -c 'import numpy; print(1)' 2>/dev/null").empty()) return python;
  }
  return "";
}

}  // namespace msc_vo
