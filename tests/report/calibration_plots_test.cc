// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/calibration_plots.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Errors that grow with the radius and with the depth.
std::vector<CalibrationResidual> Growing(double factor) {
  std::vector<CalibrationResidual> residuals;
  for (int i = 1; i <= 240; ++i) {
    residuals.push_back({1.0 * i, 0.01 * factor * i, 0.02 * i, 1e-4 * factor * i});
  }
  return residuals;
}

TEST(CalibrationPlots, ShowsPixelsAndDepth) {
  const std::vector<PlotFigure> figures = PlotResiduals({Growing(1.0), Growing(0.5)});
  ASSERT_EQ(figures.size(), 4U);
  EXPECT_THAT(figures[0].heading, HasSubstr("Reprojection"));
  EXPECT_THAT(figures[2].heading, HasSubstr("Depth"));
  for (const PlotFigure& figure : figures) {
    EXPECT_THAT(figure.svg,
                AllOf(HasSubstr(">given<"), HasSubstr(">estimated<"), Not(HasSubstr("nan"))));
  }
  EXPECT_THAT(figures[1].svg, HasSubstr(", px<"));
  EXPECT_THAT(figures[3].svg, HasSubstr(", %<"));
}

TEST(CalibrationPlots, ShowsTheGivenCalibrationAloneIfNothingIsCorrected) {
  const std::vector<PlotFigure> figures = PlotResiduals({Growing(1.0), {}});
  ASSERT_EQ(figures.size(), 4U);
  for (const PlotFigure& figure : figures) {
    EXPECT_THAT(figure.svg, AllOf(HasSubstr(">given<"), Not(HasSubstr(">estimated<"))));
  }
}

TEST(CalibrationPlots, FewPointsAreNoError) {
  EXPECT_TRUE(PlotResiduals({}).empty());
  const std::vector<CalibrationResidual> one = {{10.0, 0.5, 2.0, 0.01}};
  const std::vector<PlotFigure> figures = PlotResiduals({one, {}});
  ASSERT_EQ(figures.size(), 4U);
  for (const PlotFigure& figure : figures) {
    EXPECT_THAT(figure.svg, Not(HasSubstr("nan")));
  }
}

TEST(CalibrationPlots, MedianOfAMember) {
  EXPECT_DOUBLE_EQ(MedianResidual(Growing(1.0), &CalibrationResidual::radius), 121.0);
  EXPECT_DOUBLE_EQ(MedianResidual(Growing(2.0), &CalibrationResidual::reprojection), 2.42);
}

}  // namespace
}  // namespace msc_vo
