// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/diagnosis/depth_curve.h"
#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// An error that names what the values are, if they are no depths; a warning, if an undescribed
/// lens can look like it.
void AddDepthCurveFindings(const DepthCurveTest& test, Findings* findings);

}  // namespace msc_vo
