// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

enum class Severity {
  kGood,     ///< no problem
  kWarning,  ///< valid, but a frequent sign of a mistake
  kError,    ///< replay would fail, or its result would be useless
};

/// Result of one check, in a sentence for the user.
struct Finding {
  Severity severity = Severity::kGood;
  std::string text;             ///< what was measured, with its numbers
  std::string check;            ///< name of the check for programs: "depth.scale"
  std::string fix;              ///< what to do about it; empty if there is nothing to do
  std::optional<double> value;  ///< the number that decided, in `unit`
  std::string unit;             ///< "m", "px", "s", "ratio"; empty without a value
};

using Findings = std::vector<Finding>;

/// Number with its unit, for Finding::value.
struct Measurement {
  double value = 0.0;
  std::string unit;
};

Finding Good(const std::string& check, const std::string& text,
             const std::optional<Measurement>& measurement = std::nullopt);
Finding Warning(const std::string& check, const std::string& text, const std::string& fix,
                const std::optional<Measurement>& measurement = std::nullopt);
Finding Error(const std::string& check, const std::string& text, const std::string& fix,
              const std::optional<Measurement>& measurement = std::nullopt);

/// Makes a finding of a given severity; drops `fix` for kGood.
Finding MakeFinding(Severity severity, const std::string& check, const std::string& text,
                    const std::string& fix, const std::optional<Measurement>& measurement);

/// Name of a severity for files: "ok", "warning" or "error".
const char* ToString(Severity severity);

/// The finding in one line: the text, and the fix behind a semicolon.
std::string Describe(const Finding& finding);

}  // namespace msc_vo
