// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/openni/openni_stream.h"

#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

OpenNiLibrary::OpenNiLibrary() {
  CheckStatus(openni::OpenNI::initialize(), "OpenNI2", "initialisation");
}

OpenNiLibrary::~OpenNiLibrary() { openni::OpenNI::shutdown(); }

OpenNiStream::~OpenNiStream() {
  stream.stop();
  stream.destroy();
  device.close();
}

void CheckStatus(openni::Status status, const std::string& name, const std::string& action) {
  if (status == openni::STATUS_OK) return;
  throw std::runtime_error(name + ": " + action +
                           " failed: " + Trimmed(openni::OpenNI::getExtendedError()));
}

double TimeOf(const openni::VideoFrameRef& frame) {
  constexpr double kSecondsPerUnit = 1e-6;
  return kSecondsPerUnit * static_cast<double>(frame.getTimestamp());
}

namespace {

cv::Mat ViewOf(const openni::VideoFrameRef& frame, int type) {
  return {frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
          static_cast<size_t>(frame.getStrideInBytes())};
}

}  // namespace

cv::Mat ColorOf(const openni::VideoFrameRef& frame, bool is_mirrored, const std::string& name) {
  cv::Mat image;
  switch (frame.getVideoMode().getPixelFormat()) {
    case openni::PIXEL_FORMAT_RGB888:
      cv::cvtColor(ViewOf(frame, CV_8UC3), image, cv::COLOR_RGB2BGR);
      break;
    case openni::PIXEL_FORMAT_GRAY8:
      image = ViewOf(frame, CV_8UC1).clone();
      break;
    case openni::PIXEL_FORMAT_YUV422:
      cv::cvtColor(ViewOf(frame, CV_8UC2), image, cv::COLOR_YUV2BGR_UYVY);
      break;
    case openni::PIXEL_FORMAT_YUYV:
      cv::cvtColor(ViewOf(frame, CV_8UC2), image, cv::COLOR_YUV2BGR_YUY2);
      break;
    default:
      throw std::runtime_error(name + ": colour images of this pixel format cannot be read");
  }
  if (is_mirrored) cv::flip(image, image, 1);
  return image;
}

cv::Mat DepthOf(const openni::VideoFrameRef& frame, bool is_mirrored, const std::string& name) {
  const openni::PixelFormat format = frame.getVideoMode().getPixelFormat();
  if (format != openni::PIXEL_FORMAT_DEPTH_1_MM && format != openni::PIXEL_FORMAT_DEPTH_100_UM) {
    throw std::runtime_error(name + ": depth images of this pixel format cannot be read");
  }
  cv::Mat image = ViewOf(frame, CV_16UC1).clone();
  if (is_mirrored) cv::flip(image, image, 1);
  return image;
}

double DepthScaleOf(const openni::VideoStream& depth) {
  return depth.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? 1e4 : 1e3;
}

std::optional<Calibration> NominalCalibration(const openni::VideoStream& stream, double depth_scale,
                                              const std::string& name) {
  const openni::VideoMode mode = stream.getVideoMode();
  if (!(stream.getHorizontalFieldOfView() > 0.0f) || !(stream.getVerticalFieldOfView() > 0.0f)) {
    return std::nullopt;
  }
  Calibration calibration;
  PinholeCamera& camera = calibration.camera;
  camera.width = mode.getResolutionX();
  camera.height = mode.getResolutionY();
  camera.fx = 0.5 * camera.width / std::tan(0.5 * stream.getHorizontalFieldOfView());
  camera.fy = 0.5 * camera.height / std::tan(0.5 * stream.getVerticalFieldOfView());
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  calibration.depth_scale = depth_scale;
  calibration.origin = "the field of view of " + name + " (nominal)";
  return calibration;
}

}  // namespace msc_vo
