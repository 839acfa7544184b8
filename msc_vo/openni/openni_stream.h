// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <string>

#include <OpenNI.h>
#include <opencv2/core.hpp>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

/// The library OpenNI2 is initialised while such an object exists.
class OpenNiLibrary {
 public:
  OpenNiLibrary();  ///< throws std::runtime_error if that fails
  ~OpenNiLibrary();
  OpenNiLibrary(const OpenNiLibrary&) = delete;
  OpenNiLibrary& operator=(const OpenNiLibrary&) = delete;
};

/// One stream of its own device handle, which is closed with it.
struct OpenNiStream {
  openni::Device device;
  openni::VideoStream stream;

  ~OpenNiStream();
};

/// Throws std::runtime_error "NAME: ACTION failed: text of OpenNI" unless the status is good.
void CheckStatus(openni::Status status, const std::string& name, const std::string& action);

/// Seconds on the clock of the device.
double TimeOf(const openni::VideoFrameRef& frame);

/// Copies a colour frame as grey values or BGR, or a depth frame with its raw units, mirrored if
/// `is_mirrored`. Throws std::runtime_error, naming the source, on another pixel format.
cv::Mat ColorOf(const openni::VideoFrameRef& frame, bool is_mirrored, const std::string& name);
cv::Mat DepthOf(const openni::VideoFrameRef& frame, bool is_mirrored, const std::string& name);

/// Raw depth units per metre of a depth stream.
double DepthScaleOf(const openni::VideoStream& depth);

/// Nominal calibration from the field of view of the stream that the other one is registered to;
/// none if the stream does not name it.
std::optional<Calibration> NominalCalibration(const openni::VideoStream& stream, double depth_scale,
                                              const std::string& name);

}  // namespace msc_vo
