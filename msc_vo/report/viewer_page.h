// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <ostream>
#include <string>

namespace msc_vo {

struct ReportData;

/// The opening tags of the data of a run, and of the surface that may stand before it.
inline constexpr char kRunDataElement[] = "<script type=\"application/json\" id=\"run-data\">";
inline constexpr char kSurfaceDataElement[] =
    "<script type=\"application/json\" id=\"surface-data\">";

/// Other addresses that a page may talk to.
enum class PageConnections { kNone, kItsServer };

/// Writes the beginning of a page up to <body>: title, style, and a policy that keeps the browser
/// from loading anything else.
void WritePageHead(const std::string& title, PageConnections connections, std::ostream& out);

/// Writes the elements of the interactive part, hidden until its script runs.
void WriteViewerElements(std::ostream& out);

/// Writes the data block and the scripts, at the end of <body>.
void WriteViewerScripts(const std::string& run_json, std::ostream& out);

/// Writes the page of a run that is going on, which asks its server for data (see web/live.js):
/// GET data, POST control, and GET report once the run is finished. `run` identifies the run. Of
/// `data`, title, command line, stages, camera and up direction are used. Requires HasViewer().
void WriteLivePage(const std::string& run, const ReportData& data, std::ostream& out);

}  // namespace msc_vo
