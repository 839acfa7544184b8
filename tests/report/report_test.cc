// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report.h"

#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "fake_run.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "msc_vo/report/web_assets.h"

namespace msc_vo {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
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

// The texts of the elements of this name, without the elements in them.
std::vector<std::string> TextsOf(const std::string& html, const std::string& name) {
  const std::string page = WithoutScripts(html);
  const std::regex opening("<" + name + "(>| [^>]*>)");
  std::vector<std::string> texts;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), opening);
       it != std::sregex_iterator(); ++it) {
    const size_t begin = it->position() + it->length();
    const std::string content = page.substr(begin, page.find("</" + name + ">", begin) - begin);
    texts.push_back(std::regex_replace(content, std::regex("<[^>]*>"), ""));
  }
  return texts;
}

// The cells of each row of the tables, without cells of headings.
std::vector<std::vector<std::string>> RowsOf(const std::string& html) {
  std::vector<std::vector<std::string>> rows;
  for (size_t at = html.find("<tr>"); at != std::string::npos; at = html.find("<tr>", at + 1)) {
    rows.push_back(TextsOf(html.substr(at, html.find("</tr>", at) - at), "td"));
  }
  return rows;
}

TEST(Report, ShowsTitleNumbersAndOptions) {
  const ReportData data = MakeFakeRun(300);
  const std::string html = ReportOf(data);
  EXPECT_THAT(TextsOf(html, "h1"), ElementsAre(data.title));
  EXPECT_THAT(TextsOf(html, "code"), ElementsAre(data.command_line));
  EXPECT_THAT(TextsOf(html, "dt"), ElementsAre(data.numbers[0].name, data.numbers[1].name));
  EXPECT_THAT(TextsOf(html, "dd"),
              IsSupersetOf({data.numbers[0].value, data.numbers[0].note, data.numbers[1].value}));
  EXPECT_THAT(TextsOf(html, "pre"), ElementsAre(data.options_text));
  EXPECT_THAT(TextsOf(html, "footer"), ElementsAre(data.version));
}

TEST(Report, HasItsSectionsInOrder) {
  const std::string html = WithoutScripts(ReportOf(MakeFakeRun(300)));
  // What each section shows, under a heading of its own.
  size_t at = html.find("<h2>");
  for (const char* content :
       {"<figure data-zoom", "data-chart=\"error\"", "data-chart=\"inliers\"", "<table",
        "data-chart=\"stages\"", "data-chart=\"mapping\"", "<table", "<pre>"}) {
    ASSERT_NE(at, std::string::npos) << content;
    const size_t next = html.find("<h2>", at + 1);
    EXPECT_NE(html.substr(at, next - at).find(content), std::string::npos) << content;
    at = next;
  }
  EXPECT_EQ(at, std::string::npos);
}

TEST(Report, ListsFramesWithoutAnEstimatedPose) {
  EXPECT_THAT(RowsOf(ReportOf(MakeFakeRun(300))),
              Contains(ElementsAre(Names("50", "59"), "1.67", "1.97", "5", "5")));
}

TEST(Report, ListsTimesOfStages) {
  ReportData data = MakeFakeRun(4);
  data.stages = {{"features"}, {"pose"}};
  for (size_t i = 0; i < 4; ++i) {
    data.frames[i].stage_ms = {10.0 + static_cast<double>(i), 2.0};
    data.frames[i].tracking_ms = 20.0;
    data.frames[i].mapping_ms = i == 0 ? 50.0 : 0.0;
  }
  // Mean, median, 95 %, maximum, count.
  EXPECT_THAT(RowsOf(ReportOf(data)),
              IsSupersetOf({ElementsAre("features", "11.50", "11.00", "13.00", "13.00", "4"),
                            ElementsAre("pose", "2.00", "2.00", "2.00", "2.00", "4"),
                            ElementsAre("tracking", "20.00", "20.00", "20.00", "20.00", "4"),
                            ElementsAre("mapping", "50.00", "50.00", "50.00", "50.00", "1")}));
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
  EXPECT_THAT(TextsOf(html, "dd"), Contains(data.numbers[0].value));
  EXPECT_THAT(TextsOf(html, "th"), Contains(data.numbers[1].name));
  EXPECT_THAT(TextsOf(html, "td"), Contains(data.numbers[1].value));
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
  const size_t num_sections = TextsOf(ReportOf(data), "h2").size();
  data.self_calibration = {{"Readout time", "26.0 ms", "given"}};
  const std::string html = ReportOf(data);
  EXPECT_EQ(TextsOf(html, "h2").size(), num_sections + 1);
  EXPECT_THAT(TextsOf(html, "th"), Contains(data.self_calibration[0].name));
  EXPECT_THAT(RowsOf(html), Contains(ElementsAre("26.0 ms", "given")));
}

TEST(Report, OmitsErrorsWithoutGroundTruth) {
  ReportData data = MakeFakeRun(100);
  data.ground_truth.clear();
  for (ReportFrame& frame : data.frames) frame.position_error.reset();
  const std::string html = WithoutScripts(ReportOf(data));
  EXPECT_EQ(CountOf(html, "class=\"curve ground-truth\""), 0);
  EXPECT_EQ(CountOf(html, "data-chart=\"error\""), 0);
  const std::string with_truth = WithoutScripts(ReportOf(MakeFakeRun(100)));
  EXPECT_GT(CountOf(with_truth, "class=\"curve ground-truth\""), 0);
  EXPECT_EQ(TextsOf(html, "h2").size() + 1, TextsOf(with_truth, "h2").size());
}

