// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Whether two names are those of the same file, which need not exist yet. Links are followed.
bool AreSameFile(const std::string& a, const std::string& b);

/// Throws std::runtime_error if `file` exists below a folder and is no earlier result of the same
/// kind, which has `mark` in its first kilobyte, nor in a folder with results of a run. Without a
/// mark, earlier results cannot be recognised.
void RefuseToReplaceInFolder(const std::string& folder, const std::string& file,
                             const std::string& mark);

/// The same for the folder of a sequence; throws, too, if writing `file` would destroy a part of
/// the sequence.
void RefuseToReplaceInSequence(const SequenceIndex& sequence, const std::string& file,
                               const std::string& mark);

/// Tests before long work that its result can be written to `file`. Throws std::runtime_error if it
/// would be written over one of `inputs` (names may be empty), as RefuseToReplaceInSequence() for
/// each of `sequences`, or if it cannot be written.
void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences, const std::string& mark);

}  // namespace msc_vo
