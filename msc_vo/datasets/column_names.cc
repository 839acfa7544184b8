// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/column_names.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <utility>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

using Words = std::vector<std::string>;

constexpr char kAxes[] = "xyzw";

// A column as its header describes it: "p_RS_R_x [m]".
struct ColumnName {
  std::string name;
  std::string unit;
};

bool IsOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool HasOneOf(const Words& words, std::initializer_list<const char*> wanted) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return IsOneOf(word, wanted); });
}

bool IsAxis(const std::string& word) {
  return word.size() == 1 && std::string(kAxes).find(word) != std::string::npos;
}

// Appends what brackets contain: the components of the last name, "position (x, y, z)" or
// "q(wxyz)", or its unit.
void AddBracket(const std::string& content, std::vector<ColumnName>* names) {
  if (names->empty()) return;
  std::string axes;
  for (const std::string& part : SplitFields(content)) axes += part;
  if (axes.size() < 3 || axes.find_first_not_of(kAxes) != std::string::npos) {
    if (names->back().unit.empty()) names->back().unit = Lowercase(Trimmed(content));
    return;
  }
  const std::string name = names->back().name;
  names->pop_back();
  for (const char axis : axes) names->push_back({name + "_" + axis, ""});
}

// The end of a bracket that begins at a position; npos if none does, or in a name such as "q[0]".
size_t EndOfBracket(const std::string& header, size_t begin) {
  const char c = header[begin];
  if (c != '[' && c != '(') return std::string::npos;
  const size_t end = header.find(c == '[' ? ']' : ')', begin);
  const bool is_index =
      end == begin + 2 && std::isdigit(static_cast<unsigned char>(header[begin + 1])) != 0;
  return is_index ? std::string::npos : end;
}

// Splits a header at the separators; what stands in brackets is no name.
std::vector<ColumnName> SplitHeader(const std::string& header, const std::string& separators) {
  std::vector<ColumnName> names;
  bool is_new = true;
  for (size_t i = 0; i < header.size(); ++i) {
    const char c = header[i];
    const size_t end = EndOfBracket(header, i);
    if (end != std::string::npos) {
      AddBracket(header.substr(i + 1, end - i - 1), &names);
      i = end;
    } else if (separators.find(c) != std::string::npos) {
      // Nothing between two delimiters is a column without a name.
      if (is_new && c != ' ' && c != '\t') names.push_back({});
      is_new = true;
    } else if (is_new && std::isspace(static_cast<unsigned char>(c)) == 0) {
      names.push_back({std::string(1, c), ""});
      is_new = false;
    } else if (!is_new) {
      names.back().name += c;
    }
  }
  return names;
}

// "field.pose.positionX" as field, pose, position, x.
Words SplitWords(const std::string& name) {
  Words words;
  bool was_lower = false, was_word = false;
  for (const char letter : name) {
    const auto c = static_cast<unsigned char>(letter);
    const bool is_word = std::isalnum(c) != 0;
    const bool is_upper = std::isupper(c) != 0;
    if (is_word && (!was_word || (was_lower && is_upper))) words.emplace_back();
    if (is_word) words.back() += static_cast<char>(std::tolower(c));
    was_lower = is_word && !is_upper;
    was_word = is_word;
  }
  return words;
}

std::optional<TimeUnit> TimeUnitFromName(const std::string& name) {
  if (IsOneOf(name, {"s", "sec", "secs", "second", "seconds"})) return TimeUnit::kSeconds;
  if (IsOneOf(name, {"ms", "msec", "msecs", "millisecond", "milliseconds"})) {
    return TimeUnit::kMilliseconds;
  }
  if (IsOneOf(name, {"us", "usec", "usecs", "\xC2\xB5s", "microsecond", "microseconds"})) {
    return TimeUnit::kMicroseconds;
  }
  if (IsOneOf(name, {"ns", "nsec", "nsecs", "nanosec", "nanosecs", "nanosecond", "nanoseconds"})) {
    return TimeUnit::kNanoseconds;
  }
  return std::nullopt;
}

