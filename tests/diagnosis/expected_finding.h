// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <sstream>
#include <string>

#include "tests/support/message_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

// All findings, one in a line.
inline std::string Text(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += std::string(ToString(finding.severity)) + " [" + finding.check + "] " +
            Describe(finding) + "\n";
  }
  return text;
}

// Expects a finding of `check` with this severity whose text and fix match `names`, and returns it.
inline Finding ExpectFinding(const Findings& findings, Severity severity, const std::string& check,
                             const NamesMatcher& names, const std::string& name) {
  for (const Finding& finding : findings) {
    if (finding.severity == severity && finding.check == check &&
        names.MatchAndExplain(Describe(finding), nullptr)) {
      return finding;
    }
  }
  std::ostringstream expected;
  names.DescribeTo(&expected);
  ADD_FAILURE() << name << ": no " << ToString(severity) << " of " << check << " that "
                << expected.str() << " in\n"
                << Text(findings);
  return {};
}

}  // namespace msc_vo
