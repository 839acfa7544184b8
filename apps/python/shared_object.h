// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <utility>

#include <pybind11/pybind11.h>

namespace msc_vo {

/// A Python object that threads without the GIL may copy and destroy, as std::function and
/// std::shared_ptr do with their contents. All copies share one reference to it. The members need
/// the GIL.
class SharedObject {
 public:
  SharedObject() = default;
  explicit SharedObject(pybind11::object object)
      : object_(new pybind11::object(std::move(object)), [](pybind11::object* held) {
          const pybind11::gil_scoped_acquire gil;
          delete held;
        }) {}

  pybind11::object get() const { return *object_; }

  /// For the garbage collector of Python: visits the object, and replaces it by None in all copies.
  int Visit(visitproc visit, void* arg) const {
    if (object_ != nullptr) Py_VISIT(object_->ptr());
    return 0;
  }
  void Clear() {
    if (object_ != nullptr) *object_ = pybind11::none();
  }

 private:
  std::shared_ptr<pybind11::object> object_;
};

}  // namespace msc_vo
