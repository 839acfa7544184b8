// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using ::testing::AllOf;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// The points of the polyline with that class.
std::vector<Eigen::Vector2d> PolylineIn(const std::string& svg, const std::string& css_class) {
  const std::string opening = "<polyline class=\"" + css_class + "\" points=\"";
  const size_t begin = svg.find(opening);
  if (begin == std::string::npos) return {};
  const size_t first = begin + opening.size();
  std::istringstream text(svg.substr(first, svg.find('"', first) - first));
  std::vector<Eigen::Vector2d> points;
  Eigen::Vector2d point;
  char comma = 0;
  while (text >> point.x() >> comma >> point.y()) points.push_back(point);
  return points;
}

TEST(NiceTicks, AreRoundAndInside) {
  EXPECT_THAT(NiceTicks({-0.3, 1.1}, 8),
              ElementsAre(DoubleEq(-0.2), DoubleEq(0.0), DoubleEq(0.2), DoubleEq(0.4),
                          DoubleEq(0.2 * 3), DoubleEq(0.8), DoubleEq(1.0)));
  EXPECT_THAT(NiceTicks({0.0, 100.0}, 2), ElementsAre(0.0, 50.0, 100.0));
}

TEST(SvgPlot, MapsDataToTheAxes) {
  const SvgPlot plot({960, 240}, {0.0, 10.0}, {-1.0, 1.0});
  const Eigen::Vector2d low = plot.ToDrawing({0.0, -1.0});
  const Eigen::Vector2d high = plot.ToDrawing({10.0, 1.0});
  EXPECT_LT(low.x(), high.x());
  EXPECT_GT(low.y(), high.y());  // y of a drawing points down
  EXPECT_TRUE(plot.ToDrawing({5.0, 0.0}).isApprox(0.5 * (low + high)));
}

TEST(SvgPlot, DrawsSeriesAtDataCoordinates) {
  SvgPlot plot({960, 240}, {0.0, 3.0}, {0.0, 5.0});
  const std::vector<Eigen::Vector2d> data = {{0.0, 1.0}, {1.0, 4.0}, {2.0, 2.5}, {3.0, 0.0}};
  plot.AddSeries(data, "curve");
  const auto drawn = PolylineIn(plot.ToString("test"), "curve");
  ASSERT_EQ(drawn.size(), data.size());
  for (size_t i = 0; i < data.size(); ++i) {
    EXPECT_LT((drawn[i] - plot.ToDrawing(data[i])).norm(), 0.08);  // one decimal in the file
  }
}

TEST(SvgPlot, KeepsPeaksOfThinnedSeries) {
  SvgPlot plot({960, 240}, {0.0, 99999.0}, {-1.0, 10.0});
  std::vector<Eigen::Vector2d> data;
  for (int i = 0; i < 100000; ++i) data.emplace_back(i, std::sin(0.37 * i));
  data[31415].y() = 9.0;
  plot.AddSeries(data, "curve");
  const auto drawn = PolylineIn(plot.ToString("test"), "curve");
  EXPECT_LE(drawn.size(), 4u * 960u);
  EXPECT_GE(drawn.size(), 800u);
  const auto highest =
      *std::min_element(drawn.begin(), drawn.end(), [](auto& a, auto& b) { return a.y() < b.y(); });
  EXPECT_LT((highest - plot.ToDrawing(data[31415])).norm(), 0.08);
  EXPECT_TRUE(
      std::is_sorted(drawn.begin(), drawn.end(), [](auto& a, auto& b) { return a.x() < b.x(); }));
}

TEST(SvgPlot, KeepsTheEndOfThinnedPaths) {
  SvgPlot plot({600, 460}, {0.0, 1.0}, {0.0, 1.0});
  std::vector<Eigen::Vector2d> data;
  for (int i = 0; i <= 100000; ++i) data.emplace_back(i * 1e-5, i * 1e-5);
  plot.AddPath(data, "path");
  const auto drawn = PolylineIn(plot.ToString("test"), "path");
  EXPECT_LT(drawn.size(), 1500u);
  EXPECT_LT((drawn.back() - plot.ToDrawing({1.0, 1.0})).norm(), 0.08);
}

