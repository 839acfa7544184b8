// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/kinect_noise.h"
#include "msc_vo/synthetic/scene/renderer.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

struct SyntheticSequenceOptions {
  SceneKind scene = SceneKind::kRoom;
  uint64_t seed = 1;  // of the scene, the path and the noise
  int width = 640;    // pixels
  int height = 480;
  double fps = 30.0;
  // Seconds after its colour image that each depth image is taken; negative: before.
  double depth_delay = 0.0;
  // Seconds that the rows of an image, colour or depth, take one after the other: a rolling
  // shutter, for a Kinect about 0.026. Row v of `height` is of readout_time * ((v + 0.5) / height -
  // 0.5) after the image's time. Negative: the last row is first; 0: all at once.
  double readout_time = 0.0;
  // Grey levels: a Kinect's colour camera indoors has about 2. 0: none.
  double image_sigma = 2.0;
  bool kinect_depth = false;  // otherwise depth is exact
  KinectNoiseOptions kinect;
  PathOptions path;  // its seed is replaced by the one above

  bool IsValid(std::string* error) const;
};

struct SyntheticFrame {
  TimedPose pose;       // the truth; its time stamp is the images', the middle of their readout
  RenderedImage image;  // its depth is of depth_delay later
};

// An endless RGB-D recording: a walk through a scene, frame by frame in any order.
class SyntheticSequence {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  // Frame `index` >= 0; the same index gives the same bytes.
  SyntheticFrame Render(int index) const;
  TimedPose PoseAt(int index) const;

  const PinholeCamera& camera() const { return renderer_.camera(); }
  const Scene& scene() const { return renderer_.scene(); }

 private:
  // The image whose readout has its middle `seconds` after the start.
  RenderedImage RenderRolling(double seconds) const;

  SyntheticSequenceOptions options_;
  Renderer renderer_;
  CameraPath path_;
};

}  // namespace msc_vo
