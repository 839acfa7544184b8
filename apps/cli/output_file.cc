// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/output_file.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

constexpr size_t kMarkedBytes = 1024;

// Whether `file` is in a folder or in one below it. A link is in the folder that contains it.
bool IsBelow(const std::string& file, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  for (fs::path parent = fs::weakly_canonical(absolute.parent_path(), error); !parent.empty();
       parent = parent.parent_path()) {
    if (fs::equivalent(parent, folder, error)) return true;
    if (parent == parent.root_path()) break;
  }
  return false;
}

}  // namespace

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

void RefuseToReplaceInFolder(const std::string& folder, const std::string& file,
                             const std::string& mark) {
  if (!HasEntry(file) || !IsBelow(file, folder)) return;
  namespace fs = std::filesystem;
  if (HasEntry((fs::absolute(file).parent_path() / "sequence.json").string())) return;
  if (!mark.empty() && ReadBeginning(file, kMarkedBytes).find(mark) != std::string::npos) return;
  throw std::runtime_error(file + ": would be written over the input: it is in the folder of the " +
                           "sequence, and no earlier result of this kind; give another path for " +
                           "the results");
}

void RefuseToReplaceInSequence(const SequenceIndex& sequence, const std::string& file,
                               const std::string& mark) {
  RefuseToOverwriteSequence(sequence, file);
  RefuseToReplaceInFolder(sequence.directory, file, mark);
}

void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences, const std::string& mark) {
  RefuseToOverwrite(inputs, file);
  for (const SequenceIndex& sequence : sequences) RefuseToReplaceInSequence(sequence, file, mark);
  CheckWritable(file);
}

}  // namespace msc_vo
