// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/live_page.h"

#include "msc_vo/report/html_text.h"
#include "msc_vo/report/run_json.h"
#include "msc_vo/report/viewer_page.h"

namespace msc_vo {

void WriteLivePage(const std::string& run, const ReportData& data, std::ostream& out) {
  WritePageHead(data.title + " (live)", PageConnections::kItsServer, out);
  out << "<body>\n<h1>" << EscapeHtml(data.title) << "</h1>\n<p><code>"
      << EscapeHtml(data.command_line) << "</code></p>\n"
      << "<noscript><p>The live view needs JavaScript.</p></noscript>\n";
  WriteViewerElements(out);
  out << "<h2>Inliers over time</h2>\n<figure data-chart=\"inliers\"></figure>\n"
         "<h2>Standard deviation of the position over time</h2>\n"
         "<figure data-chart=\"sigma\"></figure>\n"
         "<h2>Time per frame</h2>\n<figure data-chart=\"stages\"></figure>\n";
  WriteViewerScripts(FormatLiveRunJson(run, data), out);
  out << "</body>\n</html>\n";
}

}  // namespace msc_vo
