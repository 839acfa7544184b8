// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/results/benchmark.h"

namespace msc_vo {

// A run of four frames that succeeded, with errors of `ape` and `rpe` metres.
inline BenchmarkRun GoodRun(const std::string& sequence, const std::string& mode, double ape,
                            double rpe = 0.002) {
  BenchmarkRun run;
  run.sequence = sequence;
  run.mode = mode;
  run.summary.num_frames = 4;
  run.summary.status_counts = {3, 0, 0, 1, 0};
  run.summary.num_keyframes = 2;
  run.summary.stages = {{"tracking", 4, 12.5, 11.0, 20.0, 21.0},
                        {"mapping", 2, 30.0, 30.0, 40.0, 40.0}};
  run.cost = {1.0, 0.2, 123.4};
  run.error.emplace();
  run.error->usable = true;
  run.error->ape.count = 4;
  run.error->ape.rmse = ape;
  run.error->rpe_per_second.translation.count = 3;
  run.error->rpe_per_second.translation.rmse = rpe;
  return run;
}

}  // namespace msc_vo
