// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <stdexcept>
#include <string>

namespace msc_vo {

/// Replaces the names of functions of Odometry in a message of an error by their Python names.
std::string PythonNames(std::string message);

/// Calls `action`, whose errors about arguments are thrown with Python names.
template <typename Action>
auto WithPythonNames(const Action& action) -> decltype(action()) {
  try {
    return action();
  } catch (const std::invalid_argument& error) {
    const std::string message = PythonNames(error.what());
    if (message == error.what()) throw;
    throw std::invalid_argument(message);
  }
}

}  // namespace msc_vo
