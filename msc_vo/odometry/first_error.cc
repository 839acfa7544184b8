// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/first_error.h"

#include "msc_vo/logging/logger.h"

namespace msc_vo {

void FirstError::Add(const std::exception_ptr& error) {
  if (!error) return;
  if (!first_) {
    first_ = error;
    return;
  }
  try {
    std::rethrow_exception(error);
  } catch (const std::exception& later) {
    Log().error("a second exception in the same image: {}", later.what());
  } catch (...) {
    Log().error("a second exception in the same image");
  }
}

}  // namespace msc_vo
