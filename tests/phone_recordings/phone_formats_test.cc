// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Folders as Stray Scanner, Polycam and 3D Scanner App write them, made from rendered images.

#include "msc_vo/phone_recordings/phone_formats.h"

#include <filesystem>
#include <fstream>

#include "tests/phone_recordings/phone_folders.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::Not;

constexpr int kNumRoomImages = 9;

class PhoneFormatsTest : public TemporaryFolder {
 protected:
  static void SetUpTestSuite() {
    source_ = new PhoneSource(ReadPhoneSource(MSC_VO_DATA_FOLDER "/room", kNumRoomImages));
  }
  static void TearDownTestSuite() { delete source_; }

  static PhoneOptions Options(DepthConfidence least = DepthConfidence::kMedium) {
    return {least, MakeTestVideoReader};
  }
  static SequenceIndex Open(const std::string& folder, const PhoneOptions& options = Options()) {
    return OpenFolder(folder, "auto", options);
  }
  static RgbdDecoder Decoder(SequenceIndex index) {
    const Calibration calibration = ResolveCalibration({}, "", &index);
    return {index, calibration};
  }
  // Writes all three kinds of folders, and returns them with the names of their formats.
  std::vector<std::pair<std::string, std::string>> WriteAll(const PhoneFolderOptions& options) {
    WriteStrayScanner(*source_, options, Path("stray"));
    WritePolycam(*source_, options, "", Path("poly"));
    WriteScannerApp(*source_, options, Path("app"));
    return {{Path("stray"), "stray-scanner"},
            {Path("poly"), "polycam"},
            {Path("app"), "3d-scanner-app"}};
  }
  void Replace(const std::string& name, const std::string& text, const std::string& by) {
    std::string content = ReadFile(Path(name));
    const size_t at = content.find(text);
    ASSERT_NE(at, std::string::npos);
    WriteText(name, content.replace(at, text.size(), by));
  }
  static double MeanDifference(const cv::Mat& a, const cv::Mat& b) {
    cv::Mat difference;
    cv::absdiff(a, b, difference);
    return cv::mean(difference)[0];
  }

  static inline PhoneSource* source_ = nullptr;
};

TEST_F(PhoneFormatsTest, ReadImagesPosesAndCamera) {
  for (const auto& [folder, format] : WriteAll({})) {
    SCOPED_TRACE(format);
    const SequenceIndex index = Open(folder);
    EXPECT_EQ(index.format, format);
    EXPECT_THAT(index.recorder, testing::HasSubstr("iPhone"));
    EXPECT_EQ(index.GivenDepthSensor(), DepthSensor::kLidar);
    ASSERT_EQ(index.entries.size(), static_cast<size_t>(kNumRoomImages));
    EXPECT_EQ(index.reference, "ARKit");
    EXPECT_EQ(TruthFileName(index), std::string("reference.txt"));
    ASSERT_EQ(index.ground_truth.size(), static_cast<size_t>(kNumRoomImages));
    const double start = index.entries[0].timestamp - source_->images[0].timestamp;
    for (size_t i = 0; i < index.entries.size(); ++i) {
      const PhoneSource::Image& image = source_->images[i];
      EXPECT_NEAR(index.entries[i].timestamp - image.timestamp, start, 1e-5);
      const Rigid3& pose = index.ground_truth[i].world_from_cam;
      EXPECT_LT((pose.translation() - image.world_from_cam.translation()).norm(), 1e-6);
      EXPECT_LT(pose.rotation().angularDistance(image.world_from_cam.rotation()), 1e-6);
    }
    const RgbdDecoder decoder = Decoder(index);
    EXPECT_NEAR(decoder.calibration().camera.fx, source_->camera.fx, 1e-4);
    ASSERT_TRUE(decoder.calibration().depth_camera);
    EXPECT_NEAR(decoder.calibration().depth_camera->camera.fx, source_->camera.fx / 4.0, 1e-4);
    for (const int i : {0, 5}) {
      const RgbdImage image = decoder.Decode(i);
      cv::Mat gray;
      cv::extractChannel(source_->images[i].color, gray, 1);
      EXPECT_LT(MeanDifference(image.gray, gray), 12.0) << i;  // compression, grey from green
      cv::Mat error;
      cv::absdiff(image.depth, source_->images[i].depth, error);
      error.setTo(0.0f, (image.depth == 0.0f) | (source_->images[i].depth == 0.0f));
      EXPECT_LT(cv::mean(error)[0], 0.02) << i;
    }
  }
}

TEST_F(PhoneFormatsTest, LeaveOutUncertainDepth) {
  PhoneFolderOptions options;
  options.has_uncertain_depth = true;
  for (const auto& [folder, format] : WriteAll(options)) {
    SCOPED_TRACE(format);
    const SequenceIndex index = Open(folder);
    EXPECT_THAT(index.warnings, Contains(Names("medium confidence", "--min-confidence")));
    const cv::Mat depth = Decoder(index).DecodeRawDepth(0);
    const cv::Rect uncertain(0, 0, depth.cols / 2, depth.rows / 2);
    EXPECT_EQ(cv::countNonZero(depth(uncertain)), 0);
    EXPECT_GT(cv::countNonZero(depth), static_cast<int>(depth.total() / 2));
    const SequenceIndex all = Open(folder, Options(DepthConfidence::kLow));
    EXPECT_THAT(all.warnings, Not(Contains(Names("confidence"))));
    EXPECT_GT(cv::countNonZero(Decoder(all).DecodeRawDepth(0)(uncertain)),
              static_cast<int>(uncertain.area() / 2));
  }
}

