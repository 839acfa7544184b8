// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/run_export.h"

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "apps/cli/command_log.h"
#include "apps/cli/exported_features.h"
#include "apps/cli/exported_images.h"
#include "apps/cli/exported_map.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/map_argument.h"
#include "apps/cli/modules.h"
#include "apps/cli/output_file.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/exports/mcap_export.h"
#include "msc_vo/exports/mesh_ply.h"
#include "msc_vo/exports/nerfstudio.h"
#include "msc_vo/exports/recorded_run.h"
#include "msc_vo/exports/trajectory_export.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

constexpr char kTumMark[] = "# written by msc_vo export";

// Regular expressions, see OutputKind. The columns of FormatEuroc(): those of EuRoC also have
// velocities.
constexpr char kEurocBeginning[] = R"(#timestamp \[ns\],p_RS_R_x[^v\n]*q_RS_z \[\]\n)";
// Twelve numbers as FormatKitti() writes them: without trailing zeros, which those of KITTI have.
constexpr char kKittiBeginning[] = R"((-?\d+(\.\d*[1-9])?(e[+-]\d+)?[ \n]){12})";
// The profile and the name of the program that wrote the file.
constexpr char kMcapBeginning[] = R"([^M]MCAP0\r\n[\s\S]{13}ros2[\s\S]{4}msc_vo )";

bool NeedsImages(const std::string& format) { return format == "nerfstudio" || format == "ply"; }

