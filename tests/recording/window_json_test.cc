// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/recording/window_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace msc_vo {
namespace {

TEST(FormatWindowJson, ContainsCostsOfEachTerm) {
  BundleAdjustmentSummary summary;
  summary.usable = true;
  summary.final_cost = 0.1 + 0.2;
  summary.perpendicular = {3, 1, 2.5, 1.5};
  const nlohmann::json json = nlohmann::json::parse(FormatWindowJson(summary, 12.5));
  EXPECT_EQ(json["usable"], true);
  EXPECT_EQ(json["final_cost"], 0.1 + 0.2);
  EXPECT_EQ(json["milliseconds"], 12.5);
  EXPECT_EQ(json["terms"].size(), 10u);
  const nlohmann::json term = json["terms"]["perpendicular"];
  EXPECT_EQ(term["residual_blocks"], 3);
  EXPECT_EQ(term["rejected"], 1);
  EXPECT_EQ(term["initial_cost"], 2.5);
  EXPECT_EQ(term["final_cost"], 1.5);
}

}  // namespace
}  // namespace msc_vo
