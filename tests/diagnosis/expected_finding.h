// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

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

// Expects a finding of `check` with this severity whose text or fix contains `words`.
inline void ExpectFinding(const Findings& findings, Severity severity, const std::string& check,
                          const std::string& words, const std::string& name) {
  for (const Finding& finding : findings) {
    if (finding.severity == severity && finding.check == check &&
        Describe(finding).find(words) != std::string::npos) {
      return;
    }
  }
  ADD_FAILURE() << name << ": no " << ToString(severity) << " of " << check << " with '" << words
                << "' in\n"
                << Text(findings);
}

}  // namespace msc_vo
