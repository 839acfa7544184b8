// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/bindings.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

[[noreturn]] void* RefuseObject(size_t) {
  throw py::type_error("the object is not initialised: __init__() was not called");
}

}  // namespace

// pybind11 allocates the value of an object when it is used before its constructor was called, as
// after Class.__new__(Class), and then uses bytes without a meaning.
void RefuseUninitializedObjects(const py::module_& module) {
  for (const auto& [name, value] : py::dict(module.attr("__dict__"))) {
    if (!py::isinstance<py::type>(value)) continue;
    auto* const type = reinterpret_cast<PyTypeObject*>(value.ptr());
    if (py::detail::type_info* info = py::detail::get_type_info(type)) {
      info->operator_new = &RefuseObject;
    }
  }
}

}  // namespace msc_vo
