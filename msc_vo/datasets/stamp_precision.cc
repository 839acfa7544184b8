// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/stamp_precision.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// The value of the last digit of a number in scientific notation; none for other numbers.
std::optional<double> LastDigit(const std::string& text) {
  const size_t exponent_at = text.find_first_of("eE");
  if (exponent_at == std::string::npos) return std::nullopt;
  const std::optional<double> exponent = ParseNumber(text.substr(exponent_at + 1));
  if (!exponent) return std::nullopt;
  const size_t point = text.find('.');
  const size_t num_decimals = point < exponent_at ? exponent_at - point - 1 : 0;
  return std::pow(10.0, *exponent - static_cast<double>(num_decimals));
}

bool AreSinglePrecision(const std::vector<double>& values) {
  constexpr double kFirstWithoutFraction = 8388608.0;  // 2^23
  return std::all_of(values.begin(), values.end(), [](double value) {
    return value >= kFirstWithoutFraction &&
           value == static_cast<double>(static_cast<float>(value));
  });
}

}  // namespace

std::string DescribeLostDigits(const std::vector<std::string>& stamps) {
  std::vector<double> values;
  std::optional<double> finest;  // zeros at the end may be missing in some rows
  bool is_scientific = true;
  for (const std::string& stamp : stamps) {
    values.push_back(ParseNumber(stamp).value_or(0.0));
    const std::optional<double> digit = LastDigit(stamp);
    is_scientific = is_scientific && digit;
    if (digit) finest = std::min(*digit, finest.value_or(*digit));
  }
  if (values.size() < 2) return "";
  constexpr double kPrecision = 0.0015;  // seconds; a millisecond and its rounding
  const double rate = UnitsPerSecond(UnitOfDate(values.front()).value_or(GuessTimeUnit(values)));
  if (is_scientific && *finest / rate > kPrecision) {
    return FormatText(
        "the stamps are in scientific notation, such as %s, and tell only steps of %g s apart; "
        "write them with all digits",
        stamps.front().c_str(), *finest / rate);
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  if (2 * static_cast<size_t>(different) < values.size() && AreSinglePrecision(values)) {
    const auto value = static_cast<float>(values.front());
    return FormatText(
        "the stamps, such as %s, are rounded to single precision, which tells only steps of %g s "
        "apart; write them with all digits",
        stamps.front().c_str(), (std::nextafter(value, HUGE_VALF) - value) / rate);
  }
  return "";
}

std::vector<std::string> PadFractions(std::vector<std::string> fractions) {
  constexpr size_t kNanosecondDigits = 9;
  size_t width = 0;
  for (const std::string& digits : fractions) width = std::max(width, digits.size());
  if (width > kNanosecondDigits) return fractions;
  width = (width + 2) / 3 * 3;
  for (std::string& digits : fractions) digits.insert(0, width - digits.size(), '0');
  return fractions;
}

bool RestoreFractions(size_t field, std::vector<TextLine>* lines) {
  std::vector<std::string> seconds, fractions;
  std::vector<double> values, padded_values;
  for (const TextLine& line : *lines) {
    if (field >= line.fields.size()) return false;
    const std::string& stamp = line.fields[field];
    const size_t point = stamp.find('.');
    const bool is_decimal = stamp.find_first_not_of("0123456789.") == std::string::npos;
    if (point == std::string::npos || point + 1 == stamp.size() || !is_decimal) return false;
    seconds.push_back(stamp.substr(0, point + 1));
    fractions.push_back(stamp.substr(point + 1));
    values.push_back(ParseNumber(stamp).value_or(0.0));
  }
  fractions = PadFractions(std::move(fractions));
  for (size_t i = 0; i < seconds.size(); ++i) {
    padded_values.push_back(ParseNumber(seconds[i] + fractions[i]).value_or(0.0));
  }
  const auto ascend = [](const std::vector<double>& stamps) {
    return std::is_sorted(stamps.begin(), stamps.end());
  };
  if (ascend(values) || !ascend(padded_values)) return false;
  for (size_t i = 0; i < seconds.size(); ++i) (*lines)[i].fields[field] = seconds[i] + fractions[i];
  return true;
}

}  // namespace msc_vo
