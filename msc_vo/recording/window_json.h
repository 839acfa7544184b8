// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

/// Formats the summary of a local bundle adjustment, which took `milliseconds`, as JSON.
std::string FormatWindowJson(const BundleAdjustmentSummary& summary, double milliseconds);

}  // namespace msc_vo
