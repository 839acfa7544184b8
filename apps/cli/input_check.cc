// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/input_check.h"

#include <stdexcept>

#include "msc_vo/diagnosis/sequence_check.h"

namespace msc_vo {

std::vector<std::string> CheckBeforeRun(const RgbdDecoder& decoder, const std::string& advice) {
  std::vector<std::string> warnings;
  for (const Finding& finding : CheckSequenceQuickly(decoder)) {
    if (finding.severity == Severity::kError) {
      throw std::runtime_error(decoder.index().directory + ": " + Describe(finding) + " (" +
                               advice + ")");
    }
    warnings.push_back(Describe(finding));
  }
  return warnings;
}

}  // namespace msc_vo
