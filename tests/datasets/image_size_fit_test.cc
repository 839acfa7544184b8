// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_size_fit.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Calibration Camera(double f, int width, int height) {
  Calibration calibration;
  calibration.camera = {f, f, (width - 1) / 2.0, (height - 1) / 2.0, width, height};
  return calibration;
}

TEST(ImageSizeFit, LeavesImagesOfOneSize) {
  SequenceIndex index;
  Calibration calibration = Camera(500.0, 640, 480);
  FitToImageSizes({640, 480}, {640, 480}, {}, &index, &calibration);
  EXPECT_EQ(calibration.camera.fx, 500.0);
  EXPECT_FALSE(calibration.depth_camera);
  EXPECT_FALSE(index.scale_color);
  EXPECT_THAT(index.warnings, IsEmpty());
}

// A telephone with LiDAR; its calibration is that of either size.
TEST(ImageSizeFit, SamplesSmallDepthAtItsOwnPixels) {
  for (const auto& given : {Camera(1440.0, 1920, 1440), Camera(192.0, 256, 192)}) {
    SequenceIndex index;
    Calibration calibration = given;
    calibration.distortion.k[0] = 0.1;
    FitToImageSizes({1920, 1440}, {256, 192}, {}, &index, &calibration);
    EXPECT_NEAR(calibration.camera.fx, 960.0, 1e-9);
    EXPECT_NEAR(calibration.camera.cx, 639.5, 1e-9);
    EXPECT_EQ(calibration.camera.height, 960);
    ASSERT_TRUE(calibration.depth_camera);
    EXPECT_NEAR(calibration.depth_camera->camera.fy, 192.0, 1e-9);
    EXPECT_NEAR(calibration.depth_camera->camera.cy, 95.5, 1e-9);
    EXPECT_EQ(calibration.depth_camera->distortion.k[0], 0.1);
    EXPECT_TRUE(calibration.depth_camera->depth_from_color.translation().isZero());
    EXPECT_TRUE(index.scale_color);
    EXPECT_THAT(index.warnings,
                ElementsAre(Names("256x192", "1920x1440"), Names("1280x960", "camera.max_width")));
  }
}

// Only if that is asked for.
TEST(ImageSizeFit, ReducesColourAlone) {
  SequenceIndex index;
  Calibration calibration = Camera(1000.0, 1920, 1080);
  FitToImageSizes({1920, 1080}, {1920, 1080}, {}, &index, &calibration);
  EXPECT_FALSE(index.scale_color);
  EXPECT_FALSE(calibration.depth_camera);
  FitToImageSizes({1920, 1080}, {1920, 1080}, 960, &index, &calibration);
  EXPECT_NEAR(calibration.camera.fx, 500.0, 1e-9);
  EXPECT_EQ(calibration.depth_camera->camera.fx, 1000.0);
  EXPECT_THAT(index.warnings, ElementsAre(Names("960x540")));
}

// Another shape is another view; a calibration of neither size says nothing of them.
TEST(ImageSizeFit, TouchesNothingElse) {
  for (const ImageSize& depth : {ImageSize{640, 360}, ImageSize{320, 200}}) {
    SequenceIndex index;
    Calibration calibration = Camera(500.0, 640, 480);
    FitToImageSizes({640, 480}, depth, {}, &index, &calibration);
    EXPECT_FALSE(calibration.depth_camera);
  }
  SequenceIndex index;
  Calibration calibration = Camera(500.0, 800, 600);
  FitToImageSizes({640, 480}, {320, 240}, {}, &index, &calibration);
  EXPECT_FALSE(calibration.depth_camera);
  EXPECT_EQ(calibration.camera.fx, 500.0);
}

