// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/interrupt_guard.h"

#include <csignal>

namespace msc_vo {

namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void SetFlag(int signal) {
  interrupted = 1;
  // A closed terminal sends SIGHUP twice: from the system and from the shell.
  if (signal != SIGHUP) std::signal(signal, SIG_DFL);
}

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  for (const int signal : kSignals) {
    // Signals that were ignored stay ignored, such as SIGHUP under nohup.
    if (std::signal(signal, SetFlag) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

InterruptGuard::~InterruptGuard() {
  for (const int signal : kSignals) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

bool InterruptGuard::IsInterrupted() const { return interrupted != 0; }

}  // namespace msc_vo
