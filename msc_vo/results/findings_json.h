// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// The output of `msc_vo check --json`: "sequence", "format", "errors", "warnings", and "findings"
/// in the order of the text output, each with "check", "severity", "text", "fix", "value" and
/// "unit"; the last three are null if there is none.
std::string FormatFindingsJson(const SequenceIndex& sequence, const Findings& findings);

}  // namespace msc_vo
