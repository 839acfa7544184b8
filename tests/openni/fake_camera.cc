// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A driver of OpenNI2 with one camera that plays the images of the file named by the environment
// variable MSC_VO_FAKE_CAMERA at 30 Hz; see fake_camera_file.h.

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#define XN_NEW(Type, argument) new Type(argument)
#define XN_DELETE(pointer) delete pointer
#include "tests/openni/fake_camera_file.h"
#include <Driver/OniDriverAPI.h>

namespace {

using msc_vo::FakeCameraHeader;

FakeCameraHeader ReadHeader() {
  FakeCameraHeader header;
  std::ifstream file(std::getenv("MSC_VO_FAKE_CAMERA"), std::ios::binary);
  file.read(reinterpret_cast<char*>(&header), sizeof(header));
  return header;
}

class FakeStream : public oni::driver::StreamBase {
 public:
  explicit FakeStream(bool is_color) : header_(ReadHeader()), is_color_(is_color) {}
  ~FakeStream() override { StopThread(); }

  OniStatus start() override {
    stopping_ = false;
    thread_ = std::thread([this] { Play(); });
    return ONI_STATUS_OK;
  }
  void stop() override { StopThread(); }

  OniBool isPropertySupported(int id) override {
    return id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV ||
           id == ONI_STREAM_PROPERTY_VERTICAL_FOV || id == ONI_STREAM_PROPERTY_MIRRORING ||
           id == ONI_STREAM_PROPERTY_STRIDE || id == ONI_STREAM_PROPERTY_CROPPING;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return Return(Mode(), data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return Return(header_.horizontal_fov, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return Return(header_.vertical_fov, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return Return(OniBool{FALSE}, data, size);
      // The player of recordings needs both of these.
      case ONI_STREAM_PROPERTY_STRIDE:
        return Return(header_.width * (is_color_ ? 3 : 2), data, size);
      case ONI_STREAM_PROPERTY_CROPPING:
        return Return(OniCropping{FALSE, 0, 0, 0, 0}, data, size);
      default:
        return ONI_STATUS_NOT_IMPLEMENTED;
    }
  }
  OniStatus setProperty(int id, const void* /*data*/, int /*size*/) override {
    return id == ONI_STREAM_PROPERTY_MIRRORING || id == ONI_STREAM_PROPERTY_VIDEO_MODE
               ? ONI_STATUS_OK
               : ONI_STATUS_NOT_IMPLEMENTED;
  }

  OniVideoMode Mode() const {
    return {is_color_ ? ONI_PIXEL_FORMAT_RGB888 : ONI_PIXEL_FORMAT_DEPTH_1_MM, header_.width,
            header_.height, 30};
  }

 private:
  template <typename Value>
  static OniStatus Return(const Value& value, void* data, int* size) {
    if (*size != static_cast<int>(sizeof(value))) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &value, sizeof(value));
    return ONI_STATUS_OK;
  }

  void StopThread() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  void Play() {
    const size_t color_bytes = size_t{3} * header_.width * header_.height;
    const size_t depth_bytes = size_t{2} * header_.width * header_.height;
    const size_t bytes = is_color_ ? color_bytes : depth_bytes;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < header_.count && !stopping_; ++i) {
      std::this_thread::sleep_until(start + std::chrono::microseconds(33333) * (i + 1));
      std::ifstream file(std::getenv("MSC_VO_FAKE_CAMERA"), std::ios::binary);
      file.seekg(static_cast<std::streamoff>(sizeof(header_) + i * (color_bytes + depth_bytes) +
                                             (is_color_ ? 0 : color_bytes)));
      OniFrame* const frame = getServices().acquireFrame();
      if (!frame) return;
      file.read(static_cast<char*>(frame->data), static_cast<std::streamsize>(bytes));
      frame->dataSize = static_cast<int>(bytes);
      frame->frameIndex = i + 1;
      frame->timestamp = 1000000 + 33333ULL * i + (is_color_ ? 0 : 2000);
      frame->sensorType = is_color_ ? ONI_SENSOR_COLOR : ONI_SENSOR_DEPTH;
      frame->videoMode = Mode();
      frame->width = header_.width;
      frame->height = header_.height;
      frame->stride = static_cast<int>(bytes) / header_.height;
      frame->cropOriginX = frame->cropOriginY = 0;
      frame->croppingEnabled = FALSE;
      raiseNewFrame(frame);
      getServices().releaseFrame(frame);
    }
  }

  FakeCameraHeader header_;
  bool is_color_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

class FakeDevice : public oni::driver::DeviceBase {
 public:
  FakeDevice() {
    for (int i = 0; i < 2; ++i) {
      modes_[i] = FakeStream(i == 0).Mode();
      sensors_[i] = {i == 0 ? ONI_SENSOR_COLOR : ONI_SENSOR_DEPTH, 1, &modes_[i]};
    }
  }
  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = 2;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override {
    return new FakeStream(type == ONI_SENSOR_COLOR);
  }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode /*mode*/) override {
    return TRUE;
  }
  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniStatus setProperty(int id, const void* data, int size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || size != sizeof(registration_)) {
      return ONI_STATUS_NOT_IMPLEMENTED;
    }
    std::memcpy(&registration_, data, sizeof(registration_));
    return ONI_STATUS_OK;
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || *size != sizeof(registration_)) {
      return ONI_STATUS_NOT_IMPLEMENTED;
    }
    std::memcpy(data, &registration_, sizeof(registration_));
    return ONI_STATUS_OK;
  }

 private:
  OniVideoMode modes_[2];
  OniSensorInfo sensors_[2];
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
};

class FakeDriver : public oni::driver::DriverBase {
 public:
  explicit FakeDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    if (!std::getenv("MSC_VO_FAKE_CAMERA")) return ONI_STATUS_OK;
    std::memset(&info_, 0, sizeof(info_));
    std::strcpy(info_.uri, "fake");
    std::strcpy(info_.vendor, "msc_vo");
    std::strcpy(info_.name, "fake camera");
    deviceConnected(&info_);
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char* /*uri*/, const char* /*mode*/) override {
    return new FakeDevice;
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {}

 private:
  OniDeviceInfo info_;
};

}  // namespace

ONI_EXPORT_DRIVER(FakeDriver)
