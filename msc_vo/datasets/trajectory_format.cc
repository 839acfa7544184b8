// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory_format.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/pose_table.h"
#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/text/ending.h"
#include "msc_vo/text/enum_names.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr size_t kRowsFields = 12, kMatrixFields = 16;  // of a 4x4 matrix

// A time stamp stands before the matrix.
bool HasStamp(const TextLine& line) { return line.fields.size() % 2 == 1; }

bool MayBeMatrix(const TextLine& line) {
  const size_t count = line.fields.size() - (HasStamp(line) ? 1 : 0);
  return count == kRowsFields || count == kMatrixFields;
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

// The pose of a row with 12 or 16 numbers, behind a time stamp or not; none if they are not [R t]
// or [R t; 0 1].
std::optional<Rigid3> PoseOfRow(const std::vector<double>& values) {
  const double* const numbers = values.data() + values.size() % 2;
  const int count = static_cast<int>(values.size() - values.size() % 2);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (int i = 0; i < count; ++i) matrix(i / 4, i % 4) = numbers[i];
  return RigidFromMatrix(matrix);
}

// All fields as numbers; NaN for other text.
std::vector<double> NumbersIn(const TextLine& line) {
  std::vector<double> values;
  for (const std::string& field : line.fields) {
    values.push_back(ParseNumber(field).value_or(std::nan("")));
  }
  return values;
}

bool AreFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

bool HasQuaternion(const std::vector<double>& values, size_t column) {
  return IsUnitQuaternion(Eigen::Map<const Eigen::Vector4d>(values.data() + column));
}

// Tests whether the first finite row is a rigid transform. A row of 12 or 16 numbers that is
// neither that nor has a quaternion is taken for a wrong one.
bool IsKitti(const std::vector<TextLine>& rows) {
  for (const TextLine& line : rows) {
    if (!MayBeMatrix(line)) return false;
    const std::vector<double> values = NumbersIn(line);
    if (!AreFinite(values)) continue;
    if (PoseOfRow(values)) return true;
    return !HasStamp(line) && !HasQuaternion(values, 4) && !HasQuaternion(values, 5);
  }
  return !rows.empty() && !HasStamp(rows.front());
}

// Tests whether nine numbers of a row, from `begin` on and in rows of `stride`, are a rotation.
bool HasRotation(const std::vector<double>& values, size_t begin, size_t stride) {
  if (begin + 2 * stride + 3 > values.size()) return false;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    matrix.row(row).head<3>() = Eigen::Map<const Eigen::RowVector3d>(&values[begin + i * stride]);
  }
  return RigidFromMatrix(matrix).has_value();
}

// Throws if all rows have a rotation matrix that begins where a time and a pose are read, at the
// quaternion at the latest: the columns of a quaternion may have unit length in it.
void RefuseMatrices(const std::vector<TextLine>& rows) {
  std::vector<std::vector<double>> table;
  for (const TextLine& line : rows) {
    const std::vector<double> values = NumbersIn(line);
    if (AreFinite(values)) table.push_back(values);
  }
  if (table.empty()) return;
  constexpr size_t kQuaternion = 4;  // further columns than its own are ignored
  for (size_t begin = 0; begin <= kQuaternion && begin + 9 <= table.front().size(); ++begin) {
    for (const size_t stride : {3, 4}) {
      const bool is_matrix = std::all_of(table.begin(), table.end(), [&](const auto& values) {
        return HasRotation(values, begin, stride);
      });
      if (!is_matrix) continue;
      throw NotATrajectory(
          rows.front().Where() +
          FormatText(": column %zu begins a rotation matrix, but the row is not that of a 3x4 or "
                     "4x4 matrix [R t] with or without a time stamp in front; write it as one, or "
                     "as 'time tx ty tz qx qy qz qw'",
                     begin + 1));
    }
  }
}

// Whether at most half of the rows are not as the first one or hold no pose, so that these are
// damaged.
bool AreMostlyKitti(const std::vector<TextLine>& rows) {
  const auto is_pose = [&](const TextLine& line) {
    if (!MayBeMatrix(line) || HasStamp(line) != HasStamp(rows.front())) return false;
    const std::vector<double> values = NumbersIn(line);
    return !AreFinite(values) || PoseOfRow(values).has_value();
  };
  return 2 * static_cast<size_t>(std::count_if(rows.begin(), rows.end(), is_pose)) >= rows.size();
}

