// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "msc_vo/results/online_results.h"
#include "msc_vo/results/result_files.h"

namespace msc_vo {

/// Writes the result files of a run, during it and at its end. Files that only help, such as the
/// checkpoint, give way to them on a full disk.
class RunFiles {
 public:
  /// Creates no file.
  RunFiles(std::string directory, SequenceIdentity sequence)
      : directory_(std::move(directory)), online_(directory_, std::move(sequence)) {}

  /// Names a file or folder that only helps. `remove` removes it for good, and returns its name, or
  /// an empty one if there was nothing to remove. What is named first is removed first.
  void AddExpendable(const std::string& path, std::function<std::string()> remove);

  /// Continues the files of a run that has been resumed with `frames`.
  void Continue(const std::vector<FrameResult>& frames) { online_.Continue(frames); }

  /// Takes every frame as soon as it has been processed. If it cannot be written now, prints a
  /// warning: Finish() writes it.
  void Add(const FrameResult& frame);

  /// As WriteResultFiles(); removes expendable files if the disk is full and has room for all
  /// results without them.
  [[nodiscard]] std::string Finish(const OdometryResult& result, const RunContext& context);

 private:
  struct Expendable {
    std::string path;
    std::function<std::string()> remove;
  };

  bool MakeRoomFor(std::uintmax_t num_bytes);

  std::string directory_;
  OnlineResults online_;
  std::vector<Expendable> expendable_;
  bool has_warned_ = false;
};

}  // namespace msc_vo
