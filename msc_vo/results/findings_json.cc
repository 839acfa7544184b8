// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/findings_json.h"

#include <algorithm>

#include "msc_vo/results/internal/json_value.h"

namespace msc_vo {

namespace {

Json ToJson(const Finding& finding) {
  Json json = {{"check", finding.check}, {"severity", ToString(finding.severity)},
               {"text", finding.text},   {"fix", nullptr},
               {"value", nullptr},       {"unit", nullptr}};
  if (!finding.fix.empty()) json["fix"] = finding.fix;
  if (finding.value) {
    json["value"] = *finding.value;
    json["unit"] = finding.unit;
  }
  return json;
}

}  // namespace

std::string FormatFindingsJson(const SequenceIndex& sequence, const Findings& findings) {
  const auto count = [&](Severity severity) {
    return std::count_if(findings.begin(), findings.end(), [severity](const Finding& finding) {
      return finding.severity == severity;
    });
  };
  Json list = Json::array();
  for (const Finding& finding : findings) list.push_back(ToJson(finding));
  return FormatJson({{"sequence", sequence.directory},
                     {"format", sequence.format},
                     {"errors", count(Severity::kError)},
                     {"warnings", count(Severity::kWarning)},
                     {"findings", list}});
}

}  // namespace msc_vo
