// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/inertial/gravity_factors.h"

namespace msc_vo {

/// Arguments of a run that uses the accelerometer of a sequence.
struct GravityArguments {
  bool enabled = false;
  std::string axes = "x,y,z";  ///< of the accelerometer, see RotationFromAxes()
  double sigma = 0.03;         ///< GravityOptions::min_sigma in degrees
};

/// Declares --gravity, --accelerometer-axes and --gravity-sigma.
void AddGravityArguments(CLI::App* command, GravityArguments* arguments);

/// Returns the factors that tie roll and pitch to accelerometer.txt; null unless enabled.
/// Throws std::runtime_error naming file, line and fix if the file cannot be used.
std::unique_ptr<GravityFactors> MakeGravityFactors(const GravityArguments& arguments,
                                                   const SequenceIndex& sequence);

}  // namespace msc_vo
