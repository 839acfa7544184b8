// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <pybind11/pybind11.h>

#include "apps/python/bindings.h"
#include "msc_vo/version.h"

PYBIND11_MODULE(_msc_vo, module) {
  module.doc() = "The compiled part of the package msc_vo.";
  module.attr("__version__") = msc_vo::kVersion;
  msc_vo::BindErrors(&module);
  msc_vo::BindLog(&module);
  msc_vo::BindCamera(&module);
  msc_vo::BindDepthCamera(&module);
  msc_vo::BindOptions(&module);
  msc_vo::BindSequence(&module);
  msc_vo::BindFactors(&module);
  msc_vo::BindFrame(&module);
  msc_vo::BindCalibration(&module);
  msc_vo::BindResult(&module);
  msc_vo::BindMap(&module);
  msc_vo::BindTrackedImage(&module);
  msc_vo::BindOdometry(&module);
  msc_vo::BindEvaluation(&module);
  msc_vo::BindWindow(&module);
  msc_vo::BindValues(&module);
  msc_vo::RefuseUninitializedObjects(module);
}
