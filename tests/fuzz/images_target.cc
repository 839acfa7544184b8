// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Image files through the decoder of sequences. The last byte chooses whether the input is the
// colour or the depth image; the other one is a valid image of 8x6 pixels.

#include <memory>
#include <vector>

#include "tests/fuzz/input_folder.h"
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {
namespace {

constexpr int kWidth = 8;
constexpr int kHeight = 6;

// A recording of one frame.
class OneFrame : public ImageContainer {
 public:
  OneFrame(std::string bytes, bool is_depth) : bytes_(std::move(bytes)), is_depth_(is_depth) {}

  StoredImage ReadColor(int /*index*/) const override {
    if (!is_depth_) return {bytes_, {}};
    return {"", cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(100))};
  }
  StoredImage ReadDepth(int /*index*/) const override {
    if (is_depth_) return {bytes_, {}};
    return {"", cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(5000))};
  }

 private:
  std::string bytes_;
  bool is_depth_;
};

RgbdDecoder MakeDecoder(std::string bytes, bool is_depth) {
  SequenceIndex index;
  index.entries = {{1.0, "recording colour", "recording depth", ""}};
  index.entries.front().color_index = index.entries.front().depth_index = 0;
  index.container = std::make_shared<OneFrame>(std::move(bytes), is_depth);
  Calibration calibration;
  calibration.camera = {8.0, 8.0, 3.5, 2.5, kWidth, kHeight};
  return {index, calibration};
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  static_cast<void>(level);
  if (size == 0) return 0;
  const bool is_depth = data[size - 1] % 2 == 1;
  const RgbdDecoder decoder = MakeDecoder(std::string(AsText(data, size - 1)), is_depth);
  RgbdImage image;
  if (!Accepts("recording", [&] { image = decoder.Decode(0); })) return 0;
  Require(image.gray.type() == CV_8UC1 && image.gray.cols == kWidth && image.gray.rows == kHeight,
          "a grey image of the camera's size");
  Require(image.depth.type() == CV_32FC1 && cv::checkRange(image.depth, true, nullptr, 0.0, 1e38),
          "finite depths that are not negative");
  const StoredRgbd stored = decoder.ReadForExport(0);
  Require(!stored.color.bytes.empty() || !stored.color.pixels.empty(), "an image to export");
  return 0;
}
