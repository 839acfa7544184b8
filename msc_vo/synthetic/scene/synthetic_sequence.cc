// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/synthetic_sequence.h"

#include <cmath>
#include <stdexcept>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/synthetic/scene/image_disturbances.h"
#include "msc_vo/synthetic/scene/motion_blur.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Time stamp of the first frame, seconds. Not 0, which some tools interpret as missing.
constexpr double kFirstTime = 1.0;

// Random numbers of photon noise; those of other noise of the images have smaller numbers.
constexpr uint64_t kPhotonStream = uint64_t{1} << 40;

const Eigen::Vector3d kGravity(0.0, 0.0, -9.81);  // metres/second^2, world

const SyntheticSequenceOptions& Checked(const SyntheticSequenceOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("SyntheticSequence: " + error);
  return options;
}

Scene SceneOf(const SyntheticSequenceOptions& options) {
  Scene scene = MakeScene(options.scene, options.seed, options.walk);
  AddSpecularSurfaces(options.specular, &scene);
  return scene;
}

PinholeCamera ColorCameraOf(const SyntheticSequenceOptions& options) {
  PinholeCamera camera = KinectCamera(options.width, options.height);
  if (options.focal_length > 0.0) camera.fx = camera.fy = options.focal_length;
  return camera;
}

std::optional<LensWarp> WarpOf(const SyntheticSequenceOptions& options,
                               const PinholeCamera& camera) {
  if (options.lens.IsZero()) return std::nullopt;
  return LensWarp(camera, options.lens);
}

bool IsValidLens(const SyntheticSequenceOptions& options, std::string* error) {
  LensDistortion lens = options.lens;
  PinholeCamera camera = ColorCameraOf(options);
  CropToFieldOfView({}, &lens, &camera);
  return IsInvertible(lens, camera, error);
}

PinholeCamera DepthCameraOf(const SyntheticSequenceOptions& options) {
  PinholeCamera camera = KinectCamera(options.width, options.height);
  camera.fx = camera.fy = options.depth_rig->focal_length;
  return camera;
}

bool IsFocalLength(double pixels, int width) {
  return pixels >= 0.1 * width && pixels <= 10.0 * width;
}

std::string FocalLengthError(double pixels, int width) {
  return FormatText("must be from 0.1 to 10 image widths, %g to %d px, not %g px", 0.1 * width,
                    10 * width, pixels);
}

// The first walk has the seed of the scene.
uint64_t WalkSeed(const SyntheticSequenceOptions& options) {
  const uint64_t path = options.walk.path;
  return path == 1 ? options.seed : MixBits(options.seed ^ MixBits(path));
}

PathOptions SeededPath(const SyntheticSequenceOptions& options) {
  PathOptions path = options.path;
  path.seed = WalkSeed(options);
  return path;
}

}  // namespace

SyntheticSequenceOptions QuickWalk(SceneKind scene, uint64_t seed, const WalkOptions& walk) {
  SyntheticSequenceOptions options;
  options.scene = scene;
  options.seed = seed;
  options.walk = walk;
  options.width = 320;
  options.height = 240;
  options.fps = 10.0;
  options.kinect_depth = true;
  options.quick = true;
  options.path.speed = 0.55;
  options.path.turn_rate = DegreesToRadians(55.0);
  return options;
}

