// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/trajectory_comparison.h"

#include <gmock/gmock.h>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// A turn about z through half a turn, which jumps from 180 to -180 degrees.
TrajectoryComparison Turning() {
  TrajectoryComparison comparison;
  comparison.title = "turn <1>";
  comparison.command_line = "msc_vo evaluate a b";
  comparison.numbers = {{"APE RMSE", "1.000 mm", "alignment se3"}};
  for (int i = 0; i < 50; ++i) {
    const Eigen::Quaterniond rotation = ExpSO3({0.0, 0.0, 2.5 + 0.03 * i});
    comparison.reference.push_back({100.0 + 0.1 * i, Rigid3(rotation, {0.1 * i, 1.0, 0.02 * i})});
    comparison.estimate.push_back({100.0 + 0.1 * i, Rigid3(rotation, {0.1 * i, 1.01, 0.02 * i})});
    comparison.ape.push_back(0.01);
  }
  comparison.ape_rmse = comparison.ape_mean = comparison.ape_median = 0.01;
  return comparison;
}

TEST(RollPitchYaw, InvertsTheProductOfRotations) {
  const double roll = 0.3, pitch = -0.4, yaw = 2.0;
  const Eigen::Quaterniond rotation =
      ExpSO3({0.0, 0.0, yaw}) * ExpSO3({0.0, pitch, 0.0}) * ExpSO3({roll, 0.0, 0.0});
  const Eigen::Vector3d angles = RollPitchYaw(rotation);
  EXPECT_NEAR(angles[0], RadiansToDegrees(roll), 1e-9);
  EXPECT_NEAR(angles[1], RadiansToDegrees(pitch), 1e-9);
  EXPECT_NEAR(angles[2], RadiansToDegrees(yaw), 1e-9);
}

TEST(TrajectoryComparison, PlotsEverythingOnOnePage) {
  const TrajectoryComparison turning = Turning();
  const std::string html = FormatPageHtml(ComparisonPage(turning));
  EXPECT_THAT(
      html,
      AllOf(HasSubstr("<title>turn &lt;1&gt;</title>"), HasSubstr(turning.numbers[0].value),
            HasSubstr(turning.command_line), HasSubstr(">roll, degrees<"), HasSubstr(">APE, mm<"),
            HasSubstr(">time, s<"), Not(HasSubstr("<script")), Not(HasSubstr("http"))));
  EXPECT_EQ(Count(html, "<figure>"), 10);  // three planes, APE, position, rotation
  EXPECT_EQ(Count(html, "<figure>"), Count(html, "</figure>"));
  EXPECT_EQ(Count(html, "<div"), Count(html, "</div>"));
}

TEST(TrajectoryComparison, WritesOneSvgWithThePlots) {
  const std::string svg = FormatPageSvg(ComparisonPage(Turning()));
  EXPECT_THAT(svg, testing::StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_EQ(Count(svg, "<svg"), Count(svg, "</svg>"));
  EXPECT_EQ(Count(svg, "role=\"img\""), 10);
}

TEST(TrajectoryComparison, DrawsAnglesWithoutJumps) {
  // The yaw passes 180 degrees, so the axis must have ticks on both sides of it.
  const std::string html = FormatPageHtml(ComparisonPage(Turning()));
  const std::string yaw = html.substr(html.find(">yaw, degrees<") - 4000, 4000);
  EXPECT_THAT(yaw, AllOf(HasSubstr(">160<"), HasSubstr(">200<"), Not(HasSubstr(">-160<"))));
}

TEST(TrajectoryComparison, NumbersPosesWithoutStamps) {
  TrajectoryComparison comparison = Turning();
  comparison.has_stamps = false;
  EXPECT_THAT(FormatPageHtml(ComparisonPage(comparison)),
              AllOf(HasSubstr(">pose<"), Not(HasSubstr(">time, s<"))));
  EXPECT_THAT(FormatPageHtml(ComparisonPage({})), HasSubstr("</html>"));
}

}  // namespace
}  // namespace msc_vo
