// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/plain_array.h"

#include <stdexcept>

namespace msc_vo {

namespace py = pybind11;

namespace {

std::string ShapeText(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

bool IsPythonNumber(py::handle value) {
  return PyFloat_CheckExact(value.ptr()) || PyLong_Check(value.ptr());
}

bool HasUnit(py::handle value) {
  for (const char* name : {"unit", "units"}) {
    if (py::hasattr(value, name) && !value.attr(name).is_none()) return true;
  }
  return false;
}

// Refuses masked elements and units, also those of the items of a list: NumPy drops them.
void CheckPlain(py::handle value, const std::string& name) {
  if (IsPythonNumber(value)) return;
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    for (const py::handle item : py::reinterpret_borrow<py::iterable>(value)) {
      CheckPlain(item, name);
    }
    return;
  }
  if (IsMasked(value)) {
    FailArgument(name, "has masked elements; pass plain numbers, such as " + name + ".filled(0)");
  }
  if (HasUnit(value)) FailArgument(name, "has a unit, which would be ignored; pass plain numbers");
}

bool HasKind(const py::array& array, const char* kinds) {
  return std::string(kinds).find(array.dtype().kind()) != std::string::npos;
}

}  // namespace

void FailArgument(const std::string& name, const std::string& problem) {
  throw std::invalid_argument(name + ": " + problem);
}

std::string DescribeArray(const py::array& array) {
  return ShapeText(array) + " of " + std::string(py::str(array.dtype()));
}

bool IsMasked(py::handle value) {
  return py::module_::import("numpy").attr("ma").attr("is_masked")(value).cast<bool>();
}

py::array PlainArray(py::handle value, const std::string& name) {
  CheckPlain(value, name);
  py::array array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    FailArgument(name, "expected an array, not " + std::string(py::str(py::type::of(value))));
  }
  const bool is_aligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
  if (is_aligned && array.dtype().attr("isnative").cast<bool>()) return array;
  return array.attr("astype")(array.dtype().attr("newbyteorder")("="));
}

py::array NumberArray(py::handle value, const std::string& name) {
  py::array array = PlainArray(value, name);
  if (!HasKind(array, "fiu")) FailArgument(name, "expected numbers, not " + DescribeArray(array));
  return array;
}

std::string PathArgument(py::handle value) {
  PyObject* path = nullptr;
  if (PyUnicode_FSConverter(value.ptr(), &path) == 0) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(path);
}

py::str SystemText(const std::string& text) {
  PyObject* decoded =
      PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<py::ssize_t>(text.size()));
  if (decoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

double NumberArgument(py::handle value, const std::string& name) {
  const py::array array = PlainArray(value, name);
  if (array.size() != 1 || !HasKind(array, "fiuO")) {
    FailArgument(name, "expected a number, not " + DescribeArray(array));
  }
  return py::float_(array.attr("item")()).cast<double>();
}

double TimeArgument(py::handle value, const std::string& name) {
  if (!IsPythonNumber(value)) CheckTimeType(PlainArray(value, name), name);
  return NumberArgument(value, name);
}

void CheckTimeType(const py::array& times, const std::string& name) {
  constexpr double kLargestStep = 1e-3;  // seconds
  if (!HasKind(times, "f") || times.itemsize() >= static_cast<py::ssize_t>(sizeof(double))) return;
  const py::module_ numpy = py::module_::import("numpy");
  const py::array steps = numpy.attr("spacing")(numpy.attr("abs")(times));
  if (!(numpy.attr("any")(numpy.attr("greater")(steps, kLargestStep))).cast<bool>()) return;
  FailArgument(name, "the type " + std::string(py::str(times.dtype())) +
                         " rounds these time stamps by more than a millisecond; pass float64");
}

}  // namespace msc_vo
