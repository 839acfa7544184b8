// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Depth images of floating-point numbers, and of 16 bits in other files than PNG.

#include <limits>
#include <memory>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"

namespace msc_vo {
namespace {

class FloatDepthTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
    WriteColor("rgb/1.png");
    WriteText("camera.txt", "8 8 4 3 8 6 5000\n");
  }
  // Depth of 1.5 m with holes.
  void Write(const std::string& ending, double units = 1.0) const {
    cv::Mat depth(6, 8, CV_32FC1, cv::Scalar(1.5 * units));
    depth.at<float>(0, 0) = std::numeric_limits<float>::quiet_NaN();
    depth.at<float>(0, 1) = std::numeric_limits<float>::infinity();
    depth.at<float>(0, 2) = -1.0f;
    depth.at<float>(0, 3) = 0.0f;
    std::filesystem::create_directories(Path("depth"));
    ASSERT_TRUE(cv::imwrite(Path("depth/1" + ending), depth));
  }
  RgbdDecoder Open(const CameraSettings& settings = {}) const {
    SequenceIndex index = OpenSequence(Folder());
    const Calibration calibration = ResolveCalibration(settings, "", &index);
    return {index, calibration};
  }
  static void ExpectDepth(const cv::Mat& depth) {
    for (int x = 0; x < 4; ++x) EXPECT_EQ(depth.at<float>(0, x), 0.0f) << x;
    EXPECT_FLOAT_EQ(depth.at<float>(0, 4), 1.5f);
    EXPECT_FLOAT_EQ(depth.at<float>(5, 7), 1.5f);
  }
};

TEST_F(FloatDepthTest, IsInMetres) {
  for (const std::string ending : {".tiff", ".exr"}) {
    SCOPED_TRACE(ending);
    Write(ending);
    ExpectDepth(Open().Decode(0).depth);
    std::filesystem::remove(Path("depth/1" + ending));
  }
}

TEST_F(FloatDepthTest, OfOtherUnitsNeedsTheirNumber) {
  Write(".tiff", 1000.0);
  EXPECT_THAT(MessageOf([&] { Open().Decode(0); }),
              Names("depth/1.tiff", "1500", "camera.float_depth_scale=1000"));
  CameraSettings settings;
  settings.float_depth_scale = 1000.0;
  const RgbdDecoder decoder = Open(settings);
  ExpectDepth(decoder.Decode(0).depth);
  EXPECT_FLOAT_EQ(decoder.ReadForExport(0).depth.pixels.at<float>(3, 3), 1.5f);
}

// The background of a rendered image may cover most of it.
TEST_F(FloatDepthTest, MayBeClippedInMostPixels) {
  cv::Mat depth(6, 8, CV_32FC1, cv::Scalar(1e10));
  depth.colRange(0, 2).setTo(1.5f);
  std::filesystem::create_directories(Path("depth"));
  ASSERT_TRUE(cv::imwrite(Path("depth/1.tiff"), depth));
  SequenceIndex index = OpenSequence(Folder());
  const Calibration calibration = ResolveCalibration({}, "", &index);
  EXPECT_EQ(RgbdDecoder(index, calibration).DecodeRawDepth(0).at<float>(0, 7), 1e10f);
  index.clipped_depth.limits.farthest = 1e10f;
  const cv::Mat metres = RgbdDecoder(index, calibration).Decode(0).depth;
  EXPECT_EQ(metres.at<float>(0, 0), 1.5f);
  EXPECT_EQ(metres.at<float>(0, 7), 0.0f);
}

// Pixels that a container gives are its own: they are not converted in place.
TEST_F(FloatDepthTest, OfAContainerIsConvertedOnce) {
  class OneImage : public ImageContainer {
   public:
    StoredImage ReadColor(int) const override { return {"", color_}; }
    StoredImage ReadDepth(int) const override { return {"", depth_}; }

   private:
    cv::Mat color_{6, 8, CV_8UC3, cv::Scalar::all(100)};
    cv::Mat depth_{6, 8, CV_32FC1, cv::Scalar(1500.0)};
  };
  Write(".tiff", 1000.0);
  CameraSettings settings;
  settings.float_depth_scale = 1000.0;
  SequenceIndex index = OpenSequence(Folder());
  const Calibration calibration = ResolveCalibration(settings, "", &index);
  index.container = std::make_shared<OneImage>();
  index.entries[0].color_index = index.entries[0].depth_index = 0;
  const RgbdDecoder decoder(index, calibration);
  for (int i = 0; i < 2; ++i) {
    EXPECT_FLOAT_EQ(decoder.ReadForExport(0).depth.pixels.at<float>(3, 3), 1.5f);
    EXPECT_FLOAT_EQ(decoder.Decode(0).depth.at<float>(3, 3), 1.5f);
  }
}

TEST_F(FloatDepthTest, Of16BitsInTiffHasTheUnitsOfTheCamera) {
  std::filesystem::create_directories(Path("depth"));
  ASSERT_TRUE(cv::imwrite(Path("depth/1.tiff"), cv::Mat(6, 8, CV_16UC1, cv::Scalar(7500))));
  const RgbdDecoder decoder = Open();
  EXPECT_FLOAT_EQ(decoder.Decode(0).depth.at<float>(2, 2), 1.5f);
  EXPECT_EQ(decoder.ReadForExport(0).depth.pixels.at<uint16_t>(2, 2), 7500);
}

TEST_F(FloatDepthTest, OfThreeChannelsIsRefused) {
  std::filesystem::create_directories(Path("depth"));
  ASSERT_TRUE(cv::imwrite(Path("depth/1.exr"), cv::Mat(6, 8, CV_32FC3, cv::Scalar::all(1.5))));
  EXPECT_THAT(MessageOf([&] { Open().Decode(0); }), Names("1.exr", "3 channels", "1 channel"));
}

}  // namespace
}  // namespace msc_vo