TEST(ImageSizeFit, ComparesShapes) {
  EXPECT_TRUE(HaveSameShape({1920, 1440}, {256, 192}));
  EXPECT_FALSE(HaveSameShape({1296, 968}, {640, 480}));
  EXPECT_TRUE(HaveSimilarShape({1296, 968}, {640, 480}));
  EXPECT_TRUE(HaveSimilarShape({640, 480}, {1296, 968}));
  EXPECT_FALSE(HaveSimilarShape({1280, 720}, {640, 480}));
  EXPECT_FALSE(HaveSimilarShape({1280, 960}, {640, 470}));
}

class ImageSizeFitTest : public TemporaryFolder {};

TEST_F(ImageSizeFitTest, StoredCalibrationCanBeGivenAgain) {
  WriteColor("rgb/1.0.png", 64, 48);
  WriteDepth("depth/1.0.png", 1000, 64, 48);
  WriteText("camera.txt", "60 61 30 24 64 48 1000 0.1 0 0 0 0\nfield_of_view 50\n");
  SequenceIndex index = OpenSequence(Folder());
  CameraSettings settings;
  settings.max_width = 32;
  const Calibration reduced = ResolveCalibration(settings, "", &index);
  EXPECT_EQ(reduced.camera.width, 32);
  const Calibration stored = StoredCalibration(reduced, index.reduced_from);
  EXPECT_EQ(FormatCameraFile(stored, "").find("60 61 30 24 64 48"), 0u);
  for (const std::optional<int>& width : {std::optional<int>(), std::optional<int>(32)}) {
    SequenceIndex again = OpenSequence(Folder());
    settings = SettingsOf(stored);
    settings.max_width = width;
    const Calibration calibration = ResolveCalibration(settings, "", &again);
    EXPECT_EQ(RgbdDecoder(again, calibration).Decode(0).gray.cols, width.value_or(64));
    EXPECT_NEAR(calibration.Recorded().fx, width ? 30.0 : 60.0, 1e-9);
  }
}

// A surface at 1 m, and one at 2 m in the right half: no pixel has a depth between them.
TEST_F(ImageSizeFitTest, DoesNotSmearDepthOverEdges) {
  WriteColor("rgb/1.0.png", 64, 48);
  cv::Mat depth(12, 16, CV_16UC1, cv::Scalar(1000));
  depth.colRange(8, 16).setTo(2000);
  std::filesystem::create_directory(Path("depth"));
  cv::imwrite(Path("depth/1.0.png"), depth);
  WriteText("camera.txt", "60 60 31.5 23.5 64 48 1000\n");
  SequenceIndex index = OpenSequence(Folder());
  const Calibration calibration = ResolveCalibration({}, "", &index);
  const cv::Mat registered = RgbdDecoder(index, calibration).Decode(0).depth;
  ASSERT_EQ(registered.size(), cv::Size(64, 48));
  for (int x = 2; x < 62; ++x) {
    const float value = registered.at<float>(20, x);
    EXPECT_NEAR(value, x < 31 ? 1.0f : x > 32 ? 2.0f : value, 1e-5) << x;
    EXPECT_TRUE(std::abs(value - 1.0f) < 1e-5f || std::abs(value - 2.0f) < 1e-5f) << x;
  }
}

// The first image may be damaged.
TEST_F(ImageSizeFitTest, TakesTheSizeOfTheFirstImageThatCanBeRead) {
  WriteText("rgb/1.0.png", "damaged");
  WriteColor("rgb/2.0.png", 64, 48);
  WriteDepth("depth/1.0.png", 1000, 16, 12);
  WriteDepth("depth/2.0.png", 1000, 16, 12);
  WriteText("camera.txt", "60 60 31.5 23.5 64 48 1000\n");
  SequenceIndex index = OpenSequence(Folder());
  const Calibration calibration = ResolveCalibration({}, "", &index);
  EXPECT_TRUE(calibration.depth_camera);
  const RgbdDecoder decoder(index, calibration);
  EXPECT_THROW(decoder.Decode(0), UnreadableImage);
  EXPECT_EQ(decoder.Decode(1).gray.cols, 64);
}

}  // namespace
}  // namespace msc_vo
