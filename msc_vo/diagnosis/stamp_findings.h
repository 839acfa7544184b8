// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// Rate, gaps and unit of the time stamps, and the delays between colour and depth that the stamps
/// give.
void AddStampFindings(const SequenceIndex& index, Findings* findings);

/// Whether the ground truth has poses at the times of the images.
void AddGroundTruthStampFindings(const SequenceIndex& index, Findings* findings);

}  // namespace msc_vo