std::string Absolute(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

std::string FormatNerfstudioOf(const RunExport& arguments) {
  const RgbdDecoder decoder = OpenExportedSequence(arguments);
  RequireImageFiles(decoder);
  const Calibration& calibration = decoder.calibration();
  std::vector<NerfstudioFrame> frames;
  for (const PosedImage& image :
       FindPosedImages(TrajectoryPath(arguments.run), arguments.poses, decoder)) {
    const SequenceEntry& entry = decoder.index().entries[static_cast<size_t>(image.index)];
    frames.push_back({Absolute(entry.color_path),
                      calibration.depth_camera ? "" : Absolute(entry.depth_path),
                      image.pose.world_from_cam});
  }
  return FormatNerfstudio(ExportCamera({calibration.camera, calibration.distortion}), frames);
}

// Lines of KITTI are the numbers of frames, for other programs.
void WarnOfMissingLines(const std::string& path, size_t num_lines) {
  const size_t num_frames = ReadTrajectory(path).size();
  if (num_lines == num_frames) return;
  PrintWarning(
      FormatText("%s: %zu of %zu poses are exported, so that lines are not the numbers of "
                 "frames; msc_vo export --all-poses takes predicted ones, too",
                 path.c_str(), num_lines, num_frames));
}

std::string FormatTrajectoryOf(const RunExport& arguments) {
  const std::string path = TrajectoryPath(arguments.run);
  if (arguments.format == "tum") {
    return std::string(kTumMark) + "\n" + FormatTrajectory(ReadPoses(path, arguments.poses));
  }
  const std::vector<TimedPose> poses = ReadPosesOfOneWorld(path, arguments.poses);
  if (arguments.format == "euroc") return FormatEuroc(poses);
  WarnOfMissingLines(path, poses.size());
  return FormatKitti(poses);
}

void RequireResults(const std::string& run, const std::string& format) {
  if (IsFolder(run)) return;
  throw std::runtime_error(run + ": " + format +
                           " needs the folder of the results of a run, not a trajectory alone");
}

// Names the images of the frames.
void AddImages(const RunExport& arguments, const std::vector<TimedPose>& poses, McapRun* run) {
  const RgbdDecoder decoder = OpenExportedSequence(arguments);
  RequireImageFiles(decoder);
  run->camera = {decoder.calibration().camera, decoder.calibration().distortion};
  std::map<int64_t, std::string> images;
  for (const SequenceEntry& entry : decoder.index().entries) {
    images[Microseconds(entry.timestamp)] = entry.color_path;
  }
  for (size_t i = 0; i < poses.size(); ++i) {
    const auto image = images.find(Microseconds(poses[i].timestamp));
    if (image != images.end()) run->frames[i].image = image->second;
  }
}

// Draws the features of the keyframes, if there is a map of the run. Counts the images that cannot
// be read, whose features are left out.
void AddFeatures(const RunExport& arguments, int* num_unreadable, McapRun* run) {
  if (arguments.map.empty()) return;
  RgbdDecoder images = OpenExportedSequence(arguments);
  const auto identity = ReadIdentity(arguments.run);  // the sequence may have moved since
  const SessionQuery session = {
      arguments.map, identity ? identity->path : images.index().directory, arguments.session, true,
      "give the map that the run was saved to (replay --map), or name one of its sessions with "
      "--session"};
  std::shared_ptr<const ExportedFeatures> features;
  try {
    features = std::make_shared<const ExportedFeatures>(session, std::move(images));
  } catch (const std::runtime_error& error) {
    if (arguments.requires_features) throw;
    PrintWarning(arguments.output + ": images with features are left out: " + error.what());
    return;
  }
  std::vector<int64_t> times;
  for (const McapFrame& frame : run->frames) times.push_back(frame.nanoseconds / 1000);
  run->draw_features = [features, times, num_unreadable](size_t i) -> std::string {
    try {
      return features->Draw(times[i]);
    } catch (const UnreadableImage&) {
      ++*num_unreadable;
      return "";
    }
  };
}

// Points, lines and planes, if they are in the world of the poses.
void AddMap(const std::string& folder, int world, McapRun* run) {
  const RecordedRun recorded = ReadRecordedRun(folder);
  if (recorded.map_world && *recorded.map_world != world) {
    PrintWarning(
        FormatText("%s: its map is in the world of segment %d, and the poses are in that "
                   "of segment %d; points, lines and planes are left out",
                   folder.c_str(), *recorded.map_world, world));
    return;
  }
  run->points = ReadPointsPly(PathIn(folder, "map.ply"));
  run->lines = ReadColoredEdgesPly(PathIn(folder, "lines.ply"));
  const std::string planes = PathIn(folder, "planes.ply");
  if (std::filesystem::exists(planes)) run->planes = ReadColoredPolygonsPly(planes);
}

// The covariance of a pose in the frame of its camera.
std::optional<PoseCovariance> InCameraFrame(const Rigid3& world_from_cam,
                                            const std::optional<PoseCovariance>& covariance) {
  if (!covariance) return std::nullopt;
  return CameraCovariance(world_from_cam.Inverse(), *covariance);
}

void WriteMcap(const RunExport& arguments) {
  RequireMcapExport();
  RequireResults(arguments.run, arguments.format);
  const std::string trajectory = TrajectoryPath(arguments.run);
  const std::vector<TimedPose> poses = ReadPosesOfOneWorld(trajectory, arguments.poses);
  const std::string frames_csv = PathIn(arguments.run, "frames.csv");
  const std::map<int64_t, RecordedFrame> recorded = ReadFramesCsv(frames_csv);
  McapRun run;
  for (const TimedPose& pose : poses) {
    const auto found = recorded.find(Microseconds(pose.timestamp));
    if (found == recorded.end()) {
      throw std::runtime_error(
          FormatText("%s: has no row of the pose at %.6f s of %s; are both of one run?",
                     frames_csv.c_str(), pose.timestamp, trajectory.c_str()));
    }
    McapFrame frame;
    frame.nanoseconds = 1000 * found->first;
    frame.world_from_cam = pose.world_from_cam;
    frame.odom_from_cam = found->second.odom_from_cam;
    frame.world_covariance = InCameraFrame(frame.world_from_cam, found->second.world_covariance);
    frame.odom_covariance = InCameraFrame(frame.odom_from_cam, found->second.odometry_covariance);
    run.frames.push_back(std::move(frame));
  }
  AddMap(arguments.run, poses.front().world, &run);
  if (arguments.images) AddImages(arguments, poses, &run);
  int num_unreadable = 0;
  AddFeatures(arguments, &num_unreadable, &run);
  ExportMcap(run, arguments.output);
  if (num_unreadable == 0) return;
  PrintWarning(
      FormatText("%s: %d images of keyframes cannot be read; they are left out of "
                 "/msc_vo/features/compressed",
                 arguments.output.c_str(), num_unreadable));
}

void WritePly(const RunExport& arguments) {
  const RgbdDecoder decoder = OpenExportedSequence(arguments);
  const std::vector<PosedImage> images =
      FindPosedImages(TrajectoryPath(arguments.run), arguments.poses, decoder);
  SurfaceFusionOptions options = arguments.fusion;
  options.camera = decoder.calibration().camera;
  const std::unique_ptr<SurfaceFusion> fusion = LoadSurfaceFusion(options);
  if (FuseImages(decoder, images, true, fusion.get()).is_interrupted) {
    throw Interrupted("interrupted; " + arguments.output + " is not written");
  }
  WriteFile(arguments.output, FormatMeshPly(ExtractSurface(*fusion, options, false)));
}

}  // namespace

