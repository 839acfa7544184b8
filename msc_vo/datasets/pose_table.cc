// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/pose_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr size_t kFieldsPerPose = 8;
constexpr char kTumColumns[] = "'time tx ty tz qx qy qz qw'";

bool IsScalarFirst(const PoseColumns& columns) {
  return columns.quaternion[3] < columns.quaternion[0];
}

// The values of a row: time, nanoseconds, position, quaternion x y z w; std::nullopt if a field is
// no number. Columns that do not exist are 0.
std::optional<std::array<double, 9>> ParseRow(const TextLine& line, const PoseColumns& columns,
                                              std::string* not_a_number) {
  std::array<double, 9> values = {};
  const auto parse = [&](size_t column, double* value) {
    const std::optional<double> number = ParseNumber(line.fields[column]);
    if (!number) *not_a_number = line.fields[column];
    *value = number.value_or(0.0);
    return number.has_value();
  };
  bool is_valid = !columns.time || parse(*columns.time, &values[0]);
  is_valid = is_valid && (!columns.nanoseconds || parse(*columns.nanoseconds, &values[1]));
  for (size_t i = 0; i < 3; ++i) is_valid = is_valid && parse(columns.position[i], &values[2 + i]);
  for (size_t i = 0; i < 4; ++i) {
    is_valid = is_valid && parse(columns.quaternion[i], &values[5 + i]);
  }
  return is_valid ? std::optional(values) : std::nullopt;
}

Eigen::Quaterniond QuaternionOf(const std::array<double, 9>& values) {
  return {values[8], values[5], values[6], values[7]};
}

// Tests for a row without a pose, as programs write for lost frames.
bool IsLost(const std::array<double, 9>& values) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return !std::all_of(values.begin(), values.end(), is_finite) ||
         QuaternionOf(values).coeffs().isZero(0.0);
}

// Whether the row has the columns, and a quaternion in them.
bool Fits(const PoseColumns& columns, const TextLine& line) {
  std::string ignored;
  if (line.fields.size() < columns.MinColumns()) return false;
  const auto values = ParseRow(line, columns, &ignored);
  return values && (IsLost(*values) || IsUnitQuaternion(QuaternionOf(*values).coeffs()));
}

bool Fits(const PoseColumns& columns, const std::vector<TextLine>& rows) {
  return std::all_of(rows.begin(), rows.end(),
                     [&](const TextLine& line) { return Fits(columns, line); });
}

// The finite numbers of a column; empty if a row has no number there.
std::vector<double> NumbersOf(const std::vector<TextLine>& rows, size_t column) {
  std::vector<double> numbers;
  for (const TextLine& line : rows) {
    const auto number =
        column < line.fields.size() ? ParseNumber(line.fields[column]) : std::nullopt;
    if (!number) return {};
    if (std::isfinite(*number)) numbers.push_back(*number);
  }
  return numbers;
}

PoseColumns Moved(PoseColumns columns, size_t from, size_t to) {
  const auto move = [&](size_t* column) { *column = *column + to - from; };
  if (columns.time) move(&*columns.time);
  if (columns.nanoseconds) move(&*columns.nanoseconds);
  for (size_t& column : columns.position) move(&column);
  for (size_t& column : columns.quaternion) move(&column);
  return columns;
}

size_t FirstColumn(const PoseColumns& columns) {
  const size_t first =
      std::min(*std::min_element(columns.position.begin(), columns.position.end()),
               *std::min_element(columns.quaternion.begin(), columns.quaternion.end()));
  return std::min({first, columns.time.value_or(first), columns.nanoseconds.value_or(first)});
}

// The columns of a position before a quaternion w x y z, if they are named as a quaternion x y z w
// before a position: "x y z w x y z" names both.
PoseColumns PositionFirst(PoseColumns columns) {
  const std::array<size_t, 4> q = columns.quaternion;
  const std::array<size_t, 3> t = columns.position;
  if (std::array<size_t, 3>{q[0] + 4, q[1] + 4, q[2] + 4} != t || q[3] != q[0] + 3) return columns;
  columns.position = {q[0], q[1], q[2]};
  columns.quaternion = {t[0], t[1], t[2], q[3]};
  return columns;
}

