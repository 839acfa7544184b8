// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracker_options.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// The error of a prediction is an angle, that of a feature is not.
TEST(TrackerOptions, SearchRadiiAroundAPredictionFollowTheWidthOfTheImage) {
  const TrackerOptions options;
  for (const int width : {320, 640, 1280}) {
    const TrackerOptions scaled = ForImageWidth(options, width);
    EXPECT_EQ(scaled.prediction_radius, options.prediction_radius * width / 640.0);
    EXPECT_EQ(scaled.wide_radius, options.wide_radius * width / 640.0);
    EXPECT_EQ(scaled.local_map_radius, options.local_map_radius);
  }
}

}  // namespace
}  // namespace msc_vo
