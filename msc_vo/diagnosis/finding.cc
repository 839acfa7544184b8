// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/finding.h"

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

Finding MakeFinding(Severity severity, const std::string& check, const std::string& text,
                    const std::string& fix, const std::optional<Measurement>& measurement) {
  Finding finding{severity, text, check, severity == Severity::kGood ? "" : fix, {}, {}};
  if (measurement) {
    finding.value = measurement->value;
    finding.unit = measurement->unit;
  }
  return finding;
}

Finding Good(const std::string& check, const std::string& text,
             const std::optional<Measurement>& measurement) {
  return MakeFinding(Severity::kGood, check, text, "", measurement);
}

Finding Warning(const std::string& check, const std::string& text, const std::string& fix,
                const std::optional<Measurement>& measurement) {
  return MakeFinding(Severity::kWarning, check, text, fix, measurement);
}

Finding Error(const std::string& check, const std::string& text, const std::string& fix,
              const std::optional<Measurement>& measurement) {
  return MakeFinding(Severity::kError, check, text, fix, measurement);
}

const char* ToString(Severity severity) {
  return EnumName<Severity::kError>(severity, {"ok", "warning", "error"});
}

std::string Describe(const Finding& finding) {
  return finding.fix.empty() ? finding.text : finding.text + "; " + finding.fix;
}

}  // namespace msc_vo