// The named columns; and moved, if rows have another number of columns: a row may begin with a
// number that the header does not name, and a header with other words.
std::vector<PoseColumns> NamedCandidates(const PoseColumns& named, size_t num_fields) {
  std::vector<PoseColumns> candidates = {named, PositionFirst(named)};
  if (num_fields + FirstColumn(named) >= named.num_names && num_fields != named.num_names) {
    candidates.push_back(Moved(named, named.num_names, num_fields));
  }
  return candidates;
}

// The largest deviation from unit length of four neighbouring columns, over all rows with numbers
// there.
double QuaternionError(const std::vector<TextLine>& rows, size_t begin) {
  double worst = 0.0;
  for (const TextLine& line : rows) {
    double squared = 0.0;
    for (size_t column = begin; column < begin + 4; ++column) {
      const bool exists = column < line.fields.size();
      const double value = exists ? ParseNumber(line.fields[column]).value_or(HUGE_VAL) : HUGE_VAL;
      squared += value * value;
    }
    if (std::isfinite(squared)) worst = std::max(worst, std::abs(std::sqrt(squared) - 1.0));
  }
  return worst;
}

// Throws if the length of other columns is much nearer to 1 than that of the quaternions. Short
// vectors beside the scalar of a quaternion have unit length by chance.
void RefuseOtherQuaternions(const std::vector<TextLine>& rows, const PoseColumns& columns) {
  constexpr double kRounding = 2e-3;  // of components with three decimals
  const size_t own = *std::min_element(columns.quaternion.begin(), columns.quaternion.end());
  const double error = QuaternionError(rows, own);
  if (error < kRounding) return;
  for (size_t other = columns.time.value_or(0) + 1; other + 4 <= rows.front().fields.size();
       ++other) {
    if (other == own || QuaternionError(rows, other) > 0.1 * error) continue;
    throw NotATrajectory(
        rows.front().Where() +
        FormatText(": columns %zu-%zu rather than %zu-%zu have the length of a quaternion; name "
                   "the columns in a header, '# time qx qy qz qw tx ty tz'",
                   other + 1, other + 4, own + 1, own + 4));
  }
}

// Columns in the order of a format.
PoseColumns FormatColumns(bool is_scalar_first) {
  PoseColumns columns;
  columns.time = 0;
  if (is_scalar_first) columns.quaternion = {5, 6, 7, 4};
  return columns;
}

// Comma-separated rows with nanoseconds are those of EuRoC. Poses 1 to 5 ms apart could be
// microseconds at 1 to 5 s, which is implausible.
bool LooksLikeEuroc(const std::vector<TextLine>& rows) {
  constexpr double kShortest = 1e6;  // nanoseconds
  const std::vector<double> first = NumbersOf(rows, 0);
  if (!rows.front().has_delimiters || first.empty()) return false;
  const TimeUnit unit = GuessTimeUnit(first);
  return unit == TimeUnit::kNanoseconds ||
         (unit == TimeUnit::kMicroseconds && !UnitOfDate(first.front()) &&
          MedianInterval(first) >= kShortest);
}

std::vector<PoseColumns> UnnamedCandidates(const std::vector<TextLine>& rows,
                                           std::optional<TrajectoryFormat> format) {
  const std::vector<double> first = NumbersOf(rows, 0), second = NumbersOf(rows, 1);
  const bool is_scalar_first = format ? *format == TrajectoryFormat::kEuroc : LooksLikeEuroc(rows);
  const PoseColumns columns = FormatColumns(is_scalar_first);
  PoseColumns numbered = Moved(columns, 0, 1);
  const auto is_date = [](const std::vector<double>& stamps) {
    return !stamps.empty() && UnitOfDate(stamps.front()).has_value();
  };
  if ((is_date(first) && !is_date(second)) ||
      (AreFrameNumbers(second) && !AreFrameNumbers(first))) {
    numbered.time = 0;
  }
  if (!format && rows.front().fields.size() < kFieldsPerPose) {  // no time stamps
    PoseColumns timeless = Moved(columns, 1, 0);
    timeless.time.reset();
    return {columns, timeless};
  }
  const bool is_long = rows.front().fields.size() >= numbered.MinColumns();
  if (is_long && is_date(second) && !is_date(first)) return {numbered, columns};
  return {columns, numbered};
}

