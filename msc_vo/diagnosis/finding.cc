// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/finding.h"

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

Finding Make(Severity severity, const std::string& check, const std::string& text,
             const std::string& fix, const std::optional<Measurement>& measurement) {
  Finding finding;
  finding.severity = severity;
  finding.text = text;
  finding.check = check;
  finding.fix = fix;
  if (measurement) {
    finding.value = measurement->value;
    finding.unit = measurement->unit;
  }
  return finding;
}

}  // namespace

Finding Good(const std::string& check, const std::string& text,
             const std::optional<Measurement>& measurement) {
  return Make(Severity::kGood, check, text, "", measurement);
}

Finding Warning(const std::string& check, const std::string& text, const std::string& fix,
                const std::optional<Measurement>& measurement) {
  return Make(Severity::kWarning, check, text, fix, measurement);
}

Finding Error(const std::string& check, const std::string& text, const std::string& fix,
              const std::optional<Measurement>& measurement) {
  return Make(Severity::kError, check, text, fix, measurement);
}

const char* ToString(Severity severity) {
  return EnumName<Severity::kError>(severity, {"ok", "warning", "error"});
}

std::string Describe(const Finding& finding) {
  return finding.fix.empty() ? finding.text : finding.text + "; " + finding.fix;
}

}  // namespace msc_vo
