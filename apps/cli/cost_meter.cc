// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/cost_meter.h"

#include <algorithm>
#include <fstream>
#include <string>

#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace msc_vo {

namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double ProcessorSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

// Writing 5 to clear_refs resets the peak on Linux (man 5 proc). If that is not permitted, the peak
// since the start of the process is reported.
void ResetPeakMemory() {
  ReturnFreedMemory();
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
}

// Peak resident memory, MiB.
double PeakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    double kibibytes = 0.0;
    if (name == "VmHWM:" && status >> kibibytes) return kibibytes / 1024.0;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // kibibytes on Linux
}

}  // namespace

void ReturnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

CostMeter::CostMeter() {
  ResetPeakMemory();
  start_processor_seconds_ = ProcessorSeconds();
  stopwatch_.Restart();
}

RunCost CostMeter::Read() const {
  const double seconds = 1e-3 * stopwatch_.Milliseconds();
  const double processor_seconds = ProcessorSeconds() - start_processor_seconds_;
  return {earlier_.seconds + seconds, earlier_.processor_seconds + processor_seconds,
          std::max(earlier_.peak_memory, PeakMemory())};
}

}  // namespace msc_vo
