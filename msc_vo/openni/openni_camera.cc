// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Live cameras of OpenNI2.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/rgbd_camera.h"
#include "msc_vo/openni/openni_source.h"
#include "msc_vo/openni/openni_stream.h"

namespace msc_vo {

namespace {

constexpr int kTimeout = 5000;  // milliseconds
constexpr int kWidth = 640, kHeight = 480, kRate = 30;

double SecondsSince1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// Selects 640x480 at 30 Hz if the stream has that mode in one of the pixel formats.
void SelectMode(std::initializer_list<openni::PixelFormat> formats, openni::VideoStream* stream) {
  const openni::Array<openni::VideoMode>& modes = stream->getSensorInfo().getSupportedVideoModes();
  for (const openni::PixelFormat format : formats) {
    for (int i = 0; i < modes.getSize(); ++i) {
      const openni::VideoMode& mode = modes[i];
      if (mode.getPixelFormat() != format || mode.getResolutionX() != kWidth ||
          mode.getResolutionY() != kHeight || mode.getFps() != kRate) {
        continue;
      }
      if (stream->setVideoMode(mode) == openni::STATUS_OK) return;
    }
  }
}

class OpenNiCamera : public RgbdCamera {
 public:
  OpenNiCamera(const std::string& name, const std::string& uri) : name_(name) {
    const char* const device_uri = uri.empty() ? openni::ANY_DEVICE : uri.c_str();
    CheckStatus(device_.open(device_uri), name_, "opening the camera");
    OpenStream(openni::SENSOR_COLOR, "colour",
               {openni::PIXEL_FORMAT_RGB888, openni::PIXEL_FORMAT_GRAY8}, &color_);
    OpenStream(openni::SENSOR_DEPTH, "depth",
               {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM}, &depth_);
    const int rate = std::max(color_.getVideoMode().getFps(), depth_.getVideoMode().getFps());
    max_difference_ = MaxPairDifference(1.0 / rate);
    const openni::ImageRegistrationMode registration = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    is_registered_ = device_.isImageRegistrationModeSupported(registration) &&
                     device_.setImageRegistrationMode(registration) == openni::STATUS_OK;
    device_.setDepthColorSyncEnabled(
        true);  // not all cameras can; frames are paired by time anyway
    CheckStatus(color_.start(), name_, "starting the colour stream");
    CheckStatus(depth_.start(), name_, "starting the depth stream");
  }

  ~OpenNiCamera() override {
    for (openni::VideoStream* stream : {&color_, &depth_}) {
      stream->stop();
      stream->destroy();
    }
    device_.close();
  }

  bool Grab(CameraImage* image) override {
    openni::VideoStream* streams[] = {&color_, &depth_};
    for (;;) {
      int ready = -1;
      const openni::Status status = openni::OpenNI::waitForAnyStream(streams, 2, &ready, kTimeout);
      if (status == openni::STATUS_TIME_OUT) {
        throw std::runtime_error(name_ + ": no image for 5 s; is the camera still connected?");
      }
      CheckStatus(status, name_, "waiting for an image");
      openni::VideoFrameRef& frame = ready == 0 ? color_frame_ : depth_frame_;
      CheckStatus(streams[ready]->readFrame(&frame), name_, "reading an image");
      if (!color_frame_.isValid() || !depth_frame_.isValid()) continue;
      const double delay = TimeOf(depth_frame_) - TimeOf(color_frame_);
      // The partner of the later image is still to come.
      if (std::abs(delay) > max_difference_) continue;
      *image = TakePair(delay);
      return true;
    }
  }

  const openni::VideoStream& color() const { return color_; }
  const openni::VideoStream& depth() const { return depth_; }
  bool is_registered() const { return is_registered_; }

 private:
  void OpenStream(openni::SensorType sensor, const std::string& what,
                  std::initializer_list<openni::PixelFormat> formats, openni::VideoStream* stream) {
    if (!device_.hasSensor(sensor)) {
      throw std::runtime_error(name_ + ": the camera has no " + what + " images");
    }
    CheckStatus(stream->create(device_, sensor), name_, "opening the " + what + " stream");
    SelectMode(formats, stream);
    stream->setMirroringEnabled(false);  // otherwise most cameras mirror like a looking glass
  }

  CameraImage TakePair(double delay) {
    const double time = TimeOf(color_frame_);
    // Device time stamps have an arbitrary origin.
    if (!offset_) offset_ = SecondsSince1970() - time;
    CameraImage image{time + *offset_, delay,
                      ColorOf(color_frame_, color_.getMirroringEnabled(), name_),
                      DepthOf(depth_frame_, depth_.getMirroringEnabled(), name_)};
    color_frame_.release();
    depth_frame_.release();
    return image;
  }

  OpenNiLibrary library_;
  std::string name_;
  openni::Device device_;
  openni::VideoStream color_;
  openni::VideoStream depth_;
  openni::VideoFrameRef color_frame_;  // invalid after it was returned
  openni::VideoFrameRef depth_frame_;
  double max_difference_ = 0.0;  // seconds, in a pair
  bool is_registered_ = false;
  std::optional<double> offset_;  // seconds from the clock of the device to that of the system
};

}  // namespace

SequenceIndex OpenOpenNiCamera(const std::string& uri) {
  SequenceIndex index;
  index.format = "openni2";
  index.recorder = "camera of OpenNI2";
  index.directory = "openni2:" + uri;
  const auto camera = std::make_shared<OpenNiCamera>(index.directory, uri);
  index.depth_scale = DepthScaleOf(camera->depth());
  index.calibration = NominalCalibration(camera->color(), *index.depth_scale, index.directory);
  if (!camera->is_registered()) {
    index.warnings.push_back(
        "the camera cannot register depth to the colour image; expect wrong depths at edges");
  }
  index.camera = camera;
  return index;
}

}  // namespace msc_vo
