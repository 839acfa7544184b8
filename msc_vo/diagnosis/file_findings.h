// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// Missing and unreadable files (names, sizes), and consecutive images whose files are equal byte
/// for byte: the frozen stream of a camera. Decodes nothing.
void AddFileFindings(const SequenceIndex& index, Findings* findings);

}  // namespace msc_vo
