// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/viewer_page.h"

#include <sstream>

#include "fake_run.h"
#include <gmock/gmock.h>

#include "msc_vo/report/web_assets.h"

namespace msc_vo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Scripts(const std::string& run_json) {
  std::ostringstream out;
  WriteViewerScripts(run_json, out);
  return out.str();
}

TEST(ViewerPage, EmbedsItsFiles) {
  EXPECT_THAT(std::string(kReportStyle), HasSubstr("@media print"));
  EXPECT_THAT(std::string(kViewerStyle), HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(std::string(kViewerHtml), HasSubstr("id=\"time-slider\""));
  EXPECT_THAT(
      std::string(kViewerScript),
      AllOf(HasSubstr("class SceneView"), HasSubstr("startPage();"), Not(HasSubstr("</script"))));
}

// An element that the script asks for must exist.
TEST(ViewerPage, HasTheElementsOfItsScript) {
  const std::string script(kViewerScript);
  const std::string call = "byId(\"";
  int num_elements = 0;
  for (size_t at = script.find(call); at != std::string::npos; at = script.find(call, at + 1)) {
    const size_t begin = at + call.size();
    const std::string id = script.substr(begin, script.find('"', begin) - begin);
    if (id == "run-data" || id == "surface-data") continue;
    EXPECT_THAT(std::string(kViewerHtml), HasSubstr("id=\"" + id + "\""));
    ++num_elements;
  }
  EXPECT_GT(num_elements, 10);
}

TEST(ViewerPage, HasDataLicenceAndScript) {
  EXPECT_THAT(Scripts("{\"a\":1}"), AllOf(HasSubstr("id=\"run-data\">{\"a\":1}</script>"),
                                          HasSubstr("THREE"), HasSubstr("startPage();")));
  EXPECT_EQ(Scripts("{}").find("MIT License") != std::string::npos, HasViewer());
}

TEST(ViewerPage, LivePageAsksOnlyItsServer) {
  ReportData data = MakeFakeRun(0);
  data.title = "<room>";
  std::ostringstream out;
  WriteLivePage("0123abcd", data, out);
  EXPECT_THAT(out.str(),
              AllOf(HasSubstr("connect-src 'self'"), HasSubstr("&lt;room&gt; (live)"),
                    HasSubstr("data-chart=\"inliers\""), testing::EndsWith("</html>\n")));
  if (HasViewer()) {
    EXPECT_THAT(out.str(), HasSubstr("\"run\":\"0123abcd\""));
  }
}

}  // namespace
}  // namespace msc_vo