// Throws if the stamps, as they are written in the file, do not tell most poses apart because they
// lost digits.
void CheckStampPrecision(const std::string& path, const std::vector<std::string>& stamps,
                         const std::vector<TimedPose>& sorted) {
  size_t num_repeated = 0;
  for (size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].timestamp == sorted[i - 1].timestamp) ++num_repeated;
  }
  if (2 * num_repeated <= sorted.size()) return;
  const std::string problem = DescribeLostDigits(stamps);
  if (!problem.empty()) throw NotATrajectory(path + ": " + problem);
}

class TableReader {
 public:
  TableReader(PoseRows table, std::optional<TrajectoryFormat> format)
      : rows_(std::move(table.rows)), format_(format) {
    std::vector<PoseColumns> candidates;
    if (table.named && !format) {
      candidates = NamedCandidates(*table.named, rows_.front().fields.size());
    }
    const size_t num_named = candidates.size();
    for (const PoseColumns& columns : UnnamedCandidates(rows_, format)) {
      candidates.push_back(columns);
    }
    const auto found =
        std::find_if(candidates.begin(), candidates.end(),
                     [&](const PoseColumns& columns) { return Fits(columns, rows_); });
    // If no columns fit, the first ones tell which row is wrong.
    const auto chosen = found == candidates.end() ? candidates.begin() : found;
    is_named_ = static_cast<size_t>(chosen - candidates.begin()) < num_named;
    columns_ = *chosen;
    if (!is_named_ && !format) RefuseOtherQuaternions(rows_, columns_);
    if (columns_.time && !columns_.nanoseconds) RestoreFractions(*columns_.time, &rows_);
  }

  // Whether at most half of the rows do not fit, so that these are damaged.
  bool MostRowsFit() const {
    const auto num_fitting = std::count_if(
        rows_.begin(), rows_.end(), [&](const TextLine& line) { return Fits(columns_, line); });
    return 2 * static_cast<size_t>(num_fitting) >= rows_.size();
  }

  TrajectoryFile Read() {
    TrajectoryFile file;
    const bool is_euroc = IsScalarFirst(columns_) && (!is_named_ || rows_.front().has_delimiters);
    file.format = is_euroc ? TrajectoryFormat::kEuroc : TrajectoryFormat::kTum;
    file.has_stamps = columns_.time.has_value();
    file.unit = columns_.unit;
    // The header of EuRoC need not name the unit.
    const bool lacks_unit = !file.unit && columns_.time == 0u && LooksLikeEuroc(rows_);
    if (is_euroc && (!is_named_ || lacks_unit)) {
      file.unit = TimeUnit::kNanoseconds;
    }
    const double rate = UnitsPerSecond(file.unit.value_or(TimeUnit::kSeconds));
    TimedPose pose;
    std::vector<std::string> stamps;
    for (size_t row = 0; row < rows_.size(); ++row) {
      ReadPoseComment(rows_[row].comment, &pose);
      const bool has_pose = ReadRow(rows_[row], rate, &pose);
      if (!file.has_stamps) pose.timestamp = static_cast<double>(row);
      if (!has_pose) {
        file.LeaveOut(pose.timestamp);
        continue;
      }
      if (columns_.time) stamps.push_back(rows_[row].fields[*columns_.time]);
      file.poses.push_back(pose);
    }
    SortByTime(&file.poses);
    CheckStampPrecision(rows_.front().file, stamps, file.poses);
    return file;
  }

 private:
  // Sets the time, and the pose if the row holds one; returns whether it does.
  bool ReadRow(const TextLine& line, double rate, TimedPose* pose) const {
    CheckNumFields(line);
    std::string field;
    const auto values = ParseRow(line, columns_, &field);
    if (!values) line.Fail("'" + field + "' is not a number; correct or remove the line");
    const std::array<double, 9>& v = *values;
    pose->timestamp = v[0] / rate + v[1] / UnitsPerSecond(TimeUnit::kNanoseconds);
    if (IsLost(v)) return false;
    const Eigen::Quaterniond rotation = QuaternionOf(v);
    if (!IsUnitQuaternion(rotation.coeffs())) FailQuaternion(line, rotation.norm());
    if (v[1] < 0.0 || v[1] >= UnitsPerSecond(TimeUnit::kNanoseconds)) {
      line.Fail(FormatNumber(v[1]) +
                " is not the nanoseconds after a whole second; name only one column of time");
    }
    pose->world_from_cam =
        Rigid3(rotation.normalized(), columns_.metres * Eigen::Vector3d(v[2], v[3], v[4]));
    return true;
  }

