// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/input_check.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/modules.h"
#include "apps/cli/number_range.h"
#include "apps/cli/output_file.h"
#include "apps/cli/posed_images.h"
#include "apps/cli/progress.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/report/surface_layer.h"
#include "msc_vo/results/mesh_ply.h"
#include "msc_vo/sensor/lens_remap.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr size_t kMaxReportBytes = size_t{256} << 20;

struct FuseArguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  std::string trajectory;
  std::string output;
  std::string report;  // empty: none
  SurfaceFusionOptions fusion;
  PoseSelection poses;
  bool points = false;
  bool quiet = false;
};

// The colour image as RGB in the size of the depth image.
cv::Mat ReadColor(const SequenceEntry& entry, cv::Size size) {
  cv::Mat color = ReadImageFile(entry.color_path);
  if (color.empty()) throw std::runtime_error(entry.color_path + ": cannot be read as an image");
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

struct Progressed {
  int num_images = 0;  // in the surface
  bool interrupted = false;
};

// Adds the images. Those that cannot be read are left out with a warning.
Progressed AddImages(const RgbdDecoder& decoder, const std::vector<PosedImage>& images, bool quiet,
                     SurfaceFusion* fusion) {
  const Calibration& calibration = decoder.calibration();
  const LensRemap remap(calibration.camera, calibration.distortion);
  const DepthUndistorter depth_remap(calibration.camera, calibration.distortion);
  const InterruptGuard interrupt;
  Progress progress(static_cast<int>(images.size()));
  Progressed progressed;
  int done = 0;
  for (const PosedImage& image : images) {
    progressed.interrupted = interrupt.IsInterrupted();
    if (progressed.interrupted) break;
    ++done;
    try {
      const cv::Mat depth = decoder.Decode(image.index).depth;
      const cv::Mat color = ReadColor(decoder.index().entries[image.index], depth.size());
      fusion->Add(depth_remap.Undistort(depth), remap.Undistort(color),
                  image.pose.world_from_cam.Inverse());
      ++progressed.num_images;
    } catch (const UnreadableImage& error) {
      PrintWarning(error.what());
    }
    if (!quiet) progress.Update(done, "fused");
  }
  if (!quiet) progress.Finish();
  return progressed;
}

// The report that the surface is added to; empty without one.
std::string ReadReport(const std::string& path) {
  if (path.empty()) return "";
  std::string page = ReadFile(path, kMaxReportBytes);
  if (!IsInteractiveReport(page)) {
    throw std::runtime_error(path +
                             ": is no interactive report of msc_vo; give the report.html of a "
                             "run, written by an msc_vo that was built with three.js");
  }
  return page;
}

// Adds the surface as a layer to the report of a run. `pose`: of one of the images.
void UpdateReport(const std::string& path, const std::string& page, const SurfaceFusion& fusion,
                  const ColoredMesh& mesh, const TimedPose& pose) {
  ColoredMesh layer = fusion.Simplify(mesh, kMaxSurfaceTriangles);
  SortMesh(&layer);
  WriteFile(path, AddSurfaceLayer(page, layer, pose));
}

void PrintResult(const FuseArguments& arguments, const ColoredMesh& mesh, int num_images) {
  std::cout << FormatText("%s: %zu vertices, %zu triangles from %d images\n",
                          arguments.output.c_str(), mesh.positions.size(), mesh.triangles.size(),
                          num_images);
  if (!arguments.report.empty()) std::cout << arguments.report << ": shows the surface\n";
}

int Run(const FuseArguments& arguments) {
  const Configuration configuration = MakeConfiguration(arguments.configuration);
  const RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration);
  PrintWarnings(decoder.Warnings());
  CheckInput(decoder);
  std::vector<std::string> inputs = arguments.configuration.InputFiles();
  inputs.insert(inputs.end(), {arguments.trajectory, arguments.report});
  CheckOutputFile(arguments.output, inputs, {decoder.index()});
  const std::string page = ReadReport(arguments.report);
  const std::vector<PosedImage> images =
      FindPosedImages(arguments.trajectory, arguments.poses, decoder);
  SurfaceFusionOptions options = arguments.fusion;
  options.camera = decoder.calibration().camera;
  const std::unique_ptr<SurfaceFusion> fusion = LoadSurfaceFusion(options);
  const Progressed progressed = AddImages(decoder, images, arguments.quiet, fusion.get());
  ColoredMesh mesh = fusion->Extract(!arguments.points);
  if (mesh.positions.empty()) {
    throw std::runtime_error(
        "no surface: no part of the scene was measured often enough within --max-depth (" +
        FormatText("%g m) at --voxel %g m", options.max_depth, options.voxel_size));
  }
  SortMesh(&mesh);
  WriteFile(arguments.output, FormatMeshPly(mesh));
  if (!arguments.report.empty()) {
    UpdateReport(arguments.report, page, *fusion, mesh, images[images.size() / 2].pose);
  }
  if (!arguments.quiet) PrintResult(arguments, mesh, progressed.num_images);
  return progressed.interrupted ? kExitInterrupted : kExitSuccess;
}

void AddFusionArguments(CLI::App* command, FuseArguments* arguments) {
  command->add_option("--voxel", arguments->fusion.voxel_size, "Size of a voxel, metres")
      ->check(NumberFrom(0.001, 1.0))
      ->capture_default_str();
  command
      ->add_option("--max-depth", arguments->fusion.max_depth,
                   "Measurements beyond this depth are ignored, metres")
      ->check(NumberFrom(0.1, 100.0))
      ->capture_default_str();
  command
      ->add_option("--min-observations", arguments->fusion.min_observations,
                   "Images that must have seen a part of the surface")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--max-memory", arguments->fusion.max_memory_mib,
                   "Stop with an error if the voxels need more, MiB")
      ->check(NumberFrom(16.0, 1e6))
      ->capture_default_str();
  command->add_option("--every", arguments->poses.every, "Use every Nth image with a pose")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
}

}  // namespace

Command AddFuseCommand(CLI::App* app) {
  const auto arguments = std::make_shared<FuseArguments>();
  CLI::App* command = app->add_subcommand(
      "fuse", "Fuse the depth images along a trajectory into a coloured surface");
  AddSequenceArguments(command, &arguments->sequence)->required();
  AddMaskArguments(command, &arguments->sequence);
  command
      ->add_option(
          "trajectory", arguments->trajectory,
          "Poses of the images: trajectory.txt of a run, or a ground truth on their stamps")
      ->required();
  command->add_option("--output", arguments->output, "PLY file for the surface")->required();
  CLI::Option* const points =
      command->add_flag("--points", arguments->points, "Write points instead of triangles");
  command
      ->add_option("--report", arguments->report,
                   "Add the surface as a layer to this report.html of a run")
      ->excludes(points);
  command->add_flag("--all-poses", arguments->poses.all_poses,
                    "Also use poses that are marked as not estimated");
  command->add_flag("--quiet", arguments->quiet, "Print neither progress nor results");
  AddFusionArguments(command, arguments.get());
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  command->footer(
      HelpFooter("msc_vo fuse my_sequence out/trajectory.txt --output out/surface.ply "
                 "--report out/report.html"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
