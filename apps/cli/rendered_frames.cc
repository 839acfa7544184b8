// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/rendered_frames.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/image_files/opencv_codecs.h"

namespace msc_vo {

namespace {

std::string EncodeColor(const ColorEncoding& encoding, RenderedImage* image) {
  const cv::Mat rgb(image->height, image->width, CV_8UC3, image->rgb.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  // PNG level 1, because image noise does not compress.
  return EncodeWithOpenCv(
      encoding.jpeg ? ".jpg" : ".png", bgr,
      {cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_JPEG_QUALITY, encoding.jpeg_quality});
}

std::string EncodeDepth(RenderedImage* image) {
  const cv::Mat depth(image->height, image->width, CV_32FC1, image->depth.data());
  cv::Mat raw;
  depth.convertTo(raw, CV_16U, kRenderedDepthScale);          // rounds
  raw.setTo(0, raw == std::numeric_limits<uint16_t>::max());  // from 13.1 m: not measured
  // Quantised depth compresses: level 6 saves a fifth of level 1.
  return EncodeWithOpenCv(".png", raw, {cv::IMWRITE_PNG_COMPRESSION, 6});
}

EncodedFrame RenderFrame(const SyntheticSequence& sequence, const ColorEncoding& encoding,
                         int index) {
  SyntheticFrame frame = sequence.Render(index);
  return {frame.pose, EncodeColor(encoding, &frame.image), EncodeDepth(&frame.image)};
}

}  // namespace

RenderedFrames::RenderedFrames(const SyntheticSequence& sequence, const ColorEncoding& encoding,
                               int num_frames)
    : sequence_(sequence), encoding_(encoding), num_frames_(num_frames) {}

EncodedFrame RenderedFrames::Next() {
  StartMore();
  EncodedFrame frame = started_.front().get();
  started_.pop_front();
  return frame;
}

void RenderedFrames::StartMore() {
  const size_t num_processors = std::max(1U, std::thread::hardware_concurrency());
  while (started_.size() < num_processors && num_started_ < num_frames_) {
    started_.push_back(std::async(std::launch::async, RenderFrame, std::cref(sequence_), encoding_,
                                  num_started_++));
  }
}

}  // namespace msc_vo
