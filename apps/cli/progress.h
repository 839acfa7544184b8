// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <chrono>
#include <string>

namespace msc_vo {

/// Progress on standard error: on a terminal a bar that is redrawn in place, otherwise a line every
/// two seconds or ten per cent.
class Progress {
 public:
  explicit Progress(int total);

  /// `done`: number of finished steps. `note`: text shown after the numbers.
  void Update(int done, const std::string& note);
  /// Ends the line of the bar.
  void Finish();

  double Seconds() const;  // since construction

 private:
  std::string Text(int done, const std::string& note) const;

  using Clock = std::chrono::steady_clock;
  int total_;
  bool is_terminal_;
  Clock::time_point start_;
  Clock::time_point last_shown_;
  int last_done_ = 0;
};

}  // namespace msc_vo
