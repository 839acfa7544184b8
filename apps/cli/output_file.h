// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/report/plot_page.h"

namespace msc_vo {

/// Whether two names are those of the same file, which need not exist yet. Links are followed.
bool AreSameFile(const std::string& a, const std::string& b);

/// Whether a file has `mark` in its first kilobyte, by which an earlier result of the same kind is
/// recognised. False for an empty mark.
bool HasMark(const std::string& file, const std::string& mark);

/// Throws std::runtime_error if `file` exists below the folder of a sequence, unless it is an
/// earlier result of the same kind, see HasMark(), or below a folder with results of this sequence.
/// `overwrite`: the value of the option --overwrite, which permits it; none: there is no option.
void RefuseToReplaceInFolder(const std::string& folder, const std::string& file,
                             const std::string& mark, std::optional<bool> overwrite = {});

/// The same; throws, too, if writing `file` would destroy a part of the sequence.
void RefuseToReplaceInSequence(const SequenceIndex& sequence, const std::string& file,
                               const std::string& mark, std::optional<bool> overwrite = {});

/// Tests before long work that its result can be written to `file`. Throws std::runtime_error if it
/// would be written over one of `inputs` (names may be empty), as RefuseToReplaceInSequence() for
/// each of `sequences`, or if it cannot be written.
void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences, const std::string& mark,
                     std::optional<bool> overwrite = {});

/// Writes a page (.svg: as an image). Throws std::runtime_error, naming the file, if it cannot be
/// written.
void WritePlotFile(const std::string& path, const PlotPage& page);

}  // namespace msc_vo
