// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

/// Runs one input of a fuzz target. Returns 0; a finding ends the program. The name and the type
/// are those that libFuzzer calls; plain_driver.cc calls the same function in builds without it.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace msc_vo {

/// Counts the inputs that a reader accepted, so that the plain driver can tell that a seed reaches
/// further than the first check.
inline int64_t num_accepted = 0;

/// Reports a finding and ends the program unless `holds`.
inline void Require(bool holds, const std::string& property) {
  if (holds) return;
  std::cerr << "fuzz target: violated: " << property << std::endl;
  std::abort();
}

/// Runs a reader on hostile input. Returns whether it accepted the input. Otherwise it must have
/// thrown std::runtime_error with a message that starts with `name`, that of the file; any other
/// exception ends the program.
template <typename Reader>
bool Accepts(const std::string& name, const Reader& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    Require(message.rfind(name, 0) == 0, "the error must name " + name + ": " + message);
    return false;
  }
  ++num_accepted;
  return true;
}

/// Runs a solver on hostile data. Returns whether it accepted the data. Otherwise it must have
/// thrown std::invalid_argument with a message; any other exception ends the program.
template <typename Solver>
bool AcceptsData(const Solver& solve) {
  try {
    solve();
  } catch (const std::invalid_argument& error) {
    Require(*error.what() != '\0', "a message that names the item");
    return false;
  }
  ++num_accepted;
  return true;
}

}  // namespace msc_vo
