// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <chrono>

#include "msc_vo/results/run_summary.h"

namespace msc_vo {

// What the process takes from the machine, from construction on. Memory that earlier work has freed
// is given back to the system first, so that it does not count as the peak of this one.
class CostMeter {
 public:
  CostMeter();

  RunCost Read() const;

 private:
  std::chrono::steady_clock::time_point start_;
  double start_processor_seconds_;
};

}  // namespace msc_vo
