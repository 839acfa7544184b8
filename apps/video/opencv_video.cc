// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>

#include <opencv2/videoio.hpp>

#include "apps/video/video_file.h"

namespace msc_vo {

namespace {

class OpenCvVideo : public VideoFile {
 public:
  bool Open(const std::string& path, double frame_rate, const cv::Size& size) override {
    // H.264, which browsers play, and otherwise MPEG-4.
    for (const char* codec : {"avc1", "mp4v"}) {
      const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
      if (writer_.open(path, cv::CAP_FFMPEG, fourcc, frame_rate, size, true)) return true;
    }
    return false;
  }

  void Write(const cv::Mat& image) override { writer_.write(image); }

  void Close() override { writer_.release(); }

  int CountImages(const std::string& path) const override {
    const cv::VideoCapture video(path, cv::CAP_FFMPEG);
    return video.isOpened() ? cvRound(video.get(cv::CAP_PROP_FRAME_COUNT)) : 0;
  }

 private:
  cv::VideoWriter writer_;
};

class OpenCvVideoReader : public VideoReader {
 public:
  bool Open(const std::string& path) override {
    if (!capture_.open(path, cv::CAP_FFMPEG)) return false;
    // Intrinsics and depth images do not follow the rotation.
    return capture_.set(cv::CAP_PROP_ORIENTATION_AUTO, 0.0);
  }

  int NumImagesInHeader() const override {
    return std::max(0, cvRound(capture_.get(cv::CAP_PROP_FRAME_COUNT)));
  }

  double FrameRate() const override { return capture_.get(cv::CAP_PROP_FPS); }

  bool Skip() override { return capture_.grab(); }

  cv::Mat Image() override {
    cv::Mat image;
    capture_.retrieve(image);
    return image;
  }

 private:
  cv::VideoCapture capture_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) VideoFile* msc_vo_make_video_file() {
  return new OpenCvVideo;
}

extern "C" __attribute__((visibility("default"))) VideoReader* msc_vo_make_video_reader() {
  return new OpenCvVideoReader;
}

}  // namespace msc_vo
