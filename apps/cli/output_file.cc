// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/output_file.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "apps/cli/sequence_arguments.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

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

// The first kilobyte; empty if it is no regular file, as pipes would wait for a writer.
std::string FirstKilobyte(const std::string& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) ? ReadBeginning(file, 1024) : "";
}

bool HasMark(const std::string& file, const std::string& mark) {
  return !mark.empty() && FirstKilobyte(file).find(mark) != std::string::npos;
}

bool HasBeginning(const std::string& file, const std::string& expression) {
  return !expression.empty() && std::regex_search(FirstKilobyte(file), std::regex(expression),
                                                  std::regex_constants::match_continuous);
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

void RefuseToReplace(const std::string& file, const OutputKind& kind,
                     const std::vector<std::string>& sequences, std::optional<bool> overwrite) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(file, error);
  // Writing to a folder or a device fails by itself.
  if (!HasEntry(file) || (!is_file && std::filesystem::exists(file, error))) return;
  // Ground truth may be an earlier export, too.
  const std::string name = std::filesystem::path(file).filename().string();
  if (overwrite.value_or(false) || name == "groundtruth.txt" || name == "reference.txt") {
    RefuseSequenceFile(file);
  }
  if (overwrite.value_or(false) || HasMark(file, kind.mark)) return;
  const bool is_beside_input =
      std::any_of(sequences.begin(), sequences.end(),
                  [&](const std::string& sequence) { return IsBesideInput(file, sequence); });
  if (!is_beside_input && HasBeginning(file, kind.beginning)) return;
  throw std::runtime_error(
      file + ": exists, and may be input or the result of another command: it is " +
      (is_beside_input ? "in the folder of the sequence, and is " : "") +
      "not recognised as an earlier result of this kind; remove it, give another path" +
      (overwrite ? ", or use --overwrite" : ""));
}

void RefuseToReplaceInSequence(const SequenceIndex& sequence, const std::string& file,
                               const OutputKind& kind, std::optional<bool> overwrite) {
  // Earlier results may have any name but that of the ground truth, which may be a trajectory of
  // them.
  const bool is_truth = std::filesystem::path(file).filename() == TruthFileName(sequence);
  if (HasMark(file, kind.mark) && !is_truth) return;
  RefuseToOverwriteSequence(sequence, file);
  RefuseToReplace(file, kind, {sequence.directory}, overwrite);
}

void CheckOutputFile(const std::string& file, const std::vector<std::string>& inputs,
                     const std::vector<SequenceIndex>& sequences, const OutputKind& kind,
                     std::optional<bool> overwrite) {
  RefuseToOverwrite(inputs, file);
  for (const SequenceIndex& sequence : sequences) {
    RefuseToReplaceInSequence(sequence, file, kind, overwrite);
  }
  RefuseToReplace(file, kind, {}, overwrite);
  CheckWritable(file);
}

void WritePlotFile(const std::string& path, const PlotPage& page) {
  const bool is_image = std::filesystem::path(path).extension() == ".svg";
  WriteFile(path, is_image ? FormatPageSvg(page) : FormatPageHtml(page));
}

}  // namespace msc_vo
