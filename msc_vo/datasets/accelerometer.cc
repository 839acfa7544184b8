// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/accelerometer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr double kGravity = 9.81;             // metres/second^2
constexpr double kMaxGravityDeviation = 0.2;  // relative; more than any scale error of a sensor

std::vector<TimedAcceleration> ReadRows(const std::string& path) {
  std::vector<TimedAcceleration> readings;
  std::vector<TextLine> lines = ReadTextLines(path);
  RestoreFractions(0, &lines);
  for (const TextLine& line : lines) {
    if (line.fields.size() != 4) {
      line.Fail("expected 4 numbers 'time ax ay az', found " + std::to_string(line.fields.size()) +
                " fields; correct the line");
    }
    const std::vector<double> v = ParseNumbers(line);
    readings.push_back({v[0], {v[1], v[2], v[3]}});
  }
  if (readings.empty()) {
    throw std::runtime_error(path + ": holds no reading; expected 'time ax ay az' rows");
  }
  std::stable_sort(readings.begin(), readings.end(),
                   [](const TimedAcceleration& a, const TimedAcceleration& b) {
                     return a.timestamp < b.timestamp;
                   });
  return readings;
}

// Converts the stamps to seconds.
void ToSeconds(const TimeRange& images, std::vector<TimedAcceleration>* readings) {
  const std::vector<double> stamps = TimestampsOf(*readings, &TimedAcceleration::timestamp);
  const double rate = UnitsPerSecond(GuessTimeUnit(stamps, images));
  for (TimedAcceleration& reading : *readings) reading.timestamp /= rate;
}

void CheckGravity(const std::string& path, const std::vector<TimedAcceleration>& readings) {
  std::vector<double> lengths;
  for (const TimedAcceleration& reading : readings) lengths.push_back(reading.acceleration.norm());
  const double median = UpperMedian(std::move(lengths));
  if (std::abs(median - kGravity) <= kMaxGravityDeviation * kGravity) return;
  throw std::runtime_error(
      path + FormatText(": the median length of the readings is %.3g instead of 9.81; convert them "
                        "to metres/second^2 with gravity included",
                        median));
}

// Unit vector of "x", "-x", "y", ...; zero if the name is none of these.
Eigen::Vector3d AxisFromName(const std::string& name) {
  const bool negative = !name.empty() && name[0] == '-';
  const std::string letter = negative ? name.substr(1) : name;
  for (int i = 0; i < 3; ++i) {
    if (letter == std::string(1, "xyz"[i])) {
      return (negative ? -1.0 : 1.0) * Eigen::Vector3d::Unit(i);
    }
  }
  return Eigen::Vector3d::Zero();
}

}  // namespace

std::vector<TimedAcceleration> ReadAccelerometer(const SequenceIndex& index) {
  const std::string path = (std::filesystem::path(index.directory) / "accelerometer.txt").string();
  if (!HasEntry(path)) {
    throw std::runtime_error(path +
                             ": does not exist; gravity needs the readings of an accelerometer, "
                             "'time ax ay az' rows in metres/second^2");
  }
  std::vector<TimedAcceleration> readings = ReadRows(path);
  const double begin = index.entries.front().timestamp, end = index.entries.back().timestamp;
  ToSeconds({begin, end, index.stamp_unit}, &readings);
  if (readings.back().timestamp < begin || readings.front().timestamp > end) {
    throw std::runtime_error(
        path + FormatText(": the readings (%.3f to %.3f s) and the images (%.3f to %.3f s) do not "
                          "overlap in time; give both the same clock",
                          readings.front().timestamp, readings.back().timestamp, begin, end));
  }
  CheckGravity(path, readings);
  return readings;
}

Eigen::Matrix3d RotationFromAxes(const std::string& axes) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  size_t begin = 0;
  for (int column = 0; column < 3 && begin <= axes.size(); ++column) {
    const size_t end = column < 2 ? std::min(axes.find(',', begin), axes.size()) : axes.size();
    rotation.col(column) = AxisFromName(axes.substr(begin, end - begin));
    begin = end + 1;
  }
  if (std::abs(rotation.determinant() - 1.0) > 1e-9) {
    throw std::invalid_argument(
        "'" + axes +
        "' is not a right-handed set of axes; give the camera axes of the sensor's x, y and z axis "
        "such as x,y,z or -x,-y,z");
  }
  return rotation;
}

}  // namespace msc_vo
