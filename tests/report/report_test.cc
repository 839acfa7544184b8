// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report.h"

#include <limits>
#include <regex>
#include <sstream>

#include "fake_run.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "msc_vo/report/web_assets.h"

namespace msc_vo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Lt;
using ::testing::Not;

std::string ReportOf(const ReportData& data) {
  std::ostringstream out;
  WriteReport(data, out);
  return out.str();
}

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Report, ShowsTitleNumbersAndOptions) {
  const std::string html = ReportOf(MakeFakeRun(300));
  EXPECT_THAT(html, AllOf(HasSubstr("<h1>a figure of eight</h1>\n"
                                    "<p><code>msc_vo replay eight --out eight-out</code></p>\n"),
                          HasSubstr("<div><dt>APE RMSE</dt><dd class=\"value\">12.3 mm</dd>"
                                    "<dd class=\"note\">after SE(3) alignment</dd></div>\n"),
                          HasSubstr("<pre>mode: pl-vo-depth\n</pre>"),
                          HasSubstr("<footer>msc_vo 0.1.0</footer>")));
}

TEST(Report, HasItsSectionsInOrder) {
  const std::string html = ReportOf(MakeFakeRun(300));
  const std::regex heading("<h2>([^<]*)</h2>");
  std::vector<std::string> headings;
  for (auto it = std::sregex_iterator(html.begin(), html.end(), heading);
       it != std::sregex_iterator(); ++it) {
    headings.push_back((*it)[1]);
  }
  EXPECT_THAT(headings,
              ElementsAre("Trajectory", "Position error over time", "Inliers and status over time",
                          "Frames without an estimated pose", "Time per frame", "Time per keyframe",
                          "Stages", "Options"));
}

TEST(Report, ListsFramesWithoutAnEstimatedPose) {
  EXPECT_THAT(ReportOf(MakeFakeRun(300)),
              HasSubstr("<tr><th>frames</th><th>from, s</th><th>to, s</th><th>predicted</th>"
                        "<th>lost</th></tr>\n"
                        "<tr><td>50 to 59</td><td>1.67</td><td>1.97</td><td>5</td><td>5</td>"
                        "</tr>\n</table>"));
}

TEST(Report, ListsTimesOfStages) {
  ReportData data = MakeFakeRun(4);
  data.stages = {{"features"}, {"pose"}};
  for (size_t i = 0; i < 4; ++i) {
    data.frames[i].stage_ms = {10.0 + static_cast<double>(i), 2.0};
    data.frames[i].tracking_ms = 20.0;
    data.frames[i].mapping_ms = i == 0 ? 50.0 : 0.0;
  }
  EXPECT_THAT(
      ReportOf(data),
      HasSubstr("<th>95 %</th><th>max</th><th>times</th></tr>\n"
                "<tr><td>features</td><td>11.50</td><td>11.00</td><td>13.00</td><td>13.00</td>"
                "<td>4</td></tr>\n"
                "<tr><td>pose</td><td>2.00</td><td>2.00</td><td>2.00</td><td>2.00</td>"
                "<td>4</td></tr>\n"
                "<tr><td>tracking</td><td>20.00</td><td>20.00</td><td>20.00</td><td>20.00</td>"
                "<td>4</td></tr>\n"
                "<tr><td>mapping</td><td>50.00</td><td>50.00</td><td>50.00</td><td>50.00</td>"
                "<td>1</td></tr>\n</table>"));
}

// The page without the contents of its scripts.
std::string WithoutScripts(const std::string& html) {
  std::string rest;
  size_t at = 0;
  for (size_t begin; (begin = html.find("<script", at)) != std::string::npos;) {
    const size_t body = html.find('>', begin) + 1;
    rest += html.substr(at, body - at);
    at = html.find("</script>", body);
  }
  return rest + html.substr(at);
}

