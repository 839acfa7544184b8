// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

/// Progress on standard error: on a terminal a bar that is redrawn in place, otherwise a line
/// per second and one at the end.
class Progress {
 public:
  /// `total`: number of steps; 0: unknown. `label`: text shown before the bar or the line.
  explicit Progress(int total, const std::string& label = "");

  /// `done`: number of finished steps. `note`: text shown after the numbers.
  void Update(int done, const std::string& note);
  /// Ends the line of the bar.
  void Finish();

 private:
  std::string Text(int done, const std::string& note) const;

  int total_;
  std::string prefix_;
  bool is_terminal_;
  Stopwatch since_start_;
  Stopwatch since_shown_;
};

}  // namespace msc_vo
