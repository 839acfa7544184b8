// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Results of a run that exports read: frames.csv or summary.json.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/exports/recorded_run.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  if (size > 0 && data[0] == '{') {
    const std::string path = folder.Write("summary.json", AsText(data, size));
    Accepts(path, [&] {
      const RecordedRun run = ReadRecordedRun(folder.path());
      if (!run.calibration) return;
      Require(std::isfinite(run.calibration->camera.fx), "a finite focal length");
    });
    return 0;
  }
  const std::string path = folder.Write("frames.csv", AsText(data, size));
  Accepts(path, [&] {
    for (const auto& [time, frame] : ReadFramesCsv(path)) {
      Require(frame.odom_from_cam.params.allFinite(), "a finite pose");
    }
  });
  return 0;
}
