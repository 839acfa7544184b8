// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/depth_fusion.h"

#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/progress.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/sensor/lens_remap.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// The colour image as it is stored.
cv::Mat ReadColor(const SequenceIndex& index, int i) {
  const SequenceEntry& entry = index.entries.at(static_cast<size_t>(i));
  if (!index.container) {
    const cv::Mat color = ReadImageFile(entry.color_path);
    if (color.empty()) throw UnreadableImage(i, entry.color_path + ": cannot be read as an image");
    return color;
  }
  const StoredImage stored = index.container->ReadColor(entry.color_index);
  return stored.bytes.empty()
             ? stored.pixels
             : DecodeImage(stored.bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

// The colour image as RGB in the size of the depth image.
cv::Mat ToRgb(cv::Mat color, cv::Size size) {
  if (color.channels() == 1) {
    cv::cvtColor(color, color, cv::COLOR_GRAY2RGB);
  } else {
    cv::cvtColor(color, color, color.channels() == 4 ? cv::COLOR_BGRA2RGB : cv::COLOR_BGR2RGB);
  }
  if (color.size() != size) cv::resize(color, color, size, 0.0, 0.0, cv::INTER_AREA);
  return color;
}

// Moves every measurement to the pixel of the ideal image that it belongs to. Interpolation would
// invent surfaces between foreground and background.
class DepthUndistorter {
 public:
  DepthUndistorter(const PinholeCamera& camera, const LensDistortion& distortion) {
    if (distortion.IsZero()) return;
    raw_pixel_.create(camera.height, camera.width);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector2d raw = distortion.Distort(camera, Eigen::Vector2d(x, y));
        raw_pixel_(y, x) = {static_cast<float>(raw.x()), static_cast<float>(raw.y())};
      }
    }
  }

  cv::Mat Undistort(const cv::Mat& raw) const {
    if (raw_pixel_.empty()) return raw;
    cv::Mat ideal;
    cv::remap(raw, ideal, raw_pixel_, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT);
    return ideal;
  }

 private:
  cv::Mat_<cv::Vec2f> raw_pixel_;  // of every ideal pixel; empty without distortion
};

}  // namespace

FusedImages FuseImages(const RgbdDecoder& decoder, const std::vector<PosedImage>& images,
                       bool quiet, SurfaceFusion* fusion) {
  const Calibration& calibration = decoder.calibration();
  const LensRemap remap(calibration.camera, calibration.distortion);
  const DepthUndistorter depth_remap(calibration.camera, calibration.distortion);
  const InterruptGuard interrupt;
  Progress progress(static_cast<int>(images.size()));
  FusedImages fused;
  int done = 0;
  for (const PosedImage& image : images) {
    fused.is_interrupted = interrupt.IsInterrupted();
    if (fused.is_interrupted) break;
    ++done;
    try {
      const cv::Mat depth = decoder.Decode(image.index).depth;
      const cv::Mat color = ToRgb(ReadColor(decoder.index(), image.index), depth.size());
      fusion->Add(depth_remap.Undistort(depth), remap.Undistort(color),
                  image.pose.world_from_cam.Inverse());
      ++fused.num_images;
    } catch (const UnreadableImage& error) {
      PrintWarning(error.what());
    }
    if (!quiet) progress.Update(done, "fused");
  }
  if (!quiet) progress.Finish();
  return fused;
}

ColoredMesh ExtractSurface(const SurfaceFusion& fusion, const SurfaceFusionOptions& options,
                           bool with_triangles) {
  ColoredMesh mesh = fusion.Extract(with_triangles);
  if (mesh.positions.empty()) {
    throw std::runtime_error(
        "no surface: no part of the scene was measured in " +
        FormatText(
            "%d images (--min-observations) within %g m (--max-depth) at voxels of %g m (--voxel)",
            options.min_observations, options.max_depth, options.voxel_size));
  }
  SortMesh(&mesh);
  return mesh;
}

void AddFusionArguments(CLI::App* command, SurfaceFusionOptions* options) {
  command->add_option("--voxel", options->voxel_size, "Size of a voxel, metres")
      ->check(NumberFrom(0.001, 1.0))
      ->capture_default_str();
  command
      ->add_option("--max-depth", options->max_depth,
                   "Measurements beyond this depth are ignored, metres")
      ->check(NumberFrom(0.1, 100.0))
      ->capture_default_str();
  command
      ->add_option("--min-observations", options->min_observations,
                   "Images that must have seen a part of the surface")
      ->transform(WholeNumberFrom(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--max-memory", options->max_memory_mib,
                   "Stop with an error if the voxels need more, MiB")
      ->check(NumberFrom(16.0, 1e6))
      ->capture_default_str();
}

}  // namespace msc_vo
