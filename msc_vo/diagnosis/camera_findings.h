// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// Numbers of a calibration that are unusual for any camera; images are not needed. `format` is the
/// name of the sequence's layout.
void AddCameraFindings(const Calibration& calibration, const std::string& format,
                       Findings* findings);

}  // namespace msc_vo
