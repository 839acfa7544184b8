// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <pybind11/pybind11.h>

namespace msc_vo {

// One function and one file per part of the Python module; each declares its classes and functions
// in `module`. The module is documented in docs/python.md and __init__.pyi.

void BindErrors(pybind11::module_* module);        ///< UnreadableImage, messages of all errors
void BindLog(pybind11::module_* module);           ///< set_log_level
void BindCamera(pybind11::module_* module);        ///< Camera, Lens
void BindDepthCamera(pybind11::module_* module);   ///< DepthCamera, DepthRegistration
void BindOptions(pybind11::module_* module);       ///< Options, WindowOptions
void BindSequence(pybind11::module_* module);      ///< Sequence, RgbdImage
void BindFactors(pybind11::module_* module);       ///< cost functions, blocks and custom factors
void BindFrame(pybind11::module_* module);         ///< FrameResult
void BindCalibration(pybind11::module_* module);   ///< CalibrationEstimate
void BindResult(pybind11::module_* module);        ///< Result
void BindMap(pybind11::module_* module);           ///< Map, map_images
void BindTrackedImage(pybind11::module_* module);  ///< TrackedImage
void BindOdometry(pybind11::module_* module);      ///< Odometry and the contexts of its callbacks
void BindEvaluation(pybind11::module_* module);    ///< evaluate and its errors
void BindWindow(pybind11::module_* module);        ///< WindowData and its solver
/// Pickling, copies and comparisons of the values among the classes above, which are bound before.
void BindValues(pybind11::module_* module);
/// Makes use of an object of the classes above before its __init__() a TypeError.
void RefuseUninitializedObjects(const pybind11::module_& module);

}  // namespace msc_vo
