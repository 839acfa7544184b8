// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <pybind11/numpy.h>

namespace msc_vo {

// Python values as arrays of plain numbers, numbers and paths. All functions but IsMasked() and
// PathArgument() throw std::invalid_argument, in Python ValueError, that names the argument.

/// Throws "NAME: PROBLEM".
[[noreturn]] void FailArgument(const std::string& name, const std::string& problem);

/// "(480, 640, 3) of uint8", for messages.
std::string DescribeArray(const pybind11::array& array);

/// Tests whether the value is a masked array with masked elements.
bool IsMasked(pybind11::handle value);

/// Returns the value as an array, aligned and in the byte order of this machine; copies only what
/// is not. Refuses what an array of plain numbers would lose: masks and units.
pybind11::array PlainArray(pybind11::handle value, const std::string& name);

/// Returns the value as a PlainArray() of integers or floating-point numbers.
pybind11::array NumberArray(pybind11::handle value, const std::string& name);

/// A path as str, bytes or os.PathLike, in the bytes of the file system. Throws TypeError on other
/// values.
std::string PathArgument(pybind11::handle value);

/// A text that may contain paths, as os.fsdecode() returns it: their bytes need not be UTF-8.
pybind11::str SystemText(const std::string& text);

/// A number.
double NumberArgument(pybind11::handle value, const std::string& name);

/// A time in seconds. Refuses number types that cannot hold it to a millisecond.
double TimeArgument(pybind11::handle value, const std::string& name);

/// Refuses times in an array whose type cannot hold the largest of them to a millisecond.
void CheckTimeType(const pybind11::array& times, const std::string& name);

}  // namespace msc_vo
