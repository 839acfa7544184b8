// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr std::array<TrajectoryFormat, 3> kFormats = {
    TrajectoryFormat::kTum, TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc};
constexpr size_t kKittiFields = 12;
constexpr size_t kEurocFields = 8;  // those that are read
constexpr double kNanoseconds = 1e9;
constexpr double kMaxQuaternionError = 0.05;  // deviation of the norm from 1

// The first row of a file and what stands above it.
struct FirstRow {
  std::string header;  // in lower case
  std::string text;
};

FirstRow ReadFirstRow(const std::string& path) {
  std::istringstream content(ReadFile(path));
  FirstRow row;
  for (std::string text; std::getline(content, text);) {
    text = Trimmed(text);
    if (text.empty()) continue;
    const size_t end = text.find_first_of(" \t,");
    if (text[0] != '#' && ParseNumber(text.substr(0, end))) {
      row.text = text;
      break;
    }
    row.header = Lowercase(text);
  }
  return row;
}

size_t NumFields(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream fields(text);
  size_t count = 0;
  for (std::string field; fields >> field;) ++count;
  return count;
}

bool NamesEurocColumns(const std::string& header) {
  if (header.find("[ns]") != std::string::npos) return true;
  for (const auto& [w, x] : {std::pair("q_rs_w", "q_rs_x"), {"qw", "qx"}, {"q_w", "q_x"}}) {
    const size_t at = header.find(w);
    if (at != std::string::npos && at < header.find(x)) return true;
  }
  return false;
}

// All fields as numbers; none if one of them is not finite.
std::optional<std::vector<double>> ParseFields(const TextLine& line, size_t count) {
  std::vector<double> values;
  bool finite = true;
  for (size_t i = 0; i < count; ++i) {
    const std::optional<double> value = ParseNumber(line.fields[i]);
    if (!value) {
      line.Fail("'" + line.fields[i] + "' is not a number; correct or remove the line");
    }
    values.push_back(*value);
    finite = finite && std::isfinite(*value);
  }
  if (!finite) return std::nullopt;
  return values;
}

TrajectoryFile ReadKitti(const std::string& path) {
  TrajectoryFile file;
  file.format = TrajectoryFormat::kKitti;
  file.has_stamps = false;
  double row = 0.0;
  for (const TextLine& line : ReadTextLines(path)) {
    if (line.fields.size() != kKittiFields) {
      line.Fail("expected 12 numbers, the rows of [R t], found " +
                std::to_string(line.fields.size()) + " fields; correct the line");
    }
    const double stamp = row++;
    const auto values = ParseFields(line, kKittiFields);
    if (!values) {
      ++file.num_left_out;
      continue;
    }
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (int i = 0; i < static_cast<int>(kKittiFields); ++i) matrix(i / 4, i % 4) = (*values)[i];
    const std::optional<Rigid3> pose = RigidFromMatrix(matrix);
    if (!pose) {
      line.Fail("columns 1-3, 5-7 and 9-11 are not a rotation matrix; correct or remove the line");
    }
    file.poses.push_back({stamp, *pose});
  }
  return file;
}

TrajectoryFile ReadEuroc(const std::string& path) {
  TrajectoryFile file;
  file.format = TrajectoryFormat::kEuroc;
  bool is_first = true;
  for (const TextLine& line : ReadTextLines(path)) {
    // A header is usually a comment.
    const bool is_header = std::exchange(is_first, false) && !ParseNumber(line.fields[0]);
    if (is_header) continue;
    if (line.fields.size() < kEurocFields) {
      line.Fail("expected at least 8 numbers 'nanoseconds, x, y, z, qw, qx, qy, qz', found " +
                std::to_string(line.fields.size()) + " fields; correct the line");
    }
    const auto values = ParseFields(line, kEurocFields);
    if (!values) {
      ++file.num_left_out;
      continue;
    }
    const std::vector<double>& v = *values;
    const Eigen::Quaterniond rotation(v[4], v[5], v[6], v[7]);
    if (!(std::abs(rotation.norm() - 1.0) <= kMaxQuaternionError)) {
      line.Fail(FormatText(
          "the quaternion qw qx qy qz has length %.3f instead of 1; correct or remove the line",
          rotation.norm()));
    }
    file.poses.push_back({v[0] / kNanoseconds, Rigid3(rotation.normalized(), {v[1], v[2], v[3]})});
  }
  std::stable_sort(
      file.poses.begin(), file.poses.end(),
      [](const TimedPose& a, const TimedPose& b) { return a.timestamp < b.timestamp; });
  return file;
}