TEST(Report, LegendsContainOnlyWhatOccurs) {
  const std::string mixed = ReportOf(MakeFakeRun(100));
  EXPECT_THAT(TextsOf(mixed, "li"),
              AllOf(IsSupersetOf({"weak", "lost"}), Not(Contains("dropped"))));
  const auto legend_of_lines = [&](const std::string& axis) {
    return CountOf(mixed, "<path class=\"map-line axis-" + axis + "\" d=\"M0 5H18\"/>");
  };
  for (const char* axis : {"0", "1", "2"}) EXPECT_EQ(legend_of_lines(axis), 1) << axis;
  EXPECT_EQ(legend_of_lines("none"), 0);
  const std::string good = ReportOf(MakeFakeRun(40));
  EXPECT_THAT(TextsOf(good, "li"),
              AllOf(Contains("tracked"), Not(Contains("weak")), Not(Contains("lost"))));
}

TEST(Report, DrawsSubmapsInColorsOfTheirOwn) {
  ReportData data = MakeFakeRun(100);
  const auto paths = [](const std::string& html, const std::string& css_class) {
    return CountOf(WithoutScripts(html), "<polyline class=\"" + css_class + "\"");
  };
  const std::string one = ReportOf(data);
  EXPECT_EQ(paths(one, "curve estimate"), 2);  // top and side view
  EXPECT_EQ(paths(one, "curve submap-1"), 0);
  EXPECT_THAT(TextsOf(one, "li"), Contains("estimate"));
  for (int i = 0; i < 100; ++i) data.frames[i].submap = i < 10 ? kNoSubMapNumber : i < 60 ? 2 : 5;
  const std::string two = ReportOf(data);
  EXPECT_EQ(paths(two, "curve estimate"), 2);
  EXPECT_EQ(paths(two, "curve submap-1"), 2);
  EXPECT_THAT(TextsOf(two, "li"),
              AllOf(IsSupersetOf({"submap 2, from frame 10", "submap 5, from frame 60"}),
                    Not(Contains("estimate"))));
}

TEST(Report, DrawsThePathBeforeLoopsAndThoseOfEarlierSessions) {
  ReportData data = MakeFakeRun(100);
  const auto count = [&](const std::string& text) {
    return CountOf(WithoutScripts(ReportOf(data)), text);
  };
  for (const char* name : {"curve odometry", "curve session-", "class=\"found\""}) {
    EXPECT_EQ(count(name), 0) << name;
  }
  for (const ReportFrame& frame : data.frames) {
    data.odometry.emplace_back(1.01 * frame.world_from_cam.translation());
  }
  data.map.sessions = {{"monday", {{0, 0, 0}, {1, 0, 0}}}, {"tuesday", {{0, 1, 0}, {1, 1, 0}}}};
  data.found_frame = 30;
  EXPECT_EQ(count("<polyline class=\"curve odometry\""), 2);  // top and side view
  EXPECT_EQ(count("<polyline class=\"curve session-1\""), 2);
  EXPECT_EQ(count("<circle class=\"found\""), 2);
  EXPECT_THAT(TextsOf(ReportOf(data), "li"),
              IsSupersetOf({"before loops were closed", "earlier session: monday",
                            "earlier session: tuesday", "found in the map: frame 30, 1.00 s"}));
  data.odometry[50].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(count("<polyline class=\"curve odometry\""), 4);  // a gap
}

TEST(Report, ShowsTheMapOfARunWithoutPoses) {
  ReportData data = MakeFakeRun(20);
  data.map.sessions = {{"monday", {{0, 0, 0}, {1, 0, 0}}}};
  for (ReportFrame& frame : data.frames) frame.submap = kNoSubMapNumber;
  const std::string html = WithoutScripts(ReportOf(data));
  EXPECT_EQ(CountOf(html, "class=\"curve estimate\""), 0);
  EXPECT_EQ(CountOf(html, "<circle class=\"start\""), 0);
  EXPECT_EQ(CountOf(html, "<polyline class=\"curve session-0\""), 2);
}

TEST(Report, DoesNotStackParallelStages) {
  ReportData data = MakeFakeRun(10);
  data.stages = {{"left", false}, {"right", false}, {"both"}, {"rest"}};
  for (ReportFrame& frame : data.frames) {
    frame.stage_ms = {9.0, 8.0, 9.5, 0.5};
    frame.tracking_ms = 10.0;
  }
  const std::string html = ReportOf(data);
  EXPECT_THAT(TextsOf(html, "li"), AllOf(IsSupersetOf({"both", "rest"}), Not(Contains("left"))));
  EXPECT_THAT(TextsOf(html, "td"), Contains("left"));
}

TEST(Report, ShowsTheMapAroundANearlyStaticCamera) {
  ReportData data = MakeFakeRun(40);
  for (ReportFrame& frame : data.frames) frame.world_from_cam.translation() *= 0.01;
  for (ReportGroundTruthPose& pose : data.ground_truth) pose.position *= 0.01;
  const std::string html = ReportOf(data);
  // All edges of the room and of the box are inside of the drawing.
  const std::regex segment("M([0-9.-]+),([0-9.-]+)L([0-9.-]+),([0-9.-]+)");
  const size_t begin = html.find("role=\"img\"", html.find("<figure data-zoom"));
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
  const std::string tracked = ReportOf(MakeFakeRun(40)), lost = ReportOf(MakeFakeRun(100));
  EXPECT_EQ(TextsOf(tracked, "h2").size(), TextsOf(lost, "h2").size());
  EXPECT_EQ(CountOf(tracked, "<table") + 1, CountOf(lost, "<table"));
}

TEST(Report, SkipsNonFiniteValues) {
  EXPECT_THAT(ReportOf(ReportData{}), HasSubstr("</html>"));
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
              ::testing::ThrowsMessage<std::invalid_argument>(Names("frame 7", "4")));
}

}  // namespace
}  // namespace msc_vo
