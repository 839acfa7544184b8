// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/rgbd_source.h"

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::HasSubstr;

class RgbdSourceTest : public TemporaryFolder {
 protected:
  // Entry i is <i>.png and <i>d.png, one second apart, for a camera of 8 x 6 pixels.
  RgbdDecoder Decoder(int count) {
    SequenceIndex index;
    for (int i = 0; i < count; ++i) {
      const std::string name = std::to_string(i);
      index.entries.push_back({1.0 * i, Path(name + ".png"), Path(name + "d.png"), ""});
    }
    Calibration calibration;
    calibration.camera = {10.0, 10.0, 3.5, 2.5, 8, 6};
    return {index, calibration};
  }
};

TEST_F(RgbdSourceTest, ReadsImagesInOrder) {
  for (int i = 0; i < 5; ++i) {
    WriteImage(std::to_string(i) + ".png", CV_8UC1, 10 * i);
    WriteDepth(std::to_string(i) + "d.png");
  }
  const RgbdDecoder decoder = Decoder(5);
  RgbdSource source(decoder, 1, 4);
  RgbdImage image;
  for (int i = 1; i < 4; ++i) {
    ASSERT_TRUE(source.Next(&image));
    EXPECT_EQ(image.id, i);
    EXPECT_EQ(image.timestamp, i);
    EXPECT_EQ(image.gray.at<uint8_t>(0, 0), 10 * i);
  }
  EXPECT_FALSE(source.Next(&image));
  EXPECT_FALSE(source.Next(&image));
  EXPECT_THROW(RgbdSource(decoder, 2, 6), std::invalid_argument);
}

TEST_F(RgbdSourceTest, ThrowsForBadImageAndContinues) {
  for (int i = 0; i < 4; ++i) {
    WriteColor(std::to_string(i) + ".png");
    if (i != 2) WriteDepth(std::to_string(i) + "d.png");
  }
  const RgbdDecoder decoder = Decoder(4);
  RgbdSource source(decoder, 0, 4);
  RgbdImage image;
  EXPECT_TRUE(source.Next(&image));
  EXPECT_TRUE(source.Next(&image));
  EXPECT_THAT(MessageOf([&] { source.Next(&image); }), HasSubstr("2d.png"));
  EXPECT_TRUE(source.Next(&image));
  EXPECT_EQ(image.id, 3);
  EXPECT_FALSE(source.Next(&image));
}

TEST_F(RgbdSourceTest, MayBeDestroyedBeforeTheEnd) {
  WriteColor("0.png");
  WriteDepth("0d.png");
  const RgbdDecoder decoder = Decoder(2);
  RgbdImage image;
  {
    RgbdSource source(decoder, 0, 2);  // image 1 does not exist
    EXPECT_TRUE(source.Next(&image));
  }
  EXPECT_EQ(image.id, 0);
}

TEST_F(RgbdSourceTest, SkipsForwardOnly) {
  for (int i = 0; i < 10; ++i) {
    WriteColor(std::to_string(i) + ".png");
    WriteDepth(std::to_string(i) + "d.png");
  }
  const RgbdDecoder decoder = Decoder(10);
  RgbdSource source(decoder, 0, 10);
  RgbdImage image;
  source.SkipTo(4);
  EXPECT_TRUE(source.Next(&image));
  EXPECT_EQ(image.id, 4);
  EXPECT_THROW(source.SkipTo(4), std::invalid_argument);
  EXPECT_THROW(source.SkipTo(11), std::invalid_argument);
  source.SkipTo(10);
  EXPECT_FALSE(source.Next(&image));
}

}  // namespace
}  // namespace msc_vo
