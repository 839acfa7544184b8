// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/video_images.h"

#include "tests/phone_recordings/phone_folders.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/videoio.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/phone_recordings/folder_sequence.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

constexpr int kNumImages = 20;

// Image k has the grey level 20 + 10 k.
class VideoImagesTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    std::vector<cv::Mat> images;
    for (int k = 0; k < kNumImages; ++k) {
      images.emplace_back(48, 64, CV_8UC3, cv::Scalar::all(20 + 10 * k));
    }
    WriteVideo(images, 20.0, Path("seq/color.mp4"));
  }
  static int NumberOf(const cv::Mat& image) {
    // Codecs change the colour of grey by up to three levels.
    const cv::Scalar mean = cv::mean(image);
    const double gray = image.channels() == 1 ? mean[0] : (mean[0] + mean[1] + mean[2]) / 3.0;
    return cvRound((gray - 20.0) / 10.0);
  }
};

TEST_F(VideoImagesTest, ReadsImagesInAnyOrder) {
  const VideoImages video(Path("seq/color.mp4"), MakeTestVideoReader);
  int num_images = 0;
  EXPECT_TRUE(video.HasImages(kNumImages, &num_images));
  for (const int k : {0, 1, 2, 17, 17, 19, 3, 18}) EXPECT_EQ(NumberOf(video.Read(k)), k);
  EXPECT_FALSE(video.HasImages(kNumImages + 1, &num_images));
  EXPECT_EQ(num_images, kNumImages);
  EXPECT_EQ(NumberOf(video.Read(7)), 7);
  EXPECT_THAT(MessageOf([&] { video.Read(kNumImages); }), Names("color.mp4", "20"));
}

// Telephones store images as the sensor has them and ask players to rotate them.
TEST_F(VideoImagesTest, DoesNotRotateImages) {
  std::string bytes = ReadFile(Path("seq/color.mp4"));
  const size_t box = bytes.find("tkhd");
  ASSERT_NE(box, std::string::npos);
  constexpr size_t kMatrix = 44;  // from the name of the box, version 0
  const std::string one("\0\1\0\0", 4), minus_one("\xFF\xFF\0\0", 4), zero(4, '\0');
  bytes.replace(box + kMatrix, 20, zero + one + zero + minus_one + zero);
  WriteText("seq/turned.mp4", bytes);
  EXPECT_NE(cv::VideoCapture(Path("seq/turned.mp4")).get(cv::CAP_PROP_ORIENTATION_META), 0.0);
  const VideoImages video(Path("seq/turned.mp4"), MakeTestVideoReader);
  EXPECT_EQ(video.Read(0).size(), cv::Size(64, 48));
}

TEST_F(VideoImagesTest, RefusesWhatIsNoVideo) {
  WriteText("seq/color.mp4", "not a video");
  EXPECT_THAT(MessageOf([&] { VideoImages(Path("seq/color.mp4"), MakeTestVideoReader); }),
              Names("color.mp4", "decoded"));
}

class VideoFolderTest : public VideoImagesTest {
 protected:
  void SetUp() override {
    VideoImagesTest::SetUp();
    for (int k = 0; k < kNumImages; ++k) {
      WriteDepth("seq/depth/" + std::to_string(k) + ".png", 1000 + k, 64, 48);
    }
    WriteText("seq/camera.txt", "60 60 32 24 64 48 1000\n");
  }
  SequenceIndex Open() const {
    return OpenFolder(Path("seq"), "auto", {DepthConfidence::kMedium, MakeTestVideoReader});
  }
};

TEST_F(VideoFolderTest, PairsImagesOfAVideoWithDepthImages) {
  SequenceIndex index = Open();
  EXPECT_EQ(index.format, "video-depth");
  ASSERT_EQ(index.entries.size(), static_cast<size_t>(kNumImages));
  EXPECT_NEAR(index.entries[3].timestamp - index.entries[0].timestamp, 0.15, 1e-9);
  EXPECT_THAT(index.warnings, testing::Contains(Names("frame rate", "times.txt")));
  const Calibration calibration = ResolveCalibration({}, "", &index);
  const RgbdImage image = RgbdDecoder(index, calibration).Decode(13);
  EXPECT_EQ(NumberOf(image.gray), 13);
  EXPECT_FLOAT_EQ(image.depth.at<float>(10, 10), 1.013f);
}

TEST_F(VideoFolderTest, ReadsTimes) {
  std::string times = "# milliseconds\n";
  for (int k = 0; k < kNumImages; ++k) times += std::to_string(90000 + 40 * k) + "\n";
  WriteText("seq/times.txt", times);
  EXPECT_NEAR(Open().entries[2].timestamp, 90.08, 1e-9);
  WriteText("seq/times.txt", times + "99999\n");
  EXPECT_THAT(MessageOf([&] { Open(); }), Names("times.txt", "21 times", "20 images"));
  WriteText("seq/times.txt", "1\n2\n2\n");
  EXPECT_THAT(MessageOf([&] { Open(); }), Names("times.txt:3", "ascend"));
  WriteText("seq/times.txt", "nan\n2\n3\n");
  EXPECT_THAT(MessageOf([&] { Open(); }), Names("times.txt:1", "nan", "no time"));
}

TEST_F(VideoFolderTest, RefusesAnotherNumberOfDepthImages) {
  WriteDepth("seq/depth/20.png", 1000, 64, 48);
  EXPECT_THAT(MessageOf([&] { Open(); }), Names("color.mp4", "20 images", "21 depth images"));
}

}  // namespace
}  // namespace msc_vo
