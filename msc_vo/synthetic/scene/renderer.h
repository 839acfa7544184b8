// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

struct RowBand;

/// A rendered RGB-D image in plain buffers, row by row from the upper left pixel.
struct RenderedImage {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;  ///< 3 * width * height: red, green, blue
  /// width * height, metres along z, exact at the pixel's centre; 0: nothing
  std::vector<float> depth;

  /// Grey image (ITU-R 601 luma), width * height.
  std::vector<uint8_t> Gray() const;
};

/// How exactly the colours of a pixel are averaged. The depth is exact.
enum class RenderQuality {
  kFine,   ///< up to 16 samples per pixel
  kQuick,  ///< up to 4 samples per pixel, for benchmarks
};

/// Renders a scene: rectangles with a depth buffer, one exact hit per pixel centre, then colour by
/// box-filtered samples, with more samples where neighbouring pixels differ.
class Renderer {
 public:
  /// Throws std::invalid_argument if the camera is invalid.
  Renderer(Scene scene, const PinholeCamera& camera, RenderQuality quality = RenderQuality::kFine);

  RenderedImage Render(const Rigid3& cam_from_world) const;

  /// Renders with a rolling shutter: row y equals that of Render(cam_from_world_of(y)), bit by bit.
  RenderedImage RenderRows(const std::function<Rigid3(int y)>& cam_from_world_of) const;

  const Scene& scene() const { return scene_; }
  const PinholeCamera& camera() const { return camera_; }

 private:
  RenderedImage BlankImage() const;
  // Draws the rows of a band, without and with specular surfaces.
  void DrawDiffuse(const Rigid3& cam_from_world, const RowBand& band, RenderedImage* image) const;
  void DrawBand(const Rigid3& cam_from_world, const RowBand& band, RenderedImage* image) const;
  void DrawSpecular(size_t index, const Rigid3& cam_from_world, const RowBand& band,
                    RenderedImage* image) const;

  Scene scene_;
  std::vector<Renderer> reflections_;  // the mirror image of each specular surface
  PinholeCamera camera_;
  RenderQuality quality_;
};

/// Camera with the focal length of a Kinect, 525 px at a width of 640 px, scaled with the width;
/// the principal point is the centre of the image.
PinholeCamera KinectCamera(int width, int height);

/// Rounds to a grey value, 0 to 255.
uint8_t ToGrayValue(float value);

/// Adds normal noise of `sigma` grey values, the same deviate to the three colours of a pixel.
void AddImageNoise(double sigma, uint64_t seed, uint64_t frame, RenderedImage* image);

}  // namespace msc_vo
