// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_file.h"

#include <optional>
#include <stdexcept>
#include <vector>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Reads the line of the intrinsics.
Calibration ParseIntrinsicsLine(const TextLine& line) {
  const std::vector<double> v = ParseNumbers(line);
  if (v.size() != 7 && v.size() != 12) {
    line.Fail(std::string("expected 7 or 12 numbers ") + kCameraFileFormat + ", found " +
              std::to_string(v.size()));
  }
  const std::optional<int> width = WholeNumber(v[4]);
  const std::optional<int> height = WholeNumber(v[5]);
  if (!width || !height) {
    line.Fail(std::string("width and height must be whole numbers; expected ") + kCameraFileFormat);
  }
  Calibration calibration;
  calibration.camera = {v[0], v[1], v[2], v[3], *width, *height};
  calibration.depth_scale = v[6];
  for (size_t i = 7; i < v.size(); ++i) calibration.distortion.k[i - 7] = v[i];
  calibration.origin = line.file;
  std::string error;
  if (!calibration.IsValid(&error)) line.Fail(error + "; expected " + kCameraFileFormat);
  return calibration;
}

// Reads the line of the readout time.
void ParseReadoutLine(const TextLine& line, Calibration* calibration) {
  std::optional<double> seconds;
  if (line.fields.size() == 2 && line.fields[0] == "readout_time") {
    seconds = ParseNumber(line.fields[1]);
  }
  if (!seconds) {
    line.Fail(std::string("expected 'readout_time SECONDS' or nothing after the line ") +
              kCameraFileFormat);
  }
  calibration->readout_time = seconds;
  calibration->readout_origin = line.file;
  std::string error;
  if (!calibration->IsValid(&error)) line.Fail(error);
}

}  // namespace

Calibration ReadCameraFile(const std::string& path) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": is empty; expected one line " + kCameraFileFormat);
  }
  Calibration calibration = ParseIntrinsicsLine(lines[0]);
  if (lines.size() > 1) ParseReadoutLine(lines[1], &calibration);
  if (lines.size() > 2) lines[2].Fail("one line too many; remove it");
  return calibration;
}

}  // namespace msc_vo
