// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

/// The output of `msc_vo solve-window --json`: costs, residual blocks and rejected observations of
/// every term. `milliseconds`: wall time of the solve.
std::string FormatWindowJson(const BundleAdjustmentSummary& summary, double milliseconds);

}  // namespace msc_vo
