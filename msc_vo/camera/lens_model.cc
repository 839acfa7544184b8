// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_model.h"

namespace msc_vo {

namespace {

struct Model {
  LensModel model;
  const char* name;
  std::vector<std::string> coefficients;
};

// In the order of LensModel.
const std::vector<Model>& Models() {
  static const auto* const models = new std::vector<Model>{
      {LensModel::kRadialTangential, "radial-tangential", {"k1", "k2", "p1", "p2", "k3"}},
      {LensModel::kRational, "rational", {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
      {LensModel::kFisheye, "fisheye", {"k1", "k2", "k3", "k4"}},
  };
  return *models;
}

}  // namespace

const char* LensModelName(LensModel model) { return Models()[static_cast<size_t>(model)].name; }

std::optional<LensModel> LensModelFromName(const std::string& name) {
  for (const Model& model : Models()) {
    if (model.name == name) return model.model;
  }
  return std::nullopt;
}

std::string LensModelNames() {
  std::string names;
  for (const Model& model : Models()) {
    if (!names.empty()) names += ", ";
    names += model.name;
  }
  return names;
}

const std::vector<std::string>& LensCoefficientNames(LensModel model) {
  return Models()[static_cast<size_t>(model)].coefficients;
}

std::string LensCoefficientList(LensModel model) {
  std::string list;
  for (const std::string& name : LensCoefficientNames(model)) {
    if (!list.empty()) list += " ";
    list += name;
  }
  return list;
}

}  // namespace msc_vo