// Copies the stamps of the row with the same number.
void CopyStamps(const TrajectoryFile& from, TrajectoryFile* to) {
  for (TimedPose& pose : to->poses) {
    pose.timestamp = from.poses[static_cast<size_t>(pose.timestamp)].timestamp;
  }
  to->has_stamps = true;
}

}  // namespace

const char* ToString(TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return "tum";
    case TrajectoryFormat::kKitti:
      return "kitti";
    case TrajectoryFormat::kEuroc:
      return "euroc";
  }
  return "unknown";
}

std::vector<std::string> TrajectoryFormatNames() {
  std::vector<std::string> names;
  for (const TrajectoryFormat format : kFormats) names.emplace_back(ToString(format));
  return names;
}

std::optional<TrajectoryFormat> TrajectoryFormatFromName(const std::string& name) {
  for (const TrajectoryFormat format : kFormats) {
    if (name == ToString(format)) return format;
  }
  return std::nullopt;
}

TrajectoryFormat DetectTrajectoryFormat(const std::string& path) {
  const FirstRow row = ReadFirstRow(path);
  const size_t num_fields = NumFields(row.text);
  if (num_fields == kKittiFields) return TrajectoryFormat::kKitti;
  if (row.text.find(',') == std::string::npos) return TrajectoryFormat::kTum;
  constexpr double kFirstDate = 1e18;  // nanoseconds since 1970, in 2001
  const std::optional<double> stamp = ParseNumber(row.text.substr(0, row.text.find(',')));
  if (NamesEurocColumns(row.header) || num_fields > kEurocFields ||
      (stamp && *stamp >= kFirstDate)) {
    return TrajectoryFormat::kEuroc;
  }
  return TrajectoryFormat::kTum;
}

TrajectoryFile ReadTrajectoryFile(const std::string& path, std::optional<TrajectoryFormat> format) {
  switch (format ? *format : DetectTrajectoryFormat(path)) {
    case TrajectoryFormat::kKitti:
      return ReadKitti(path);
    case TrajectoryFormat::kEuroc:
      return ReadEuroc(path);
    case TrajectoryFormat::kTum:
      break;
  }
  TrajectoryFile file;
  file.poses = ReadTrajectory(path, &file.num_left_out);
  return file;
}

void ShareStamps(const std::string& reference_path, const std::string& estimate_path,
                 TrajectoryFile* reference, TrajectoryFile* estimate) {
  if (reference->has_stamps && estimate->has_stamps) return;
  const auto num_rows = [](const TrajectoryFile& file) {
    return file.poses.size() + file.num_left_out;
  };
  const std::string& without = reference->has_stamps ? estimate_path : reference_path;
  if (num_rows(*reference) != num_rows(*estimate)) {
    throw std::runtime_error(
        FormatText("%s has %zu poses and %s has %zu, but %s has no time stamps "
                   "(KITTI), so that poses are compared row by row; give "
                   "trajectories of the same length",
                   reference_path.c_str(), num_rows(*reference), estimate_path.c_str(),
                   num_rows(*estimate), without.c_str()));
  }
  if (!reference->has_stamps && !estimate->has_stamps) return;
  const TrajectoryFile& timed = reference->has_stamps ? *reference : *estimate;
  if (timed.num_left_out > 0) {
    throw std::runtime_error((reference->has_stamps ? reference_path : estimate_path) +
                             ": has rows with nan or inf, so that it cannot be compared row by row "
                             "with " +
                             without + ", which has no time stamps; correct these rows");
  }
  CopyStamps(timed, reference->has_stamps ? estimate : reference);
}

}  // namespace msc_vo