const std::vector<std::string>& ExportFormats() {
  static const auto* const kFormats = new std::vector<std::string>{
      "colmap", "euroc", "g2o", "kitti", "mcap", "nerfstudio", "ply", "tum"};
  return *kFormats;
}

bool IsMapFormat(const std::string& format) { return format == "colmap" || format == "g2o"; }

OutputKind KindOfExport(const std::string& format) {
  if (format == "nerfstudio") return {kNerfstudioMark};
  if (format == "tum") return {kTumMark};
  if (format == "g2o") return {kG2oMark};
  if (format == "ply") return {kSurfaceMark};
  if (format == "euroc") return {"", kEurocBeginning};
  if (format == "kitti") return {"", kKittiBeginning};
  if (format == "mcap") return {"", kMcapBeginning};
  return {};
}

void CheckExport(const RunExport& arguments, const RgbdDecoder& sequence) {
  if (NeedsImages(arguments.format) && sequence.index().camera) {
    throw std::runtime_error(
        "the images of a live camera are gone after the run; record them with msc_vo record");
  }
  if (arguments.format == "nerfstudio") {
    RequireImageFiles(sequence);
    const Calibration& calibration = sequence.calibration();
    FormatNerfstudio(ExportCamera({calibration.camera, calibration.distortion}), {});
  }
  if (arguments.format == "mcap") RequireMcapExport();
  if (arguments.format == "ply") {
    SurfaceFusionOptions options = arguments.fusion;
    options.camera = sequence.calibration().camera;
    LoadSurfaceFusion(options);
  }
}

void WriteExport(const RunExport& arguments) {
  if (IsMapFormat(arguments.format)) return WriteMapExport(arguments);
  RefuseMapFile(arguments.run,
                arguments.format +
                    " is made of the results of a run: give their folder; of a map, "
                    "msc_vo map export writes keyframes (TUM), points and lines (PLY)");
  std::vector<std::string> inputs = {TrajectoryPath(arguments.run)};
  for (const char* name :
       {"frames.csv", "lines.ply", "map.ply", "planes.ply", "sequence.json", "summary.json"}) {
    inputs.push_back(PathIn(arguments.run, name));
  }
  if (!arguments.map.empty()) inputs.push_back(arguments.map);
  if (const auto identity = ReadIdentity(arguments.run)) {
    inputs.push_back(identity->path);
    if (!NeedsImages(arguments.format)) {  // which is checked with the images
      RefuseToReplace(arguments.output, KindOfExport(arguments.format), {identity->path},
                      arguments.overwrite);
    }
  }
  RefuseToOverwrite(inputs, arguments.output);
  RefuseToReplace(arguments.output, KindOfExport(arguments.format), {}, arguments.overwrite);
  if (arguments.format == "mcap") return WriteMcap(arguments);
  if (arguments.format == "ply") return WritePly(arguments);
  WriteFile(arguments.output, arguments.format == "nerfstudio" ? FormatNerfstudioOf(arguments)
                                                               : FormatTrajectoryOf(arguments));
}

}  // namespace msc_vo