TrajectoryFile ReadKittiRows(std::vector<TextLine> rows) {
  TrajectoryFile file;
  file.format = TrajectoryFormat::kKitti;
  file.has_stamps = !rows.empty() && HasStamp(rows.front());
  if (file.has_stamps) RestoreFractions(0, &rows);
  double row = 0.0;
  for (const TextLine& line : rows) {
    if (!MayBeMatrix(line) || HasStamp(line) != file.has_stamps) {
      line.Fail("expected " + std::string(file.has_stamps ? "a time stamp and " : "") +
                "12 numbers, the rows of [R t], found " + std::to_string(line.fields.size()) +
                " fields; correct the line");
    }
    double stamp = row++;
    const auto values = ParseFields(line);
    if (!values) {
      const double time = file.has_stamps ? *ParseNumber(line.fields.front()) : stamp;
      file.LeaveOut(time);
      continue;
    }
    const std::optional<Rigid3> pose = PoseOfRow(*values);
    if (!pose) {
      line.Fail(std::string(file.has_stamps ? "columns 2-4, 6-8 and 10-12"
                                            : "columns 1-3, 5-7 and 9-11") +
                " are not a rotation matrix; correct or remove the line");
    }
    if (file.has_stamps) stamp = values->front();
    file.poses.push_back({stamp, *pose});
  }
  SortByTime(&file.poses);
  return file;
}

TrajectoryFile ReadKitti(const std::vector<TextLine>& rows) {
  try {
    return ReadKittiRows(rows);
  } catch (const std::runtime_error& error) {
    if (AreMostlyKitti(rows)) throw;
    throw NotATrajectory(error.what());
  }
}

// Converts the time stamps to seconds. `other`: the range of the other trajectory.
void ToSeconds(const std::string& path, const std::optional<TimeRange>& other, TrajectoryFile* file,
               std::vector<std::string>* warnings) {
  const TimeUnit unit = GuessTimeUnit(TimestampsOf(file->poses, &TimedPose::timestamp), other);
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

// Of comments above poses.
constexpr char kNotEstimated[] = "not estimated";
constexpr char kSegmentFormat[] = "segment %d, world %d";

}  // namespace

const char* ToString(TrajectoryFormat format) {
  return EnumName<TrajectoryFormat::kEuroc>(format, {"tum", "kitti", "euroc"});
}

std::vector<std::string> TrajectoryFormatNames() { return EnumNames<TrajectoryFormat::kEuroc>(); }

std::optional<TrajectoryFormat> TrajectoryFormatFromName(const std::string& name) {
  return EnumFromName<TrajectoryFormat::kEuroc>(name);
}

void TrajectoryFile::LeaveOut(double time) {
  ++num_left_out;
  if (std::isfinite(time)) times_left_out.push_back(time);
}

std::string TrajectoryFile::DescribeLeftOut() const {
  constexpr char kReason[] = "with nan, inf or a zero quaternion";
  if (num_left_out == 0) return "";
  return num_left_out == 1 ? FormatText("1 row %s is left out", kReason)
                           : FormatText("%d rows %s are left out", num_left_out, kReason);
}

std::string TrajectoryFile::DescribeLack() const {
  if (!poses.empty()) return "";
  const std::string reason =
      num_left_out > 0 ? DescribeLeftOut() : "it is empty or has only comments";
  return "has no poses: " + reason + "; give a file with rows such as 'time tx ty tz qx qy qz qw'";
}

TrajectoryFile ReadTrajectoryFile(const std::string& path, std::optional<TrajectoryFormat> format) {
  if (format == TrajectoryFormat::kKitti) return ReadKitti(ReadTextLines(path));
  PoseRows rows = ReadPoseRows(path, format.has_value());
  if (!format && !rows.named) {
    if (IsKitti(rows.rows)) return ReadKitti(rows.rows);
    RefuseMatrices(rows.rows);
  }
  return ReadPoseTable(std::move(rows), format);
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
    std::vector<double> stamps = TimestampsOf(file.poses, &TimedPose::timestamp);
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
                             ": has rows with nan, inf or a zero quaternion, so that it cannot be "
                             "compared row by row with " +
                             without + ", which has no time stamps; correct these rows");
  }
  CopyStamps(timed, reference->has_stamps ? estimate : reference);
}

std::string FormatPoseComment(const TimedPose& pose, int segment, int world) {
  std::string comment;
  if (pose.segment != segment || pose.world != world) {
    comment = FormatText(kSegmentFormat, pose.segment, pose.world);
  }
  if (!pose.is_estimated) comment += (comment.empty() ? "" : ", ") + std::string(kNotEstimated);
  return comment;
}

void ReadPoseComment(const std::string& comment, TimedPose* pose) {
  pose->is_estimated = !HasEnding(comment, kNotEstimated);
  int segment = 0, world = 0;
  if (std::sscanf(comment.c_str(), kSegmentFormat, &segment, &world) != 2) return;
  pose->segment = segment;
  pose->world = world;
}

}  // namespace msc_vo
