// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/output_file.h"

#include "msc_vo/text/files.h"

namespace msc_vo {

void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences) {
  RefuseToOverwrite(inputs, file);
  for (const SequenceIndex& sequence : sequences) RefuseToOverwriteSequence(sequence, file);
  CheckWritable(file);
}

}  // namespace msc_vo
