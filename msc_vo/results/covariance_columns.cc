// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/covariance_columns.h"

#include <cmath>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr const char* kAxes[] = {"rx", "ry", "rz", "tx", "ty", "tz"};

}  // namespace

std::vector<std::string> SigmaColumns(const std::string& prefix) {
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i) {
    names.push_back(prefix + "sigma_" + kAxes[i] + (i < 3 ? "_deg" : ""));
  }
  return names;
}

std::vector<std::string> CorrelationColumns(const std::string& prefix) {
  std::vector<std::string> names;
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) {
      names.push_back(prefix + "rho_" + kAxes[i] + "_" + kAxes[j]);
    }
  }
  return names;
}

std::string FormatSigmas(const std::optional<PoseCovariance>& covariance) {
  std::string text;
  for (int i = 0; i < 6; ++i) {
    const double sigma = covariance ? std::sqrt((*covariance)(i, i)) : 0.0;
    text += FormatText(",%.9g", i < 3 ? RadiansToDegrees(sigma) : sigma);
  }
  return text;
}

std::string FormatCorrelations(const std::optional<PoseCovariance>& given) {
  const PoseCovariance covariance = given.value_or(PoseCovariance::Zero());
  std::string text;
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) {
      const double scale = std::sqrt(covariance(i, i) * covariance(j, j));
      text += FormatText(",%.9g", scale > 0.0 ? covariance(i, j) / scale : 0.0);
    }
  }
  return text;
}

}  // namespace msc_vo
