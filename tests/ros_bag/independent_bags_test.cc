// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Bags that other programs wrote (tests/data/bags/README.md).

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/ros_bag/bag_sequence.h"

namespace msc_vo {
namespace {

class IndependentBag : public testing::TestWithParam<std::string> {};

// Three pairs of 16x12 pixels, 0.1 s apart; pair i is 40 (i + 1) everywhere in colour, and has
// depths of 1000 (i + 1) + x + 20 y mm.
TEST_P(IndependentBag, IsRead) {
  SequenceIndex index = OpenBag(MSC_VO_BAGS_FOLDER "/" + GetParam());
  Calibration calibration = ResolveCalibration({}, "", &index);
  EXPECT_EQ(calibration.camera.fx, 14.5);
  EXPECT_EQ(calibration.camera.height, 12);
  EXPECT_THAT(index.warnings, testing::IsEmpty());
  const RgbdDecoder decoder(index, calibration);
  ASSERT_EQ(decoder.size(), 3);
  for (int i = 0; i < 3; ++i) {
    const RgbdImage image = decoder.Decode(i);
    EXPECT_NEAR(image.timestamp, 1700000000.0 + 0.1 * i, 1e-6);
    EXPECT_EQ(image.gray.at<uint8_t>(5, 5), 40 * (i + 1));
    EXPECT_NEAR(image.depth.at<float>(3, 7), i + 1.067, 1e-6);
    EXPECT_NEAR(image.depth.at<float>(11, 0), i + 1.22, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(All, IndependentBag,
                         testing::Values("none.mcap", "lz4.mcap", "zstd.mcap", "unchunked.mcap",
                                         "plain.db3", "split"));

}  // namespace
}  // namespace msc_vo
