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

/// How earlier results of one kind are recognised by their first kilobyte. Both texts may be empty:
/// then they are not recognised by it.
struct OutputKind {
  /// Text that no other program writes.
  std::string mark = {};
  /// Regular expression of the beginning, which files of other programs may have, too. It is not
  /// sufficient in the folder of a sequence, outside results of a run over the sequence.
  std::string beginning = {};
};

/// Throws std::runtime_error, naming the file and the fix, if `file` exists and is not recognised
/// as an earlier result of the same kind. `sequences`: the folders of the sequences that the
/// command reads. `overwrite`: the value of the option --overwrite, which permits it; none: there
/// is no option. Neither permits images, text files beside them and the ground truth of a sequence.
void RefuseToReplace(const std::string& file, const OutputKind& kind,
                     const std::vector<std::string>& sequences, std::optional<bool> overwrite = {});

/// The same; throws, too, if writing `file` would destroy a part of the sequence.
void RefuseToReplaceInSequence(const SequenceIndex& sequence, const std::string& file,
                               const OutputKind& kind, std::optional<bool> overwrite = {});

/// Tests before long work that its result can be written to `file`. Throws std::runtime_error if it
/// would be written over one of `inputs` (names may be empty), as RefuseToReplaceInSequence() for
/// each of `sequences`, as RefuseToReplace(), or if it cannot be written.
void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences, const OutputKind& kind,
                     std::optional<bool> overwrite = {});

/// Writes a page (.svg: as an image). Throws std::runtime_error, naming the file, if it cannot be
/// written.
void WritePlotFile(const std::string& path, const PlotPage& page);

}  // namespace msc_vo
