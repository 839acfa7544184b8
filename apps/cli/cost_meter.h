// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/results/run_summary.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

/// Returns memory that was freed to the system, also from between memory in use.
void ReturnFreedMemory();

/// Measures wall time, processor time and peak memory of the process since construction. The
/// constructor first returns freed memory to the system, so that the peak excludes earlier work.
class CostMeter {
 public:
  CostMeter();

  /// Adds the cost of an earlier part of the run, which another process had.
  void AddEarlier(const RunCost& cost) { earlier_ = cost; }

  RunCost Read() const;

 private:
  RunCost earlier_;
  Stopwatch stopwatch_;
  double start_processor_seconds_;
};

}  // namespace msc_vo
