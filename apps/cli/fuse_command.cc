// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/depth_fusion.h"
#include "apps/cli/map_argument.h"
#include "apps/cli/modules.h"
#include "apps/cli/output_file.h"
#include "apps/cli/posed_images.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/exports/mesh_ply.h"
#include "msc_vo/report/surface_layer.h"
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
  RefuseMapFile(arguments.trajectory, kNoTrajectory);
  const Configuration configuration = MakeConfiguration(arguments.configuration);
  const RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration);
  PrintWarnings(decoder.Warnings());
  CheckInput(decoder);
  std::vector<std::string> inputs = arguments.configuration.InputFiles();
  inputs.insert(inputs.end(), {arguments.trajectory, arguments.report});
  CheckOutputFile(arguments.output, inputs, {decoder.index()}, {kSurfaceMark});
  const std::string page = ReadReport(arguments.report);
  const std::vector<PosedImage> images =
      FindPosedImages(arguments.trajectory, arguments.poses, decoder);
  SurfaceFusionOptions options = arguments.fusion;
  options.camera = decoder.calibration().camera;
  const std::unique_ptr<SurfaceFusion> fusion = LoadSurfaceFusion(options);
  const FusedImages fused = FuseImages(decoder, images, arguments.quiet, fusion.get());
  const ColoredMesh mesh = ExtractSurface(*fusion, options, !arguments.points);
  WriteFile(arguments.output, FormatMeshPly(mesh));
  if (!arguments.report.empty()) {
    UpdateReport(arguments.report, page, *fusion, mesh, images[images.size() / 2].pose);
  }
  if (!arguments.quiet) PrintResult(arguments, mesh, fused.num_images);
  if (fused.is_interrupted) {
    PrintWarning(FormatText("interrupted; %s is made of %d of %zu images", arguments.output.c_str(),
                            fused.num_images, images.size()));
  }
  return fused.is_interrupted ? kExitInterrupted : kExitSuccess;
}

}  // namespace

Command AddFuseCommand(CLI::App* app) {
  const auto arguments = std::make_shared<FuseArguments>();
  CLI::App* command = app->add_subcommand(
      "fuse", "Fuse the depth images along a trajectory into a coloured surface");
  AddSequenceArguments(command, &arguments->sequence)->required();
  command
      ->add_option(
          "trajectory", arguments->trajectory,
          "Poses of the images: trajectory.txt of a run, or a ground truth on their stamps")
      ->required();
  command
      ->add_option("--output", arguments->output,
                   "PLY file for the surface; in the folder of the sequence, only the surface of "
                   "an earlier run is replaced")
      ->check(CheckPlyFileName)
      ->required();
  CLI::Option* const points =
      command->add_flag("--points", arguments->points, "Write points instead of triangles");
  command
      ->add_option("--report", arguments->report,
                   "Add the surface as a layer to this report.html of a run")
      ->excludes(points);
  command->add_flag("--all-poses", arguments->poses.all_poses,
                    "Also use poses that are marked as not estimated");
  command->add_flag("--quiet", arguments->quiet, "Print neither progress nor results");
  AddFusionArguments(command, &arguments->fusion);
  command->add_option("--every", arguments->poses.every, "Use every Nth image with a pose")
      ->transform(WholeNumberFrom(1, 1e6))
      ->capture_default_str();
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  command->footer(
      HelpFooter("msc_vo fuse my_sequence out/trajectory.txt --output out/surface.ply "
                 "--report out/report.html"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