bool SyntheticSequenceOptions::IsValid(std::string* error) const {
  if (width < 32 || height < 32 || width > 8192 || height > 8192) {
    *error =
        FormatText("width and height must be from 32 to 8192 pixels, not %dx%d", width, height);
  } else if (!(fps > 0.0)) {
    *error = "fps must be positive";
  } else if (!(std::abs(depth_delay) < 0.5 / fps)) {
    *error = FormatText(
        "depth_delay must be less than %.6g s, half the time between two images, not %g s",
        0.5 / fps, depth_delay);
  } else if (!(std::abs(readout_time) <= 1.0 / fps)) {
    *error =
        FormatText("readout_time must be at most %.6g s, the time between two images, not %g s",
                   1.0 / fps, readout_time);
  } else if (depth_rig && !IsFocalLength(depth_rig->focal_length, width)) {
    *error = "the focal length of depth_rig " + FocalLengthError(depth_rig->focal_length, width);
  } else if (depth_rig && !(depth_rig->depth_from_color.translation().norm() <= 1.0)) {
    *error = FormatText("the offset of depth_rig must be at most 1 m, not %g m",
                        depth_rig->depth_from_color.translation().norm());
  } else if (focal_length != 0.0 && !IsFocalLength(focal_length, width)) {
    *error = "focal_length " + FocalLengthError(focal_length, width);
  } else if (!lens.IsZero() && readout_time != 0.0) {
    *error = "a lens needs a global shutter: give no readout_time";
  } else if (!IsValidLens(*this, error)) {
    return false;
  } else if (!(image_sigma >= 0.0)) {
    *error = "image_sigma must not be negative";
  } else if (!(motion_blur >= 0.0 && motion_blur <= 1.0)) {
    *error = "motion_blur must be from 0 to 1 times the time between two images";
  } else if (!(depth_factor > 0.0)) {
    *error = "depth_factor must be positive";
  } else if (light && !(*light > 0.0 && *light <= 1.0)) {
    *error = "light must be more than 0 and at most 1";
  } else if (!(accelerometer_sigma >= 0.0)) {
    *error = "accelerometer_sigma must not be negative";
  } else if (!(accelerometer_rate > 0.0)) {
    *error = "accelerometer_rate must be positive";
  } else if (walk.returns && !SupportsReturns(scene)) {
    *error = "walk.returns needs a scene with places that look alike";
  } else if (specular.Any() && scene != SceneKind::kRoom) {
    *error = "specular surfaces need the scene room";
  } else if (walk.path < 1) {
    *error = "walk.path must be at least 1";
  } else {
    return kinect.IsValid(error) && icl_nuim.IsValid(error) && path.IsValid(error);
  }
  return false;
}

SyntheticSequence::SyntheticSequence(const SyntheticSequenceOptions& options)
    : options_(Checked(options)),
      walk_seed_(WalkSeed(options)),
      camera_(ColorCameraOf(options)),
      warp_(WarpOf(options, camera_)),
      renderer_(SceneOf(options), warp_ ? warp_->source() : camera_,
                options.quick ? RenderQuality::kQuick : RenderQuality::kFine),
      path_(renderer_.scene(), SeededPath(options)) {
  if (options.depth_rig) depth_renderer_.emplace(renderer_.scene(), DepthCameraOf(options));
  if (options.quick) noise_table_.emplace(options.kinect, depth_camera(), walk_seed_);
}

TimedPose SyntheticSequence::PoseAt(int index) const {
  const double seconds = index / options_.fps;
  return {kFirstTime + seconds, path_.CamFromWorld(seconds).Inverse()};
}

std::optional<int> SyntheticSequence::WalkLength() const {
  if (scene().tour_is_loop) return std::nullopt;
  return static_cast<int>(std::floor(path_.LoopSeconds() * options_.fps)) + 1;
}

SurfaceView SyntheticSequence::SurfacesAt(int index, int width) const {
  return ViewSurfaces(scene(), ScaledCamera(camera_, width),
                      PoseAt(index).world_from_cam.Inverse());
}

Eigen::Vector3d SyntheticSequence::AccelerationAt(double seconds) const {
  // The speed along the path changes in steps, which this interval smooths.
  constexpr double kStep = 0.05;  // seconds
  const Eigen::Vector3d before = path_.CamFromWorld(seconds - kStep).OriginInSource();
  const Eigen::Vector3d at = path_.CamFromWorld(seconds).OriginInSource();
  const Eigen::Vector3d after = path_.CamFromWorld(seconds + kStep).OriginInSource();
  return (before - 2.0 * at + after) / (kStep * kStep);
}

std::vector<TimedAcceleration> SyntheticSequence::AccelerometerReadings(int num_frames) const {
  const double duration = (num_frames - 1) / options_.fps;
  Random random(walk_seed_, 0x616363656c);
  std::vector<TimedAcceleration> readings;
  for (int i = 0; i / options_.accelerometer_rate <= duration; ++i) {
    const double seconds = i / options_.accelerometer_rate;
    const Eigen::Vector3d in_world = AccelerationAt(seconds) - kGravity;
    const Eigen::Vector3d noise = options_.accelerometer_sigma * random.Normal3();
    readings.push_back(
        {kFirstTime + seconds, path_.CamFromWorld(seconds).rotation() * in_world + noise});
  }
  return readings;
}

Rigid3 SyntheticSequence::DepthCameraFromWorld(double seconds) const {
  const Rigid3 color_from_world = path_.CamFromWorld(seconds);
  return options_.depth_rig ? options_.depth_rig->depth_from_color * color_from_world
                            : color_from_world;
}

RenderedImage SyntheticSequence::RenderRolling(
    const Renderer& renderer, const std::function<Rigid3(double)>& camera_from_world,
    double seconds) const {
  return renderer.RenderRows([&](int y) {
    const double after_middle = (y + 0.5) / options_.height - 0.5;  // of the readout, -0.5 to 0.5
    return camera_from_world(seconds + options_.readout_time * after_middle);
  });
}

