// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ostream>
#include <string>

#include "msc_vo/report/report.h"

namespace msc_vo {

/// Writes the page of a run that is going on, which asks its server for data (see web/live.js):
/// GET data, POST control, and GET report once the run is finished. `run` identifies the run. Of
/// `data`, title, command line, stages, camera and up direction are used. Requires HasViewer().
void WriteLivePage(const std::string& run, const ReportData& data, std::ostream& out);

}  // namespace msc_vo
