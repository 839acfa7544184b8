// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/pose_table.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr std::array<TrajectoryFormat, 3> kTrajectoryFormats = {
    TrajectoryFormat::kTum, TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc};
constexpr size_t kRowsFields = 12, kMatrixFields = 16;  // of a 4x4 matrix

bool MayBeMatrix(const TextLine& line) {
  return line.fields.size() == kRowsFields || line.fields.size() == kMatrixFields;
}

// All fields as numbers; none if one of them is not finite.
std::optional<std::vector<double>> ParseFields(const TextLine& line) {
  std::vector<double> values;
  bool finite = true;
  for (const std::string& field : line.fields) {
    const std::optional<double> value = ParseNumber(field);
    if (!value) line.Fail("'" + field + "' is not a number; correct or remove the line");
    values.push_back(*value);
    finite = finite && std::isfinite(*value);
  }
  if (!finite) return std::nullopt;
  return values;
}

// The pose of a row with 12 or 16 numbers; none if they are not [R t] or [R t; 0 1].
std::optional<Rigid3> PoseOfRow(const std::vector<double>& values) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (int i = 0; i < static_cast<int>(values.size()); ++i) matrix(i / 4, i % 4) = values[i];
  if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) return std::nullopt;
  return RigidFromMatrix(matrix);
}

bool HasQuaternion(const std::vector<double>& values, size_t column) {
  return IsUnitQuaternion(Eigen::Map<const Eigen::Vector4d>(values.data() + column));
}

// Tests whether the first finite row is a rigid transform. A row of this length that is neither
// that nor has a quaternion is taken for a wrong one.
bool IsKitti(const std::vector<TextLine>& rows) {
  for (const TextLine& line : rows) {
    if (!MayBeMatrix(line)) return false;
    std::vector<double> values;
    for (const std::string& field : line.fields) {
      values.push_back(ParseNumber(field).value_or(std::nan("")));
    }
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (!std::all_of(values.begin(), values.end(), is_finite)) continue;
    return PoseOfRow(values) || !(HasQuaternion(values, 4) || HasQuaternion(values, 5));
  }
  return !rows.empty();
}

TrajectoryFile ReadKitti(const std::vector<TextLine>& rows) {
  TrajectoryFile file;
  file.format = TrajectoryFormat::kKitti;
  file.has_stamps = false;
  double row = 0.0;
  for (const TextLine& line : rows) {
    if (!MayBeMatrix(line)) {
      line.Fail("expected 12 numbers, the rows of [R t], found " +
                std::to_string(line.fields.size()) + " fields; correct the line");
    }
    const double stamp = row++;
    const auto values = ParseFields(line);
    if (!values) {
      ++file.num_left_out;
      continue;
    }
    const std::optional<Rigid3> pose = PoseOfRow(*values);
    if (!pose) {
      line.Fail("columns 1-3, 5-7 and 9-11 are not a rotation matrix; correct or remove the line");
    }
    file.poses.push_back({stamp, *pose});
  }
  return file;
}

std::vector<double> StampsOf(const std::vector<TimedPose>& poses) {
  std::vector<double> stamps;
  for (const TimedPose& pose : poses) stamps.push_back(pose.timestamp);
  return stamps;
}

// Converts the time stamps to seconds. `other`: the range of the other trajectory.
void ToSeconds(const std::string& path, const std::optional<TimeRange>& other, TrajectoryFile* file,
               std::vector<std::string>* warnings) {
  const TimeUnit unit = GuessTimeUnit(StampsOf(file->poses), other);
  file->unit = unit;
  if (unit == TimeUnit::kSeconds) return;
  warnings->push_back(path + ": the time stamps are " + ToString(unit) +
                      " and are converted to seconds");
  for (TimedPose& pose : file->poses) pose.timestamp /= UnitsPerSecond(unit);
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
  for (const TrajectoryFormat format : kTrajectoryFormats) names.emplace_back(ToString(format));
  return names;
}

std::optional<TrajectoryFormat> TrajectoryFormatFromName(const std::string& name) {
  for (const TrajectoryFormat format : kTrajectoryFormats) {
    if (name == ToString(format)) return format;
  }
  return std::nullopt;
}

std::string TrajectoryFile::DescribeLeftOut() const {
  if (num_left_out == 0) return "";
  return num_left_out == 1 ? "1 row with nan or inf is left out"
                           : FormatText("%d rows with nan or inf are left out", num_left_out);
}

TrajectoryFile ReadTrajectoryFile(const std::string& path, std::optional<TrajectoryFormat> format) {
  if (format == TrajectoryFormat::kKitti) return ReadKitti(ReadTextLines(path));
  const PoseRows rows = ReadPoseRows(path, format.has_value());
  if (!format && !rows.named && IsKitti(rows.rows)) return ReadKitti(rows.rows);
  return ReadPoseTable(rows, format);
}

void ConvertToSeconds(const std::string& reference_path, const std::string& estimate_path,
                      TrajectoryFile* reference, TrajectoryFile* estimate,
                      std::vector<std::string>* warnings) {
  const auto is_unknown = [](const TrajectoryFile& file) {
    return file.has_stamps && !file.unit && !file.poses.empty();
  };
  // The range of the stamps of a file, without knowledge of the other one.
  const auto range_of = [&](const TrajectoryFile& file) -> std::optional<TimeRange> {
    if (!file.has_stamps || file.poses.empty()) return std::nullopt;
    std::vector<double> stamps = StampsOf(file.poses);
    const TimeUnit unit = file.unit.value_or(GuessTimeUnit(stamps));
    if (!file.unit) {
      for (double& stamp : stamps) stamp /= UnitsPerSecond(unit);
    }
    return RangeOf(stamps, unit);
  };
  if (is_unknown(*reference)) ToSeconds(reference_path, range_of(*estimate), reference, warnings);
  if (is_unknown(*estimate)) ToSeconds(estimate_path, range_of(*reference), estimate, warnings);
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
