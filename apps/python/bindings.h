// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <pybind11/pybind11.h>

namespace msc_vo {

// One function and one file per part of the Python module; each declares its classes and functions
// in `module`. The module is documented in docs/python.md and __init__.pyi.

void BindCamera(pybind11::module_* module);      ///< Camera
void BindOptions(pybind11::module_* module);     ///< Options, WindowOptions
void BindSequence(pybind11::module_* module);    ///< Sequence, RgbdImage, UnreadableImage
void BindFactors(pybind11::module_* module);     ///< cost functions, blocks and custom factors
void BindFrame(pybind11::module_* module);       ///< FrameResult
void BindResult(pybind11::module_* module);      ///< Result
void BindOdometry(pybind11::module_* module);    ///< Odometry and the contexts of its callbacks
void BindEvaluation(pybind11::module_* module);  ///< evaluate and its errors
void BindWindow(pybind11::module_* module);      ///< WindowData and its solver

}  // namespace msc_vo
