// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_masks.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"

namespace msc_vo {
namespace {

using LeftOut = ImageMasks::LeftOut;

class ImageMasksTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    for (const std::string number : {"1", "2"}) {
      WriteColor("rgb/" + number + ".jpg");
      WriteDepth("depth/" + number + ".png");
    }
    WriteText("camera.txt", "8 8 4 3 8 6 5000\n");
    index_ = OpenSequence(Folder());
    // The left half.
    mask_ = cv::Mat::zeros(6, 8, CV_8UC1);
    mask_.colRange(0, 4) = 7;
  }
  void Write(const std::string& name, const cv::Mat& mask) const {
    std::filesystem::create_directories(std::filesystem::path(Path(name)).parent_path());
    ASSERT_TRUE(cv::imwrite(Path(name), mask));
  }
  RgbdImage Decode(const std::string& mask, LeftOut left_out = LeftOut::kNonZero, int i = 0) {
    index_.masks = std::make_shared<ImageMasks>(Path(mask), left_out, index_.entries);
    const Calibration calibration = ResolveCalibration({}, "", &index_);
    return RgbdDecoder(index_, calibration).Decode(i);
  }
  std::string ErrorOf(const std::string& mask, LeftOut left_out = LeftOut::kNonZero) {
    return MessageOf([&] { Decode(mask, left_out); });
  }

  SequenceIndex index_;
  cv::Mat mask_;
};

TEST_F(ImageMasksTest, LeaveOutWhatIsNotZero) {
  Write("arm.png", mask_);
  const RgbdImage image = Decode("arm.png");
  EXPECT_EQ(cv::countNonZero(image.mask), 24);
  EXPECT_EQ(image.mask.at<uint8_t>(0, 3), 255);
  EXPECT_EQ(image.depth.at<float>(2, 3), 0.0f);
  EXPECT_EQ(image.depth.at<float>(2, 4), 1.0f);
  const RgbdImage inverse = Decode("arm.png", LeftOut::kZero);
  EXPECT_EQ(inverse.depth.at<float>(2, 3), 1.0f);
  EXPECT_EQ(inverse.depth.at<float>(2, 4), 0.0f);
}

TEST_F(ImageMasksTest, MayHaveColoursNumbersOfObjectsAndAnotherSize) {
  cv::Mat color(6, 8, CV_8UC4, cv::Scalar(0, 0, 0, 255));  // opaque black
  color.colRange(0, 4) = cv::Scalar(0, 0, 200, 255);
  Write("color.png", color);
  cv::Mat numbers(12, 16, CV_16UC1, cv::Scalar(0));
  numbers.colRange(0, 8) = 512;  // whose lower byte is 0
  Write("numbers.png", numbers);
  for (const std::string name : {"color.png", "numbers.png"}) {
    EXPECT_EQ(cv::countNonZero(Decode(name).mask != (mask_ != 0)), 0) << name;
  }
}

TEST(ScaledMask, LeavesOutPixelsThatAreMaskedInPart) {
  const auto columns = [](int cols, int masked, int to) {
    cv::Mat mask(3, cols, CV_8UC1, cv::Scalar(0));
    mask.col(masked) = 255;
    const cv::Mat scaled = ScaledMask(mask, {to, 4});
    std::vector<int> left_out;
    for (int x = 0; x < to; ++x) {
      if (scaled.at<uint8_t>(2, x) != 0) left_out.push_back(x);
    }
    return left_out;
  };
  EXPECT_THAT(columns(4, 1, 6), testing::ElementsAre(1, 2));     // 1.5 to 3
  EXPECT_THAT(columns(5, 2, 7), testing::ElementsAre(2, 3, 4));  // 2.8 to 4.2
  EXPECT_THAT(columns(4, 1, 8), testing::ElementsAre(2, 3));
  EXPECT_THAT(columns(4, 1, 4), testing::ElementsAre(1));
  EXPECT_THAT(columns(6, 2, 4), testing::ElementsAre(1));  // 1.33 to 2
  EXPECT_THAT(columns(400, 33, 4), testing::ElementsAre(0));
  cv::Mat ones(2, 3, CV_8UC1, cv::Scalar(1));
  for (const cv::Size& size : {cv::Size(3, 2), cv::Size(6, 4)}) {
    EXPECT_EQ(cv::countNonZero(ScaledMask(ones, size) != 255), 0);
  }
}

TEST_F(ImageMasksTest, BelongToImagesByTheirNames) {
  Write("people/1.png", mask_);
  Write("people/2.jpg.png", 1 - mask_ / 7);
  EXPECT_EQ(Decode("people").depth.at<float>(0, 0), 0.0f);
  EXPECT_EQ(Decode("people", LeftOut::kNonZero, 1).depth.at<float>(0, 0), 1.0f);
  std::filesystem::remove(Path("people/2.jpg.png"));
  EXPECT_THAT(ErrorOf("people"), Names("people", "rgb/2.jpg", "1 of 2", "2.png"));
}

TEST_F(ImageMasksTest, AreRefusedIfTheyDoNotFit) {
  Write("tall.png", cv::Mat::zeros(8, 6, CV_8UC1));
  EXPECT_THAT(ErrorOf("tall.png"), Names("tall.png", "6x8", "8x6"));
  Write("white.png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(255)));
  EXPECT_THAT(ErrorOf("white.png"), Names("white.png", "every pixel", "--mask-zero"));
  WriteText("text.png", "no image");
  EXPECT_THAT(ErrorOf("text.png"), Names("text.png", "not an image"));
  EXPECT_THAT(ErrorOf("missing.png"), Names("missing.png", "exist"));
}

TEST_F(ImageMasksTest, AreDescribedByTheirFiles) {
  Write("arm.png", mask_);
  const ImageMasks masks(Path("arm.png"), LeftOut::kNonZero, {});
  Write("arm.png", 1 - mask_ / 7);
  const ImageMasks zero(Path("arm.png"), LeftOut::kZero, {});
  EXPECT_NE(masks.description(), zero.description());
  EXPECT_THAT(masks.description(), testing::HasSubstr("arm.png"));
}

}  // namespace
}  // namespace msc_vo
