// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/features/line_backprojection.h"
#include "msc_vo/features/line_extractor.h"
#include "msc_vo/features/plane_extractor.h"
#include "msc_vo/features/point_extractor.h"
#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/sensor/depth_sensor.h"
#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

struct FrameBuilderOptions {
  PointExtractorOptions points;
  LineExtractorOptions lines;
  DepthSensor depth_sensor = DepthSensor::kAuto;
  SensorNoiseOptions noise;
  LineDepthMethod line_depth = LineDepthMethod::kRobustFit;
  double min_depth = 0.2;  ///< metres; depth outside [min_depth, max_depth] is invalid
  double max_depth = 10.0;
  bool extract_planes = true;
};

using Tasks = std::vector<std::function<void()>>;

/// Runs independent tasks, sequentially or in parallel, and returns when all have finished.
/// Exceptions of a task are passed on to the caller.
using TaskRunner = std::function<void(const Tasks& tasks)>;

/// Runs the tasks one after the other in the calling thread.
void RunSequentially(const Tasks& tasks);

/// Milliseconds spent on the last frame, summed over tasks, which may overlap.
struct FrameBuilderTimes {
  double points = 0.0;
  double lines = 0.0;
  double depth = 0.0;  ///< depth of points and lines
};

/// Builds a Frame from an RGB-D image: detects points and lines, computes their descriptors and
/// depths, and undistorts them. Keeps its buffers between calls; not thread-safe.
class FrameBuilder {
 public:
  /// The options must be valid (OdometryOptions::IsValid). Throws std::invalid_argument on an
  /// invalid camera.
  FrameBuilder(const FrameBuilderOptions& options, const PinholeCamera& camera,
               const LensDistortion& distortion);
  ~FrameBuilder();

  /// Throws std::invalid_argument if type or size of the image or its mask do not match the camera.
  void Check(const RgbdImage& image) const;

  /// `run` is given one task for the lines and one for each pyramid level of the points, the
  /// longest first; the result does not depend on their order. Throws as Check()
  /// does.
  Frame Build(const RgbdImage& image, const TaskRunner& run = RunSequentially);

  /// The calibration that frames are built with.
  const std::shared_ptr<const CameraIntrinsics>& intrinsics() const;
  /// Replaces it by one for images of the same size. If the registration of depth changes, what the
  /// images have told about the sensor is forgotten. Throws std::invalid_argument if it is invalid.
  void SetIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics);

  const FrameBuilderTimes& times() const;
  /// The depth sensor of the options, or the one inferred from the first depth images; kAuto until
  /// an image has enough depth.
  DepthSensor depth_sensor() const;

  /// Writes or reads what is known of the sensor from the images so far, for a checkpoint. Defined
  /// for BinaryWriter and BinaryReader.
  template <typename Archive>
  void Serialize(Archive& archive);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