TEST(SvgPlot, EqualAxesHaveOneScaleAndContainBothRanges) {
  const SvgPlot plot = SvgPlot::WithEqualAxes({600, 460}, {-1.0, 1.0}, {0.0, 10.0});
  const Eigen::Vector2d origin = plot.ToDrawing({0.0, 0.0});
  EXPECT_NEAR(plot.ToDrawing({1.0, 0.0}).x() - origin.x(),
              origin.y() - plot.ToDrawing({0.0, 1.0}).y(), 1e-9);
  // The data have 530 x 402 drawing units inside the margins.
  EXPECT_NEAR(origin.x(), 56.0 + 0.5 * 530.0, 1e-9);
  EXPECT_NEAR(origin.y(), 18.0 + 402.0, 1e-9);
  EXPECT_NEAR(plot.ToDrawing({0.0, 10.0}).y(), 18.0, 1e-9);
  EXPECT_GT(plot.ToDrawing({-1.0, 0.0}).x(), 56.0);
}

TEST(SvgPlot, ClipsSegmentsAtTheAxes) {
  SvgPlot plot({600, 460}, {0.0, 1.0}, {0.0, 1.0});
  using Point = Eigen::Vector2d;
  plot.AddSegments({{Point(-1.0, 0.5), Point(3.0, 0.5)},    // through
                    {Point(0.5, 0.5), Point(0.5, 9.0)},     // out of the top
                    {Point(-1.0, 0.5), Point(0.5, 2.0)},    // past the corner
                    {Point(-1.0, -1.0), Point(-1.0, 2.0)}}  // beside
                   ,
                   "segments");
  const auto text = [&plot](double x, double y) {
    std::ostringstream out;
    const Point p = plot.ToDrawing({x, y});
    out << std::fixed << std::setprecision(1) << p.x() << ',' << p.y();
    return out.str();
  };
  EXPECT_THAT(plot.ToString("test"),
              HasSubstr("class=\"segments\" d=\"M" + text(0, 0.5) + 'L' + text(1, 0.5) + 'M' +
                        text(0.5, 0.5) + 'L' + text(0.5, 1) + "\""));
}

TEST(SvgPlot, SkipsNonFiniteValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SvgPlot plot({960, 240}, {0.0, 1.0}, {0.0, 1.0});
  plot.AddSeries({{0.0, 0.0}, {0.5, nan}, {1.0, 1.0}}, "series");
  plot.AddPath({{nan, 0.0}, {0.0, 0.0}, {1.0, 1.0}}, "path");
  plot.AddSegments({{Eigen::Vector2d(nan, 0.0), Eigen::Vector2d(1.0, 1.0)}}, "segments");
  plot.AddDots({{nan, nan}}, 1.0, "dots");
  const std::string svg = plot.ToString("test");
  EXPECT_EQ(PolylineIn(svg, "series").size(), 2u);
  EXPECT_EQ(PolylineIn(svg, "path").size(), 2u);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("segments")));
}

TEST(SvgPlot, WidensEmptyRanges) {
  const SvgPlot plot({960, 240}, {2.0, 2.0}, {0.0, 0.0});
  const Eigen::Vector2d drawn = plot.ToDrawing({2.0, 0.0});
  EXPECT_TRUE(drawn.allFinite());
  EXPECT_GT(drawn.x(), 56.0);  // inside the margins
  EXPECT_LT(drawn.x(), 960.0 - 14.0);
}

TEST(SvgPlot, PlacesLegendEntriesInARow) {
  SvgPlot plot({600, 400}, {0.0, 1.0}, {0.0, 1.0}, {10.0, 10.0, 10.0, 30.0});
  plot.AddLegend({{"first", "one"}, {"second", "<two>"}});
  EXPECT_THAT(plot.ToString("test"),
              AllOf(HasSubstr("<path class=\"first\" d=\"M10.0,386.0L30.0,386.0\"/>\n"
                              "<text class=\"name\" x=\"36.0\" y=\"390.0\">one</text>"),
                    HasSubstr("&lt;two&gt;</text>")));
}

TEST(SvgPlot, EscapesNamesAndTips) {
  SvgPlot plot({960, 240}, {0.0, 1.0}, {0.0, 1.0});
  plot.AddAxes("a<b", "c&d");
  plot.AddMarker({0.5, 0.5}, 2.0, "dot", "<\"tip\">");
  const std::string svg = plot.ToString("e'f");
  EXPECT_THAT(svg, HasSubstr("a&lt;b"));
  EXPECT_THAT(svg, HasSubstr("c&amp;d"));
  EXPECT_THAT(svg, HasSubstr("<title>&lt;&quot;tip&quot;&gt;</title>"));
  EXPECT_THAT(svg, HasSubstr("e&#39;f"));
}

}  // namespace
}  // namespace msc_vo
