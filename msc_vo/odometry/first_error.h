// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <exception>

namespace msc_vo {

/// Keeps the first of several exceptions until the work that they must not interrupt is done. Later
/// ones are logged.
class FirstError {
 public:
  void Add(const std::exception_ptr& error);
  /// Calls `action` and adds its exception.
  template <typename Action>
  void Catch(const Action& action) {
    try {
      action();
    } catch (...) {
      Add(std::current_exception());
    }
  }
  /// Throws the first exception if there is one.
  void Throw() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::exception_ptr first_;
};

}  // namespace msc_vo
