// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/synthetic_depth.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(SyntheticDepth, HasNames) {
  for (const std::string& name : SyntheticDepthNames()) {
    ASSERT_TRUE(SyntheticDepthFromName(name)) << name;
    EXPECT_EQ(ToString(*SyntheticDepthFromName(name)), name);
  }
  EXPECT_EQ(SyntheticDepthFromName("none"), SyntheticDepth::kExact);
  EXPECT_EQ(SyntheticDepthFromName("kinect"), SyntheticDepth::kStructuredLight);
  EXPECT_FALSE(SyntheticDepthFromName("radar"));
}

}  // namespace
}  // namespace msc_vo
