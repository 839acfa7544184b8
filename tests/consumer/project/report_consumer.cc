// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Writes a report of one frame and looks for it.

#include <sstream>

#include "msc_vo/report/report.h"

int main() {
  msc_vo::ReportData data;
  data.title = "one frame";
  data.frames.resize(1);
  std::ostringstream out;
  msc_vo::WriteReport(data, out);
  return out.str().find("<h1>one frame</h1>") != std::string::npos ? 0 : 1;
}
