// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <stdexcept>

#include <pybind11/pybind11.h>

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// Argument of a callback of window factors: the context, and the window while the callback runs.
struct PyWindowContext {
  explicit PyWindowContext(const WindowContext& context_in) : context(context_in) {}

  /// A copy, made when it is first asked for.
  std::shared_ptr<WindowData> Data() {
    if (!data && context.data == nullptr) {
      throw std::runtime_error("data: the window is known during the callback only");
    }
    if (!data) data = std::make_shared<WindowData>(*context.data);
    return data;
  }

  WindowContext context;
  std::shared_ptr<WindowData> data;
};

/// Adds what the callbacks of custom factors get to the module.
void BindContexts(pybind11::module_* module);

}  // namespace msc_vo
