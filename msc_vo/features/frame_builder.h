// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/features/line_backprojection.h"
#include "msc_vo/features/line_extractor.h"
#include "msc_vo/features/point_extractor.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/map/frame.h"
#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/sensor/sensor_noise.h"

namespace msc_vo {

struct FrameBuilderOptions {
  PointExtractorOptions points;
  LineExtractorOptions lines;
  SensorNoiseOptions noise;
  LineFitOptions line_fit;
  LineDepthMethod line_depth = LineDepthMethod::kRobustFit;
  double min_depth = 0.2;  // metres; depth outside [min_depth, max_depth] is invalid
  double max_depth = 10.0;

  bool IsValid(std::string* error) const;
};

using Tasks = std::vector<std::function<void()>>;

// Runs tasks that share nothing, one after the other or side by side, and returns when all are
// done; what one of them throws reaches the caller.
using TaskRunner = std::function<void(const Tasks& tasks)>;

// The one that uses no other thread.
void RunInTurn(const Tasks& tasks);

// Milliseconds spent on the last frame; summed over tasks, which may overlap.
struct FrameBuilderTimes {
  double points = 0.0;
  double lines = 0.0;
  double depth = 0.0;  // depth of points and lines
};

// From an RGB-D image to a Frame: points, lines, their descriptors, their depths; undistorted.
// Keeps its buffers between calls; not for use from several threads at once.
class FrameBuilder {
 public:
  // Throws std::invalid_argument on options or a camera that are not valid.
  FrameBuilder(const FrameBuilderOptions& options, const PinholeCamera& camera,
               const LensDistortion& distortion);
  ~FrameBuilder();

  // `run` gets the lines and each level of the points as tasks, the longest first; the frame does
  // not depend on how it runs them. Throws std::invalid_argument if the image's type or size is not
  // the camera's.
  Frame Build(const RgbdImage& image, const TaskRunner& run = RunInTurn);

  const FrameBuilderTimes& times() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