double MetresFromName(const std::string& unit) {
  if (IsOneOf(unit, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"})) return 1e-3;
  return IsOneOf(unit, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"}) ? 1e-2
                                                                                         : 1.0;
}

// Whether a name describes another quantity than a pose or a time: a velocity, a variance.
bool IsOtherQuantity(const Words& words, const std::string& unit) {
  return unit.find("/s") != std::string::npos || unit.find("s^-") != std::string::npos ||
         HasOneOf(words, {"vel",      "velocity", "speed",   "acc",   "accel",   "acceleration",
                          "linear",   "angular",  "twist",   "gyr",   "gyro",    "omega",
                          "bias",     "cov",      "std",     "sigma", "var",     "covariance",
                          "variance", "gravity",  "scale",   "mag",   "error",   "euler",
                          "exposure", "duration", "latency", "delay", "tracking"});
}

enum class Quantity { kOther, kBare, kPosition, kQuaternion };

// The quantity that the words before the axis name.
Quantity QuantityOf(const Words& words) {
  if (HasOneOf(words, {"q", "quat", "quaternion", "rot", "rotation", "ori", "orient", "orientation",
                       "att", "attitude"})) {
    return Quantity::kQuaternion;
  }
  for (const std::string& word : words) {
    if (IsOneOf(word, {"v", "a", "w", "b", "g"})) return Quantity::kOther;
    if (IsOneOf(word, {"r", "o"})) return Quantity::kQuaternion;
    if (IsOneOf(word, {"p", "t", "pos", "position", "trans", "translation", "loc", "location"})) {
      return Quantity::kPosition;
    }
  }
  return Quantity::kBare;
}

// Splits the number from a component: "q0", "q[0]", "position[2]". Quaternions by number begin with
// the scalar.
std::optional<size_t> TakeNumber(Words* words) {
  std::string& last = words->back();
  if (last.back() < '0' || last.back() > '3') return std::nullopt;
  const size_t number = static_cast<size_t>(last.back() - '0');
  Words rest = *words;
  rest.back().pop_back();
  const Quantity quantity = QuantityOf(rest);
  if (quantity == Quantity::kBare || quantity == Quantity::kOther) return std::nullopt;
  *words = rest;
  return quantity == Quantity::kQuaternion ? (number + 3) % 4 : number;
}

// Splits the axis from the words of a name: "pos x", "x pos", "tx", "q0". Returns std::nullopt if
// they name none.
std::optional<size_t> TakeAxis(Words* words) {
  const auto index = [](char axis) { return std::string(kAxes).find(axis); };
  std::string& last = words->back();
  if (IsAxis(last) || IsAxis(words->front())) {
    const auto axis = IsAxis(last) ? words->end() - 1 : words->begin();
    const char letter = axis->front();
    words->erase(axis);
    return index(letter);
  }
  const std::string stem = last.substr(0, last.size() - 1);
  const bool is_known = QuantityOf({stem}) != Quantity::kBare || IsOtherQuantity({stem}, "");
  if (index(last.back()) == std::string::npos || !is_known) return TakeNumber(words);
  const size_t axis = index(last.back());
  last = stem;
  return axis;
}

// Assigns columns to the components of a pose, from left to right.
class ColumnAssignment {
 public:
  void Add(const ColumnName& column, size_t index) {
    Words words = SplitWords(column.name);
    if (words.empty()) return;
    std::string unit = column.unit;
    if (words.size() > 1 && (TimeUnitFromName(words.back()) || words.back() == "m" ||
                             MetresFromName(words.back()) != 1.0)) {
      if (unit.empty()) unit = words.back();
      words.pop_back();
    }
    if (IsOtherQuantity(words, unit)) {
      last_ = Quantity::kOther;
      return;
    }
    const Words all = words;
    if (const std::optional<size_t> axis = TakeAxis(&words)) {
      AddAxis(words, *axis, unit, index);
    } else {
      AddTime(all, unit, index);
    }
  }

  std::optional<PoseColumns> Result(size_t num_names) {
    PoseColumns columns;
    for (size_t i = 0; i < 3; ++i) {
      if (!position_[i]) return std::nullopt;
      columns.position[i] = *position_[i];
    }
    for (size_t i = 0; i < 4; ++i) {
      if (!quaternion_[i]) return std::nullopt;
      columns.quaternion[i] = *quaternion_[i];
    }
    columns.time = time_ ? time_ : number_;
    columns.unit = unit_;
    if (nanoseconds_ && unit_ == TimeUnit::kSeconds) columns.nanoseconds = nanoseconds_;
    columns.metres = metres_;
    columns.num_names = num_names;
    return columns;
  }

 private:
  using Components = std::array<std::optional<size_t>, 4>;

  // The quantity of an axis without a name: that of the column before, "p_x, y, z", or the first
  // one that lacks it.
  Quantity Complete(size_t axis) const {
    if (axis == 3) return Quantity::kQuaternion;
    if (last_ == Quantity::kQuaternion && !quaternion_[axis]) return Quantity::kQuaternion;
    return position_[axis] ? Quantity::kQuaternion : Quantity::kPosition;
  }

  // "x y z w" without other names is a quaternion; OptiTrack's "x y z" of the position follows it.
  void TakeBareQuaternion(size_t w) {
    for (size_t i = 0; i < 3; ++i) {
      if (position_[i] != w - 3 + i || quaternion_[i]) return;
    }
    std::swap(position_, quaternion_);
  }

  void AddAxis(const Words& words, size_t axis, const std::string& unit, size_t index) {
    Quantity quantity = QuantityOf(words);
    num_bare_ = quantity == Quantity::kBare ? num_bare_ + 1 : 0;
    if (axis == 3 && num_bare_ > 3) TakeBareQuaternion(index);
    if (quantity == Quantity::kBare) quantity = Complete(axis);
    last_ = quantity;
    if (quantity == Quantity::kOther || (quantity == Quantity::kPosition && axis == 3)) return;
    Components& components = quantity == Quantity::kPosition ? position_ : quaternion_;
    if (!components[axis]) components[axis] = index;
    // A unit may be named once: "x [mm], y, z".
    if (quantity == Quantity::kPosition && !unit.empty()) metres_ = MetresFromName(unit);
  }

  void AddTime(const Words& words, const std::string& unit, size_t index) {
    last_ = Quantity::kOther;
    std::optional<TimeUnit> named = TimeUnitFromName(unit);
    if (!named && words.size() == 1) named = TimeUnitFromName(words[0]);  // "secs"
    int rank = 0;
    if (HasOneOf(words, {"time", "t"}) || named) rank = 1;
    if (words == Words{"time"} || words == Words{"t"}) rank = 2;
    if (HasOneOf(words, {"timestamp", "stamp", "ts", "tstamp"})) rank = 3;
    if (rank == 0) {
      const bool is_number =
          words.size() <= 2 && HasOneOf(words, {"index", "idx", "id", "num", "number", "nr", "no",
                                                "n", "i", "seq", "frame", "frames", "count"});
      if (is_number && !number_) number_ = index;
    } else if (rank == rank_ && unit_ == TimeUnit::kSeconds && named == TimeUnit::kNanoseconds) {
      nanoseconds_ = index;
    } else if (rank > rank_) {
      time_ = index;
      unit_ = named;
      rank_ = rank;
      nanoseconds_.reset();
    }
  }

  Components position_, quaternion_;
  std::optional<size_t> time_, nanoseconds_, number_;
  std::optional<TimeUnit> unit_;
  double metres_ = 1.0;
  int rank_ = 0;
  Quantity last_ = Quantity::kOther;
  int num_bare_ = 0;  // axes without other names since the last one with such
};

}  // namespace

size_t PoseColumns::MinColumns() const {
  size_t last = std::max(time.value_or(0), nanoseconds.value_or(0));
  for (const size_t column : position) last = std::max(last, column);
  for (const size_t column : quaternion) last = std::max(last, column);
  return last + 1;
}

std::optional<PoseColumns> FindPoseColumns(const std::string& header) {
  const size_t begin = header.find_first_not_of("#%/! \t\r\n");
  if (begin == std::string::npos) return std::nullopt;
  const std::string text = header.substr(begin);
  // Names may contain blanks if commas, semicolons or tabs separate them.
  for (const char* separators : {",;\t\r\n", ",;\t \r\n"}) {
    const std::vector<ColumnName> names = SplitHeader(text, separators);
    ColumnAssignment assignment;
    for (size_t i = 0; i < names.size(); ++i) assignment.Add(names[i], i);
    if (const auto columns = assignment.Result(names.size())) return columns;
  }
  return std::nullopt;
}

}  // namespace msc_vo