TEST(Report, IsSelfContained) {
  const std::string html = WithoutScripts(ReportOf(MakeFakeRun(100)));
  for (const char* text : {"http:", "https:", "url(", "@import", " src=", " href=", "<link"}) {
    EXPECT_THAT(html, Not(HasSubstr(text)));
  }
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(Report, ShowsTheTrajectoryWithoutScripts) {
  const std::string html = ReportOf(MakeFakeRun(100));
  const std::string page = html.substr(0, html.find("<script"));
  EXPECT_EQ(CountOf(page, "data-zoom"), CountOf(page, " view of the trajectory\""));
  EXPECT_EQ(CountOf(page, "data-zoom"), 2);
  EXPECT_THAT(page, HasSubstr("</footer>"));
}

// The page has a figure for every plot over time of the script, except the one of the live view.
TEST(Report, HasThePlotsOfItsScript) {
  const std::string page = ReportOf(MakeFakeRun(100));
  for (const std::string name : {"error", "inliers", "stages", "mapping"}) {
    EXPECT_THAT(std::string(kViewerScript), HasSubstr("\n  " + name + ": {"));
    EXPECT_EQ(CountOf(page, "<figure data-chart=\"" + name + "\">"), 1) << name;
  }
}

TEST(Report, ClosesEveryElement) {
  const std::string html = WithoutScripts(ReportOf(MakeFakeRun(100)));
  for (const std::string name : {"html", "body", "svg", "figure", "table", "tr", "td", "div", "dl",
                                 "ul", "li", "text", "g", "title", "pre", "details"}) {
    const std::regex opening("<" + name + "[ >]");
    const auto begin = std::sregex_iterator(html.begin(), html.end(), opening);
    EXPECT_EQ(std::distance(begin, std::sregex_iterator()), CountOf(html, "</" + name + ">"))
        << name;
  }
}

TEST(Report, EscapesText) {
  ReportData data = MakeFakeRun(10);
  const std::string evil = "<b>&\"";
  data.title = data.version = data.command_line = data.options_text = evil;
  data.numbers = {{evil, evil, evil}};
  data.stages[2].name = evil;
  const std::string html = WithoutScripts(ReportOf(data));
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  // title, h1, command line, three of the number, options, version; stage: legend and table.
  EXPECT_EQ(CountOf(html, "&lt;b&gt;&amp;&quot;"), 10);
}

TEST(Report, ShowsLongValuesInATable) {
  ReportData data = MakeFakeRun(10);
  data.numbers = {{"Short", "1 mm", ""}, {"Long", "21.4 ms per frame (median 20.9)", ""}};
  const std::string html = ReportOf(data);
  EXPECT_THAT(html, HasSubstr("<dd class=\"value\">1 mm</dd>"));
  EXPECT_THAT(html, HasSubstr("<th>Long</th><td>21.4 ms per frame (median 20.9)</td>"));
}

TEST(Report, StaysSmallOnLongRuns) {
  // The static page, without scripts and their data.
  EXPECT_LT(WithoutScripts(ReportOf(MakeFakeRun(5000))).size(), 2'000'000u);
}

// The bound of docs/usage.md, with a map and views that are as large as they may be.
TEST(Report, StaysBelow15MegabytesFor5000Frames) {
  ReportData data = MakeFakeRun(5000);
  data.map.lines.resize(20'000, data.map.lines.front());
  data.map.points.resize(200'000, Eigen::Vector3d::Ones());
  FrameView view;
  view.jpeg.assign(6000, '\xa5');
  view.features.points.resize(600);
  view.features.lines.resize(100);
  constexpr size_t kMaxViewBytes = 5 << 20;  // FrameViewLimits::max_bytes
  for (size_t bytes = 0; bytes + NumBytes(view) <= kMaxViewBytes; bytes += NumBytes(view)) {
    view.frame = static_cast<int>(data.views.size());
    data.views.push_back(view);
  }
  EXPECT_GT(data.views.size(), 500u);
  EXPECT_LT(ReportOf(data).size(), 15'000'000u);
}

TEST(Report, IsDeterministic) { EXPECT_EQ(ReportOf(MakeFakeRun(200)), ReportOf(MakeFakeRun(200))); }

TEST(Report, ListsWhatWasSelfCalibrated) {
  ReportData data = MakeFakeRun(10);
  EXPECT_THAT(ReportOf(data), Not(HasSubstr("Self-calibration")));
  data.self_calibration = {{"Readout time", "26.0 ms", "given"}};
  EXPECT_THAT(ReportOf(data), HasSubstr("<h2>Self-calibration</h2>\n<table class=\"facts\">\n"
                                        "<tr><th>Readout time</th><td>26.0 ms</td>"
                                        "<td class=\"note\">given</td></tr>"));
}

TEST(Report, OmitsErrorsWithoutGroundTruth) {
  ReportData data = MakeFakeRun(100);
  data.ground_truth.clear();
  for (ReportFrame& frame : data.frames) frame.position_error.reset();
  const std::string html = WithoutScripts(ReportOf(data));
  EXPECT_THAT(html, Not(HasSubstr("ground truth</li>")));
  EXPECT_THAT(html, Not(HasSubstr("Position error")));
}

TEST(Report, LegendsContainOnlyWhatOccurs) {
  const std::string mixed = ReportOf(MakeFakeRun(100));
  EXPECT_THAT(
      mixed, AllOf(HasSubstr("</svg>weak</li>"), HasSubstr("</svg>lost</li>"),
                   HasSubstr("</svg>map lines along Manhattan axis 1</li>"),
                   HasSubstr("</svg>map lines along Manhattan axis 3</li>"),
                   Not(HasSubstr("</svg>dropped</li>")), Not(HasSubstr("map lines without axis"))));
  const std::string good = ReportOf(MakeFakeRun(40));
  EXPECT_THAT(good, AllOf(HasSubstr("</svg>tracked</li>"), Not(HasSubstr("</svg>weak</li>")),
                          Not(HasSubstr("</svg>lost</li>"))));
}

TEST(Report, DoesNotStackParallelStages) {
  ReportData data = MakeFakeRun(10);
  data.stages = {{"left", false}, {"right", false}, {"both"}, {"rest"}};
  for (ReportFrame& frame : data.frames) {
    frame.stage_ms = {9.0, 8.0, 9.5, 0.5};
    frame.tracking_ms = 10.0;
  }
  const std::string html = ReportOf(data);
  EXPECT_THAT(html, AllOf(HasSubstr("</svg>both</li>"), HasSubstr("</svg>rest</li>"),
                          Not(HasSubstr("</svg>left</li>")), HasSubstr("<td>left</td>")));
}

TEST(Report, ShowsTheMapAroundANearlyStaticCamera) {
  ReportData data = MakeFakeRun(40);
  for (ReportFrame& frame : data.frames) frame.world_from_cam.translation() *= 0.01;
  for (ReportGroundTruthPose& pose : data.ground_truth) pose.position *= 0.01;
  const std::string html = ReportOf(data);
  // All edges of the room and of the box are inside of the drawing.
  const std::regex segment("M([0-9.-]+),([0-9.-]+)L([0-9.-]+),([0-9.-]+)");
  const size_t begin = html.find("Top view of the trajectory");
  ASSERT_NE(begin, std::string::npos);
  const std::string plot = html.substr(begin, html.find("</svg>", begin) - begin);
  const std::regex map_line("class=\"map-line axis-[^\"]*\" d=\"([^\"]*)\"");
  std::string drawn;
  for (auto it = std::sregex_iterator(plot.begin(), plot.end(), map_line);
       it != std::sregex_iterator(); ++it) {
    drawn += (*it)[1];
  }
  int num_segments = 0;
  for (auto it = std::sregex_iterator(drawn.begin(), drawn.end(), segment);
       it != std::sregex_iterator(); ++it, ++num_segments) {
    for (const int x : {1, 3}) EXPECT_THAT(std::stod((*it)[x]), AllOf(Gt(0.0), Lt(600.0)));
    for (const int y : {2, 4}) EXPECT_THAT(std::stod((*it)[y]), AllOf(Gt(0.0), Lt(460.0)));
  }
  EXPECT_EQ(num_segments, 24);
}

TEST(Report, ListsNoSpansIfAllFramesAreTracked) {
  EXPECT_THAT(ReportOf(MakeFakeRun(40)), HasSubstr("estimated pose</h2>\n<p>None.</p>"));
}

TEST(Report, SkipsNonFiniteValues) {
  EXPECT_THAT(ReportOf(ReportData{}), HasSubstr("No frame was processed"));
  EXPECT_THAT(ReportOf(MakeFakeRun(1)), HasSubstr("</html>"));
  ReportData data = MakeFakeRun(20);
  data.frames[0].world_from_cam.params.setConstant(std::numeric_limits<double>::quiet_NaN());
  data.frames[1].tracking_ms = std::numeric_limits<double>::infinity();
  data.map.lines[0].segment.start.setConstant(std::numeric_limits<double>::quiet_NaN());
  data.ground_truth[3].position.setConstant(std::numeric_limits<double>::quiet_NaN());
  // FormatFixed writes a dash for non-finite values; no coordinate may be one.
  EXPECT_FALSE(std::regex_search(ReportOf(data), std::regex("[ML \"]-,|,-[ML \"]|=\"-\"")));
}

TEST(Report, RejectsStageTimesOfWrongSize) {
  ReportData data = MakeFakeRun(10);
  data.frames[7].stage_ms.pop_back();
  EXPECT_THAT([&] { ReportOf(data); },
              ::testing::ThrowsMessage<std::invalid_argument>(HasSubstr("frame 7 has 4")));
}

}  // namespace
}  // namespace msc_vo
