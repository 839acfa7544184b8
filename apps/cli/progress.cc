// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace msc_vo {

namespace {

constexpr double kTerminalInterval = 0.1;  // seconds
constexpr double kPlainInterval = 1.0;     // seconds
constexpr int kBarWidth = 24;              // characters

}  // namespace

Progress::Progress(int total, const std::string& label)
    : total_(total),
      prefix_(label.empty() ? "" : label + ": "),
      is_terminal_(isatty(STDERR_FILENO) == 1) {}

std::string Progress::Text(int done, const std::string& note) const {
  if (total_ <= 0) {
    const double seconds = std::max(1e-3 * since_start_.Milliseconds(), 1e-6);
    char unbounded[80];
    std::snprintf(unbounded, sizeof(unbounded), "%d  %.1f frames/s", done, done / seconds);
    return unbounded + (note.empty() ? "" : "  " + note);
  }
  const double rate = done / std::max(1e-3 * since_start_.Milliseconds(), 1e-6);
  const int left = static_cast<int>(std::lround((total_ - done) / std::max(rate, 1e-6)));
  char text[160];
  std::snprintf(text, sizeof(text), "%d/%d  %.1f frames/s  %d:%02d left", done, total_, rate,
                left / 60, left % 60);
  return text + (note.empty() ? "" : "  " + note);
}

void Progress::Update(int done, const std::string& note) {
  const double since = 1e-3 * since_shown_.Milliseconds();
  const bool last = done == total_;
  if (is_terminal_) {
    if (since < kTerminalInterval && !last) return;
    std::string bar;
    if (total_ > 0) {
      const int filled = kBarWidth * done / total_;
      bar = "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "] ";
    }
    // The escape sequence erases the rest of a longer previous text.
    std::fprintf(stderr, "\r%s%s%s\x1b[K", prefix_.c_str(), bar.c_str(), Text(done, note).c_str());
  } else {
    if (since < kPlainInterval && !last) return;
    std::fprintf(stderr, "%s%s\n", prefix_.c_str(), Text(done, note).c_str());
  }
  std::fflush(stderr);
  since_shown_.Restart();
}

void Progress::Finish() {
  if (is_terminal_) std::fprintf(stderr, "\n");
}

}  // namespace msc_vo
