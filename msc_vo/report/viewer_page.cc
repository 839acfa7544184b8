// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/viewer_page.h"

#include "msc_vo/report/html_text.h"
#include "msc_vo/report/report.h"
#include "msc_vo/report/run_json.h"
#include "msc_vo/report/web_assets.h"

namespace msc_vo {

bool HasViewer() { return !kThreeScript.empty(); }

void WritePageHead(const std::string& title, PageConnections connections, std::ostream& out) {
  out << "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      << "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; connect-src "
      << (connections == PageConnections::kItsServer ? "'self'" : "'none'") << "\">\n<title>"
      << EscapeHtml(title) << "</title>\n<style>" << kReportStyle;
  out << kViewerStyle << "</style>\n</head>\n";
}

void WriteViewerElements(std::ostream& out) { out << kViewerHtml; }

void WriteViewerScripts(const std::string& run_json, std::ostream& out) {
  out << kRunDataElement << run_json << "</script>\n<script>\n";
  if (HasViewer()) {
    out << "/*\n" << kThreeLicense << "*/\n" << kThreeScript;
  } else {
    out << "const THREE = {Mesh: Object};  // lets the script load; startScene() returns null";
  }
  out << "\n</script>\n"
      << "<script>\n(() => {\n\"use strict\";\n"
      << kViewerScript << "})();\n</script>\n";
}

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