// Images whose focal length breathes by 1 % show what one camera would have taken.
TEST_F(PhoneFormatsTest, ResampleToTheMedianCamera) {
  PhoneFolderOptions options;
  options.breathing = 0.01;
  for (const auto& [folder, format] : WriteAll(options)) {
    SCOPED_TRACE(format);
    const SequenceIndex index = Open(folder);
    EXPECT_THAT(index.warnings, Contains(Names("intrinsics change", "resampled")));
    const RgbdDecoder decoder = Decoder(index);
    EXPECT_NEAR(decoder.calibration().Recorded().fx, source_->camera.fx, 1e-3);
    const int largest = 2;  // sin(90 degrees)
    const RgbdImage resampled = decoder.Decode(largest);
    cv::Mat gray, breathed;
    cv::cvtColor(source_->images[largest].color, gray, cv::COLOR_BGR2GRAY);
    const cv::Rect inside(8, 8, gray.cols - 16, gray.rows - 16);
    const cv::Mat map = (cv::Mat_<double>(2, 3) << 1.01, 0, -0.01 * source_->camera.cx, 0, 1.01,
                         -0.01 * source_->camera.cy);
    cv::warpAffine(gray, breathed, map, gray.size());
    EXPECT_LT(MeanDifference(resampled.gray(inside), gray(inside)),
              0.6 * MeanDifference(resampled.gray(inside), breathed(inside)));
  }
}

TEST_F(PhoneFormatsTest, PreferWhatPolycamHasCorrected) {
  WritePolycam(*source_, {}, "", Path("poly"));
  EXPECT_THAT(Open(Path("poly")).warnings, Contains(Names("corrected_images")));
  WritePolycam(*source_, {}, "corrected_", Path("poly"));
  const SequenceIndex index = Open(Path("poly"));
  EXPECT_EQ(index.reference, "Polycam");
  EXPECT_THAT(index.entries[0].color_path, testing::HasSubstr("corrected_images"));
  EXPECT_EQ(Open(Path("poly/keyframes")).entries.size(), index.entries.size());
}

TEST_F(PhoneFormatsTest, ReadTheSharedCameraOfStrayScanner) {
  PhoneFolderOptions options;
  options.has_row_intrinsics = false;
  WriteStrayScanner(*source_, options, Path("stray"));
  const SequenceIndex index = Open(Path("stray"));
  EXPECT_THAT(index.calibration->origin, testing::HasSubstr("camera_matrix.csv"));
  EXPECT_NEAR(index.calibration->camera.cy, source_->camera.cy, 1e-5);
}

TEST_F(PhoneFormatsTest, RefuseAVideoOfAnotherLength) {
  WriteStrayScanner(*source_, {}, Path("stray"));
  std::string rows = ReadFile(Path("stray/odometry.csv"));
  WriteText("stray/odometry.csv", rows.substr(0, rows.rfind('\n', rows.size() - 2) + 1));
  EXPECT_THAT(MessageOf([&] { Open(Path("stray")); }), Names("9 images", "8 rows", "odometry.csv"));
}

TEST_F(PhoneFormatsTest, RefuseWhatDoesNotFit) {
  WriteStrayScanner(*source_, {}, Path("stray"));
  const auto error = [&](const std::string& folder) {
    return MessageOf([&] { Open(Path(folder)); });
  };
  EXPECT_THAT(MessageOf([&] { Open(Path("stray"), PhoneOptions()); }),
              Names("rgb.mp4", "msc_vo record"));
  Replace("stray/odometry.csv", "timestamp, ", "time, ");
  EXPECT_THAT(error("stray"), Names("odometry.csv:1", "timestamp"));
  WritePolycam(*source_, {}, "", Path("poly"));
  const std::string camera = fs::directory_iterator(Path("poly/keyframes/cameras"))->path();
  WriteText("poly/keyframes/cameras/" + fs::path(camera).filename().string(), "{\"fx\": 500}");
  EXPECT_THAT(error("poly"), Names(fs::path(camera).filename().string(), "fy", "missing"));
  WriteScannerApp(*source_, {}, Path("app"));
  for (const fs::directory_entry& file : fs::directory_iterator(Path("app"))) {
    if (file.path().extension() != ".json") continue;
    nlohmann::json frame = nlohmann::json::parse(ReadFile(file.path()));
    frame["time"] = 1e9 * frame["time"].get<double>();
    WriteText("app/" + file.path().filename().string(), frame.dump());
  }
  EXPECT_THAT(error("app"), Names("time", "unit"));
}

}  // namespace
}  // namespace msc_vo
