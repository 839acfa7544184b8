// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/timed_acceleration.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/depth_artifacts.h"
#include "msc_vo/synthetic/scene/kinect_noise.h"
#include "msc_vo/synthetic/scene/lens_warp.h"
#include "msc_vo/synthetic/scene/renderer.h"
#include "msc_vo/synthetic/scene/scene.h"
#include "msc_vo/synthetic/scene/specular_surface.h"
#include "msc_vo/synthetic/scene/surface_view.h"
#include "msc_vo/synthetic/scene/synthetic_depth.h"

namespace msc_vo {

/// A depth camera beside the colour camera. Its images have the size of the colour images, and the
/// principal point is the centre of the image.
struct DepthRig {
  double focal_length = 585.0;  ///< pixels
  Rigid3 depth_from_color;
};

struct SyntheticSequenceOptions {
  SceneKind scene = SceneKind::kRoom;
  uint64_t seed = 1;  ///< of the scene, the path and the noise
  /// Which walk through the scene is recorded; other paths have other noise, too.
  WalkOptions walk;
  SpecularOptions specular;  ///< needs SceneKind::kRoom
  int width = 640;           ///< pixels
  int height = 480;
  /// Focal length, pixels; 0: that of KinectCamera().
  double focal_length = 0.0;
  /// Lens of the colour camera, and of depth without a rig; needs a global shutter.
  LensDistortion lens;
  double fps = 30.0;
  /// Time of a depth image relative to its colour image, seconds.
  double depth_delay = 0.0;
  /// Readout time of the rolling shutter of both images, seconds; about 0.026 for a Kinect. Row v
  /// of `height` is exposed readout_time * ((v + 0.5) / height - 0.5) after the image's time stamp.
  /// Negative: from the last row to the first; 0: global shutter.
  double readout_time = 0.0;
  /// Standard deviation of the image noise, grey values; about 2 for a Kinect indoors.
  double image_sigma = 2.0;
  /// Fraction of the light of a well-lit scene, more than 0 and at most 1: its photon noise, whose
  /// variance grows with the grey value, is added to that of image_sigma; none: no photon noise.
  std::optional<double> light;
  /// Exposure that changes periodically, with darker corners; otherwise it is constant.
  bool hunting_exposure = false;
  /// Exposure time of the colour images as a fraction of the time between two images, 0 to 1.
  double motion_blur = 0.0;
  SyntheticDepth depth = SyntheticDepth::kExact;
  bool kinect_depth = false;  ///< short for depth = SyntheticDepth::kStructuredLight
  KinectNoiseOptions kinect;
  KinectNoiseOptions icl_nuim = IclNuimNoise();
  TimeOfFlightOptions time_of_flight;
  StereoOptions stereo;
  LidarOptions lidar;
  /// Recorded depth divided by measured depth; 1: the depth scale is right.
  double depth_factor = 1.0;
  /// Camera that records depth, which is not registered to colour then; none: the colour camera.
  std::optional<DepthRig> depth_rig;
  /// Standard deviation of the noise of the accelerometer, of each axis, metres/second^2.
  double accelerometer_sigma = 0.05;
  double accelerometer_rate = 100.0;  ///< readings per second
  PathOptions path;                   ///< its seed is ignored
  /// Renders in a fraction of the time, for benchmarks: RenderQuality::kQuick, and the noise of
  /// image_sigma and of structured light from a NoiseTable.
  bool quick = false;

  bool IsValid(std::string* error) const;
};

/// A walk that renders quickly, for benchmarks and tests of loops: 320 x 240 pixels at 10 Hz, the
/// noise of a Kinect, 0.55 m/s and 55 degrees/s.
SyntheticSequenceOptions QuickWalk(SceneKind scene, uint64_t seed, const WalkOptions& walk);

struct SyntheticFrame {
  TimedPose pose;       ///< ground truth at the time stamp, the middle of the colour readout
  RenderedImage image;  ///< the depth is taken depth_delay later, by the depth rig if there is one
};

/// An endless rendered RGB-D sequence along a trajectory through a scene, with random access.
class SyntheticSequence {
 public:
  /// Throws std::invalid_argument on invalid options.
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  /// Renders frame `index` >= 0. Deterministic for a given index.
  SyntheticFrame Render(int index) const;
  TimedPose PoseAt(int index) const;
  /// Readings of an accelerometer in the optical centre, with the axes of the camera, from the
  /// first to the last of `num_frames` >= 1 images. The acceleration is a mean over 0.1 seconds.
  std::vector<TimedAcceleration> AccelerometerReadings(int num_frames) const;

  /// Intrinsics and size of the recorded colour images.
  const PinholeCamera& camera() const { return camera_; }
  /// The camera that records depth: that of the rig, or the colour camera.
  const PinholeCamera& depth_camera() const {
    return depth_renderer_ ? depth_renderer_->camera() : camera_;
  }
  const Scene& scene() const { return renderer_.scene(); }
  /// Number of images until the end of a tour that is no loop; std::nullopt for loops.
  std::optional<int> WalkLength() const;
  /// The surfaces in frame `index`, sampled by `width` pixels per row.
  SurfaceView SurfacesAt(int index, int width = 64) const;

 private:
  // Acceleration of the optical centre in the world, metres/second^2.
  Eigen::Vector3d AccelerationAt(double seconds) const;
  Rigid3 DepthCameraFromWorld(double seconds) const;
  // Applies the errors of the colour camera to frame `index`.
  void DisturbColor(int index, RenderedImage* image) const;
  // Applies the errors of the depth sensor; `stream` of the random numbers.
  void DisturbDepth(uint64_t stream, std::vector<float>* depth) const;
  void AddDepthNoise(uint64_t stream, std::vector<float>* depth) const;
  // Replaces the colours of the image at `seconds` by those of its exposure time; its depth must be
  // exact.
  void BlurMotion(double seconds, RenderedImage* image) const;
  // The image whose readout is centred `seconds` after the start.
  RenderedImage RenderRolling(const Renderer& renderer,
                              const std::function<Rigid3(double seconds)>& camera_from_world,
                              double seconds) const;

  // The image of the colour camera at `seconds`; `cam_from_world`: its pose without a rolling
  // shutter.
  RenderedImage RenderColor(double seconds, const Rigid3& cam_from_world) const;
  // The image of the camera that records depth.
  RenderedImage RenderDepth(double seconds) const;

  SyntheticSequenceOptions options_;
  uint64_t walk_seed_;  // of the path and the noise
  PinholeCamera camera_;
  std::optional<LensWarp> warp_;  // none: no lens distortion
  Renderer renderer_;
  std::optional<Renderer> depth_renderer_;  // of the rig
  CameraPath path_;
  std::optional<NoiseTable> noise_table_;  // if quick
};

}  // namespace msc_vo