  void CheckNumFields(const TextLine& line) const {
    const std::string found = ", found " + std::to_string(line.fields.size());
    if (is_named_) {
      if (line.fields.size() >= columns_.MinColumns()) return;
      line.Fail("expected at least " + std::to_string(columns_.MinColumns()) +
                " fields, which the header names" + found + "; correct the line");
    }
    const size_t expected = std::max(rows_.front().fields.size(), columns_.MinColumns());
    if (line.fields.size() == expected) return;
    if (expected == kFieldsPerPose) {
      line.Fail(std::string("expected 8 numbers ") + kTumColumns + found +
                " fields; correct the line");
    }
    line.Fail("expected " + std::to_string(expected) + " fields, as in the first row" + found +
              " fields; correct the line");
  }

  [[noreturn]] void FailQuaternion(const TextLine& line, double norm) const {
    if (!is_named_ && line.fields.size() > kFieldsPerPose) {
      line.Fail(std::string("expected 8 numbers ") + kTumColumns + ", found " +
                std::to_string(line.fields.size()) +
                " fields, none of which are a quaternion; name the columns in a header, '# time tx "
                "ty tz qx qy qz qw'");
    }
    line.Fail(
        FormatText("the quaternion %s has length %.3f instead of 1; correct or remove the line",
                   IsScalarFirst(columns_) ? "qw qx qy qz" : "qx qy qz qw", norm));
  }

  std::vector<TextLine> rows_;
  std::optional<TrajectoryFormat> format_;
  PoseColumns columns_;
  bool is_named_ = false;
};

// Whether all fields between blanks or semicolons are numbers with a decimal comma, "-0,5".
bool HasDecimalCommas(std::string line) {
  std::replace(line.begin(), line.end(), ';', ' ');
  std::istringstream fields(line);
  int count = 0;
  for (std::string field; fields >> field; ++count) {
    const size_t comma = field.find(',');
    if (comma == std::string::npos || comma + 1 == field.size()) return false;
    field[comma] = '.';
    if (!ParseNumber(field)) return false;
  }
  return count > 1;
}

}  // namespace

bool IsUnitQuaternion(const Eigen::Vector4d& components) {
  // Larger than the rounding of components with two decimals.
  constexpr double kMaxError = 0.05;
  return std::abs(components.norm() - 1.0) <= kMaxError;
}

PoseRows ReadPoseRows(const std::string& path, bool any_header) {
  PoseRows table;
  std::istringstream content(ReadText(path));
  int header_end = 0;
  std::optional<TextLine> nameless;  // the first line of the header that names no columns
  std::string text;
  for (int number = 1; std::getline(content, text); ++number) {
    const std::vector<std::string> fields = SplitFields(text);
    if (fields.empty()) continue;
    const bool is_comment = fields[0][0] == '#';
    if (!is_comment && HasDecimalCommas(text)) {
      throw NotATrajectory(TextLine{path, number, fields, ""}.Where() +
                           ": has decimal commas; write points");
    }
    const auto is_number = [](const std::string& field) { return ParseNumber(field).has_value(); };
    if (!is_comment && std::any_of(fields.begin(), fields.end(), is_number)) break;
    const std::optional<PoseColumns> columns = FindPoseColumns(text);
    if (columns) table.named = columns;
    if (is_comment) continue;
    header_end = number;
    if (!columns && !nameless && fields[0][0] != '%') nameless = {path, number, fields, ""};
  }
  if (nameless && !table.named && !any_header) {
    throw NotATrajectory(nameless->Where() +
                         ": names no columns of a trajectory; name them as in " + kTumColumns +
                         ", or begin the line with #");
  }
  for (TextLine& line : ReadTextLines(path)) {
    if (line.number > header_end) table.rows.push_back(std::move(line));
  }
  return table;
}

TrajectoryFile ReadPoseTable(PoseRows rows, std::optional<TrajectoryFormat> format) {
  if (rows.rows.empty()) {
    TrajectoryFile file;
    file.format = format.value_or(TrajectoryFormat::kTum);
    return file;
  }
  TableReader reader(std::move(rows), format);
  try {
    return reader.Read();
  } catch (const std::runtime_error& error) {
    if (reader.MostRowsFit()) throw;
    throw NotATrajectory(error.what());
  }
}

}  // namespace msc_vo
