// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/output_file.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr size_t kMarkedBytes = 1024;

// Whether `folder` holds results of a run over a sequence.
bool HoldsResultsOf(const std::string& folder, const std::string& sequence) {
  const std::optional<SequenceIdentity> identity = ReadIdentity(folder);
  return identity && AreSameFile(identity->path, sequence);
}

// Whether `file` is below the folder of a sequence, but not below results of the sequence in it. A
// link is in the folder that contains it.
bool IsBesideInput(const std::string& file, const std::string& sequence) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  for (fs::path parent = fs::weakly_canonical(absolute.parent_path(), error); !parent.empty();
       parent = parent.parent_path()) {
    if (fs::equivalent(parent, sequence, error)) return true;
    if (parent == parent.root_path() || HoldsResultsOf(parent.string(), sequence)) break;
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

bool HasMark(const std::string& file, const std::string& mark) {
  std::error_code error;  // pipes would wait for a writer
  return !mark.empty() && std::filesystem::is_regular_file(file, error) &&
         ReadBeginning(file, kMarkedBytes).find(mark) != std::string::npos;
}

void RefuseToReplaceInFolder(const std::string& folder, const std::string& file,
                             const std::string& mark, std::optional<bool> overwrite) {
  if (overwrite.value_or(false) || !HasEntry(file) || HasMark(file, mark)) return;
  if (!IsBesideInput(file, folder)) return;
  throw std::runtime_error(file +
                           ": may be input: it is in the folder of the sequence, and is not " +
                           "recognised as an earlier result; remove it, give another path" +
                           (overwrite ? ", or use --overwrite" : ""));
}

void RefuseToReplaceInSequence(const SequenceIndex& sequence, const std::string& file,
                               const std::string& mark, std::optional<bool> overwrite) {
  // Earlier results may have any name but that of the ground truth, which may be a trajectory of
  // them.
  const bool is_truth = std::filesystem::path(file).filename() == TruthFileName(sequence);
  if (HasMark(file, mark) && !is_truth) return;
  RefuseToOverwriteSequence(sequence, file);
  RefuseToReplaceInFolder(sequence.directory, file, mark, overwrite);
}

void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences, const std::string& mark,
                     std::optional<bool> overwrite) {
  RefuseToOverwrite(inputs, file);
  for (const SequenceIndex& sequence : sequences) {
    RefuseToReplaceInSequence(sequence, file, mark, overwrite);
  }
  CheckWritable(file);
}

void WritePlotFile(const std::string& path, const PlotPage& page) {
  const bool is_image = std::filesystem::path(path).extension() == ".svg";
  WriteFile(path, is_image ? FormatPageSvg(page) : FormatPageHtml(page));
}

}  // namespace msc_vo
