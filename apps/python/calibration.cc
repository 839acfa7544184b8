// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <array>
#include <string>

#include <pybind11/stl.h>

#include "apps/python/bindings.h"
#include "msc_vo/self_calibration/calibration_evidence.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// By SensorCorrection::Index.
constexpr std::array<const char*, SensorCorrection::kSize> kParameters = {
    "focal_length", "center_x",     "center_y",  "k1",         "k2",
    "depth_zoom",   "depth_x",      "depth_y",   "depth_roll", "parallax_x",
    "parallax_y",   "depth_offset", "depth_bowl"};
// By CorrectionGroup.
constexpr std::array<const char*, kNumCorrectionGroups> kGroups = {
    "focal_length", "principal_point", "lens", "depth_registration"};

py::dict ByParameter(const SensorCorrection::Vector& values) {
  py::dict dict;
  for (size_t i = 0; i < kParameters.size(); ++i) dict[kParameters[i]] = values[i];
  return dict;
}

template <typename Values>
py::dict ByGroup(const Values& values) {
  py::dict dict;
  for (size_t i = 0; i < kGroups.size(); ++i) dict[kGroups[i]] = values[i];
  return dict;
}

}  // namespace

void BindCalibration(py::module_* module) {
  py::class_<CorrectionEstimate>(*module, "CalibrationEstimate",
                                 "Result of self-calibration, relative to the given calibration.")
      .def_property_readonly(
          "is_corrected", [](const CorrectionEstimate& self) { return ByGroup(self.is_corrected); },
          "Whether each group of values was wrong and has been corrected, by 'focal_length', "
          "'principal_point', 'lens' and 'depth_registration'.")
      .def_property_readonly(
          "log_odds", [](const CorrectionEstimate& self) { return ByGroup(self.log_odds); },
          "Natural logarithm of the odds that each group is wrong.")
      .def_property_readonly(
          "correction", [](const CorrectionEstimate& self) { return ByParameter(self.correction); },
          "True minus given value by parameter, 0 in groups that are not corrected: focal_length "
          "(logarithm of the ratio), center_x, center_y (focal lengths), k1, k2; of the depth "
          "image depth_zoom (logarithm), depth_x, depth_y (focal lengths), depth_roll (radians), "
          "parallax_x, parallax_y (metres), depth_offset (1/metres), depth_bowl (1/metres at the "
          "radius 1).")
      .def_property_readonly(
          "sigma", [](const CorrectionEstimate& self) { return ByParameter(self.sigma); },
          "Standard deviations of the correction; in groups that are not corrected, those that it "
          "would have.")
      .def("__repr__", [](const CorrectionEstimate& self) {
        return "<CalibrationEstimate: " +
               std::string(self.IsCorrected() ? "corrected" : "as given") + ">";
      });
}

}  // namespace msc_vo
