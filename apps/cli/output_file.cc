// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/output_file.h"

#include <filesystem>
#include <system_error>

#include "msc_vo/text/files.h"

namespace msc_vo {

bool AreSameFile(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;  // also of hard links
  const auto resolve = [&error](const std::string& name) {
    const fs::path path = fs::absolute(name, error);
    return error ? fs::path() : fs::weakly_canonical(path, error);
  };
  const fs::path path = resolve(a);
  return !error && path == resolve(b) && !error;
}

void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences) {
  RefuseToOverwrite(inputs, file);
  for (const SequenceIndex& sequence : sequences) RefuseToOverwriteSequence(sequence, file);
  CheckWritable(file);
}

}  // namespace msc_vo