RenderedImage SyntheticSequence::RenderColor(double seconds, const Rigid3& cam_from_world) const {
  const auto color_from_world = [&](double time) { return path_.CamFromWorld(time); };
  if (options_.readout_time != 0.0) return RenderRolling(renderer_, color_from_world, seconds);
  const RenderedImage image = renderer_.Render(cam_from_world);
  return warp_ ? warp_->Warp(image) : image;
}

RenderedImage SyntheticSequence::RenderDepth(double seconds) const {
  if (!options_.depth_rig) return RenderColor(seconds, path_.CamFromWorld(seconds));
  const auto depth_from_world = [&](double time) { return DepthCameraFromWorld(time); };
  if (options_.readout_time != 0.0) {
    return RenderRolling(*depth_renderer_, depth_from_world, seconds);
  }
  return depth_renderer_->Render(depth_from_world(seconds));
}

SyntheticFrame SyntheticSequence::Render(int index) const {
  const double seconds = index / options_.fps;
  SyntheticFrame frame;
  frame.pose = PoseAt(index);
  frame.image = RenderColor(seconds, frame.pose.world_from_cam.Inverse());
  BlurMotion(seconds, &frame.image);
  if (options_.depth_delay != 0.0 || options_.depth_rig) {
    frame.image.depth = RenderDepth(seconds + options_.depth_delay).depth;
  }
  // Even streams for colour, odd streams for depth, so that their noise is independent.
  DisturbColor(index, &frame.image);
  DisturbDepth(2 * static_cast<uint64_t>(index) + 1, &frame.image.depth);
  return frame;
}

void SyntheticSequence::BlurMotion(double seconds, RenderedImage* image) const {
  if (options_.motion_blur == 0.0) return;
  const double exposure = options_.motion_blur / options_.fps;
  const Rigid3 begin = path_.CamFromWorld(seconds - 0.5 * exposure);
  const Rigid3 end = path_.CamFromWorld(seconds + 0.5 * exposure);
  const int count =
      NumExposureSamples(LargestImageMotion(camera_, image->depth, end * begin.Inverse()));
  if (count == 1) return;
  ImageMean mean;
  for (int k = 0; k < count; ++k) {
    const double time = seconds + exposure * ((k + 0.5) / count - 0.5);
    mean.Add(RenderColor(time, path_.CamFromWorld(time)).rgb);
  }
  image->rgb = mean.Value();
}

void SyntheticSequence::DisturbColor(int index, RenderedImage* image) const {
  const uint64_t frame = static_cast<uint64_t>(index);
  if (options_.hunting_exposure) ApplyHuntingExposure(index / options_.fps, image);
  if (options_.light) {
    AddPhotonNoise(*options_.light, walk_seed_, kPhotonStream + frame, image);
  }
  if (options_.image_sigma > 0.0 && noise_table_) {
    noise_table_->AddImageNoise(options_.image_sigma, 2 * frame, image);
  } else if (options_.image_sigma > 0.0) {
    AddImageNoise(options_.image_sigma, walk_seed_, 2 * frame, image);
  }
}

void SyntheticSequence::DisturbDepth(uint64_t stream, std::vector<float>* depth) const {
  AddDepthNoise(stream, depth);
  if (options_.depth_factor == 1.0) return;
  for (float& z : *depth) z = static_cast<float>(options_.depth_factor * z);
}

void SyntheticSequence::AddDepthNoise(uint64_t stream, std::vector<float>* depth) const {
  const uint64_t seed = walk_seed_;
  switch (options_.kinect_depth ? SyntheticDepth::kStructuredLight : options_.depth) {
    case SyntheticDepth::kExact:
      return;
    case SyntheticDepth::kStructuredLight:
      if (noise_table_) {
        return noise_table_->AddKinectNoise(options_.kinect, depth_camera(), stream, depth);
      }
      return AddKinectNoise(options_.kinect, depth_camera(), seed, stream, depth);
    case SyntheticDepth::kTimeOfFlight:
      return AddTimeOfFlightNoise(options_.time_of_flight, depth_camera(), seed, stream, depth);
    case SyntheticDepth::kStereo:
      return AddStereoNoise(options_.stereo, depth_camera(), seed, stream, depth);
    case SyntheticDepth::kLidar:
      return AddLidarNoise(options_.lidar, depth_camera(), seed, stream, depth);
    case SyntheticDepth::kIclNuim:
      return AddKinectNoise(options_.icl_nuim, depth_camera(), seed, stream, depth);
  }
}

}  // namespace msc_vo
