// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The text files of recordings of telephones: odometry.csv and camera_matrix.csv of Stray Scanner,
// a camera of Polycam, a frame of 3D Scanner App, times.txt of a video folder. Images are small and
// good.

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/input_folder.h"
#include <opencv2/core.hpp>

#include "msc_vo/image_files/opencv_codecs.h"
#include "msc_vo/phone_recordings/folder_sequence.h"

namespace msc_vo {
namespace {

constexpr int kNumImages = 3;

// A video of black images.
class BlackVideo : public VideoReader {
 public:
  bool Open(const std::string& /*path*/) override {
    next_ = 0;
    return true;
  }
  int NumImagesInHeader() const override { return kNumImages; }
  double FrameRate() const override { return 30.0; }
  bool Skip() override { return next_++ < kNumImages; }
  cv::Mat Image() override { return cv::Mat::zeros(6, 8, CV_8UC3); }

 private:
  int next_ = 0;
};

// Folders of all layouts without the files of the input.
class Recordings {
 public:
  Recordings() {
    const std::string depth =
        EncodeWithOpenCv(".png", cv::Mat(6, 8, CV_16UC1, cv::Scalar(900)), {});
    const std::string color = EncodeWithOpenCv(".png", cv::Mat(6, 8, CV_8UC1, cv::Scalar(9)), {});
    Write("stray/rgb.mp4", "video");
    Write("video/color.mp4", "video");
    for (const std::string number : {"0", "1", "2"}) {
      Write("stray/depth/00000" + number + ".png", depth);
      Write("video/depth/" + number + ".png", depth);
      const std::string time = "100" + number + "00000";
      Write("poly/keyframes/images/" + time + ".png", color);
      Write("poly/keyframes/depth/" + time + ".png", depth);
      Write("app/frame_0000" + number + ".png", color);
      Write("app/depth_0000" + number + ".png", depth);
    }
    std::filesystem::create_directories(folder_.Path("poly/keyframes/cameras"));
  }

  // Opens each layout with the text in its files.
  void Open(const std::vector<std::string_view>& files) {
    const std::string_view rows = files[0], other = files.size() > 1 ? files[1] : files[0];
    folder_.Write("stray/odometry.csv", rows);
    folder_.Write("stray/camera_matrix.csv", other);
    folder_.Write("video/times.txt", rows);
    for (const std::string number : {"0", "1", "2"}) {
      folder_.Write("poly/keyframes/cameras/100" + number + "00000.json", other);
      folder_.Write("app/frame_0000" + number + ".json", other);
    }
    for (const char* name : {"stray", "poly", "app", "video"}) Open(folder_.Path(name));
  }

 private:
  void Write(const std::string& name, const std::string& bytes) {
    std::filesystem::create_directories(std::filesystem::path(folder_.Path(name)).parent_path());
    std::ofstream(folder_.Path(name), std::ios::binary) << bytes;
  }
  static void Open(const std::string& folder) {
    const PhoneOptions options = {DepthConfidence::kMedium,
                                  [] { return std::make_unique<BlackVideo>(); }};
    SequenceIndex index;
    if (!Accepts(folder, [&] { index = OpenFolder(folder, "auto", options); })) return;
    for (const SequenceEntry& entry : index.entries) {
      Require(std::isfinite(entry.timestamp), "finite stamps");
    }
    for (const TimedPose& pose : index.ground_truth) {
      Require(pose.world_from_cam.params.allFinite(), "finite poses");
    }
    std::string error;
    Require(!index.calibration || index.calibration->camera.IsValid(&error), "a valid camera");
  }

  InputFolder folder_;
};

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static Recordings recordings;
  recordings.Open(SplitFiles(AsText(data, size)));
  return 0;
}
