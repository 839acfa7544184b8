// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/fork_guard.h"

#include <atomic>

#include <pthread.h>

namespace msc_vo {

namespace {

// Forks between the first process and this one. os.register_at_fork would miss forks by C code.
std::atomic<int> num_forks = 0;

void CountFork() { ++num_forks; }

int NumForks() {
  [[maybe_unused]] static const int registered = pthread_atfork(nullptr, nullptr, &CountFork);
  return num_forks;
}

}  // namespace

ForkGuard::ForkGuard() : num_forks_(NumForks()) {}

bool ForkGuard::IsInherited() const { return NumForks() != num_forks_; }

}  // namespace msc_vo
