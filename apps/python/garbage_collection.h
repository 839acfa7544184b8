// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "apps/python/shared_object.h"

namespace msc_vo {

/// Shows the Python objects that an instance of T holds to the garbage collector of Python, which
/// then also frees instances that their own callbacks refer to. T has a member
/// ForEachSharedObject(action), which calls action(SharedObject*) for each of them. Pass the result
/// to pybind11::class_<T>.
template <typename T>
pybind11::custom_type_setup CollectsGarbage() {
  struct Slots {
    // Null before __init__(), and for a Python class with several bases of this module.
    static T* InstanceOf(PyObject* self) {
      const auto* instance = reinterpret_cast<pybind11::detail::instance*>(self);
      return instance->simple_layout ? static_cast<T*>(instance->simple_value_holder[0]) : nullptr;
    }
    static int Traverse(PyObject* self, visitproc visit, void* arg) {
      Py_VISIT(Py_TYPE(self));
      T* const instance = InstanceOf(self);
      int result = 0;
      if (instance == nullptr) return result;
      instance->ForEachSharedObject([&](const SharedObject* object) {
        if (result == 0) result = object->Visit(visit, arg);
      });
      return result;
    }
    static int Clear(PyObject* self) {
      if (T* const instance = InstanceOf(self)) {
        instance->ForEachSharedObject([](SharedObject* object) { object->Clear(); });
      }
      return 0;
    }
    // Destructors may release the GIL: other threads must not collect the object meanwhile.
    static void Dealloc(PyObject* self) {
      PyObject_GC_UnTrack(self);
      pybind11::detail::pybind11_object_dealloc(self);
    }
  };
  return pybind11::custom_type_setup([](PyHeapTypeObject* heap_type) {
    PyTypeObject* const type = &heap_type->ht_type;
    type->tp_flags |= Py_TPFLAGS_HAVE_GC;
    type->tp_traverse = &Slots::Traverse;
    type->tp_clear = &Slots::Clear;
    type->tp_dealloc = &Slots::Dealloc;
  });
}

}  // namespace msc_vo
