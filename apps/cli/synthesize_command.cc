// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/progress.h"
#include "apps/cli/synthesize_arguments.h"
#include "apps/cli/synthesized_folder.h"
#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json IntrinsicsToJson(const PinholeCamera& camera) {
  return {{"fx", camera.fx}, {"fy", camera.fy},       {"cx", camera.cx},
          {"cy", camera.cy}, {"width", camera.width}, {"height", camera.height}};
}

Json DepthCameraToJson(const DepthCamera& depth_camera) {
  const Eigen::Vector3d t = depth_camera.depth_from_color.translation();
  const Eigen::Quaterniond q(depth_camera.depth_from_color.rotation());
  Json json = IntrinsicsToJson(depth_camera.camera);
  json["translation"] = {t.x(), t.y(), t.z()};
  json["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  return json;
}

// Calibration of the cameras that record a sequence of these options: intrinsics and lens of the
// recorded images, depth camera, depth scale (of true depth) and readout time.
Calibration TrueCalibration(const SyntheticSequenceOptions& options,
                            const SyntheticSequence& sequence) {
  Calibration calibration;
  calibration.camera = sequence.camera();
  calibration.distortion = options.lens;
  calibration.depth_scale = kRenderedDepthScale * options.depth_factor;
  calibration.readout_time = options.readout_time;
  if (options.depth_rig) {
    calibration.depth_camera =
        DepthCamera{sequence.depth_camera(), options.depth_rig->depth_from_color};
  }
  return calibration;
}

// What camera.txt says instead of `truth`. Throws UsageError if that is no camera.
Calibration GivenCalibration(const SynthesizeArguments& arguments, const Calibration& truth) {
  Calibration given = truth;
  given.depth_scale = kRenderedDepthScale;
  given.readout_time.reset();
  if (arguments.untold) {
    given.distortion = {};
    given.depth_camera.reset();
  }
  const double focal_length_ratio = 1.0 + arguments.focal_length_error / 100.0;
  given.camera.fx *= focal_length_ratio;
  given.camera.fy *= focal_length_ratio;
  if (!arguments.principal_point_error.empty()) {
    given.camera.cx += arguments.principal_point_error[0];
    given.camera.cy += arguments.principal_point_error[1];
  }
  given.SetUndistorted();
  std::string error;
  if (!given.IsValid(&error)) {
    throw UsageError("the errors of camera.txt are too large: " + error);
  }
  return given;
}

// Intrinsics and lens of the recorded images, and the rest of a calibration. `depth_camera` and
// `readout_time` are null if there is none.
Json CalibrationToJson(const Calibration& calibration) {
  Json json = IntrinsicsToJson(calibration.Recorded());
  json["lens"] = LensModelName(calibration.distortion.model);
  json["distortion"] = calibration.distortion.Coefficients();
  json["depth_scale"] = calibration.depth_scale;
  json["readout_time"] = calibration.readout_time ? Json(*calibration.readout_time) : Json();
  json["depth_camera"] =
      calibration.depth_camera ? DepthCameraToJson(*calibration.depth_camera) : Json();
  return json;
}

// Text of truth.json: the true calibration, what camera.txt says, the errors of the images, and the
// options of the command.
std::string FormatTruthJson(const SynthesizeArguments& arguments,
                            const SyntheticSequenceOptions& options, const Calibration& truth,
                            const Calibration& given) {
  const bool is_time_of_flight = options.depth == SyntheticDepth::kTimeOfFlight;
  const Eigen::Vector2d offset = options.depth == SyntheticDepth::kIclNuim
                                     ? options.icl_nuim.lateral_offset
                                     : Eigen::Vector2d::Zero();
  const Json json = {{"scene", arguments.scene},
                     {"seed", options.seed},
                     {"path", options.walk.path},
                     {"returns", options.walk.returns},
                     {"specular", arguments.specular},
                     {"camera", CalibrationToJson(truth)},
                     {"given", CalibrationToJson(given)},
                     {"depth_sensor", ToString(options.depth)},
                     {"depth_delay", options.depth_delay},
                     {"depth_bias", is_time_of_flight ? options.time_of_flight.bias : 0.0},
                     {"depth_offset", {offset.x(), offset.y()}},
                     {"image_sigma", options.image_sigma},
                     {"light", options.light ? Json(*options.light) : Json()},
                     {"hunting_exposure", options.hunting_exposure},
                     {"motion_blur", options.motion_blur},
                     {kSynthesizedOptions, arguments.values}};
  return json.dump(2) + "\n";
}

// The options that were given, and the defaults of the others, by name.
std::map<std::string, std::string> ValuesOf(const std::vector<CLI::Option*>& options) {
  std::map<std::string, std::string> values;
  for (const CLI::Option* option : options) {
    if (option->get_lnames().empty()) continue;
    const std::string& name = option->get_lnames().front();
    const std::string value =
        option->count() > 0 ? CLI::detail::join(option->results(), ",") : option->get_default_str();
    const bool changes_files = name != "help" && name != "json" && name != "overwrite";
    if (changes_files && !value.empty()) values[name] = value;
  }
  return values;
}

std::string PoseLine(const std::string& stamp, const Rigid3& world_from_cam) {
  const Eigen::Vector3d t = world_from_cam.translation();
  const Eigen::Quaterniond q(world_from_cam.rotation());
  return stamp + FormatText(" %.7f %.7f %.7f %.8f %.8f %.8f %.8f\n", t.x(), t.y(), t.z(), q.x(),
                            q.y(), q.z(), q.w());
}

void WriteAccelerometer(const fs::path& folder, const std::vector<TimedAcceleration>& readings) {
  std::string text = "# accelerometer data, axes of the camera\n# timestamp ax ay az\n";
  for (const TimedAcceleration& reading : readings) {
    const Eigen::Vector3d& a = reading.acceleration;
    text += FormatText("%.6f %.6f %.6f %.6f\n", reading.timestamp, a.x(), a.y(), a.z());
  }
  WriteFile((folder / "accelerometer.txt").string(), text);
}

void PrintJson(const SynthesizeArguments& arguments, const Calibration& truth, int num_done,
               int num_frames) {
  const Json json = {{"directory", arguments.folder},
                     {"scene", arguments.scene},
                     {"seed", arguments.options.seed},
                     {"path", arguments.options.walk.path},
                     {"frames", num_done},
                     {"complete", num_done == num_frames},
                     {"camera", CalibrationToJson(truth)}};
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
}

// Writes the true edges of the scene.
void WriteEdges(const fs::path& folder, const Scene& scene) {
  std::vector<LineSegment3> edges = scene.edges;
  const std::vector<LineSegment3> painted = scene.PaintedEdges();
  edges.insert(edges.end(), painted.begin(), painted.end());
  WriteFile((folder / "edges.ply").string(), FormatEdgesPly(edges));
}

int NumFrames(const SynthesizeArguments& arguments, const SyntheticSequence& sequence) {
  return arguments.frames > 0 ? arguments.frames : sequence.WalkLength().value_or(260);
}

int Run(const SynthesizeArguments& arguments) {
  const SyntheticSequenceOptions options = SequenceOptions(arguments);
  const SyntheticSequence sequence(options);
  const int num_frames = NumFrames(arguments, sequence);
  const Calibration true_calibration = TrueCalibration(options, sequence);
  const Calibration given = GivenCalibration(arguments, true_calibration);

  const fs::path folder = arguments.folder;
  PrepareSequenceFolder(folder, arguments.values, arguments.overwrite);
  WriteFile((folder / "camera.txt").string(), FormatCameraFile(given, kSynthesizedMark));
  WriteFile((folder / "truth.json").string(),
            FormatTruthJson(arguments, options, true_calibration, given));
  WriteAccelerometer(folder, sequence.AccelerometerReadings(num_frames));
  WriteEdges(folder, sequence.scene());
  GrowingFile rgb_list((folder / "rgb.txt").string());
  GrowingFile depth_list((folder / "depth.txt").string());
  GrowingFile associations((folder / "associations.txt").string());
  GrowingFile truth((folder / "groundtruth.txt").string());
  for (GrowingFile* list : {&rgb_list, &depth_list}) list->Append("# timestamp filename\n");
  truth.Append("# timestamp tx ty tz qx qy qz qw (camera in world)\n");
  const InterruptGuard guard;
  Progress progress(num_frames);
  RenderedFrames frames(sequence, arguments.encoding, num_frames);
  int num_done = 0;
  for (int i = 0; i < num_frames && !guard.IsInterrupted(); ++i) {
    const EncodedFrame frame = frames.Next();
    const std::string stamp = FormatText("%.6f", frame.pose.timestamp);
    const std::string rgb = "rgb/" + stamp + (arguments.encoding.jpeg ? ".jpg" : ".png");
    const std::string depth_stamp = FormatText("%.6f", frame.pose.timestamp + options.depth_delay);
    const std::string depth = "depth/" + depth_stamp + ".png";
    WriteFile((folder / rgb).string(), frame.color);
    WriteFile((folder / depth).string(), frame.depth);
    rgb_list.Append(stamp + " " + rgb + "\n");
    depth_list.Append(depth_stamp + " " + depth + "\n");
    associations.Append(stamp + " " + rgb + " " + depth_stamp + " " + depth + "\n");
    truth.Append(PoseLine(stamp, frame.pose.world_from_cam));
    progress.Update(++num_done, "");
  }
  progress.Finish();
  if (arguments.json) PrintJson(arguments, true_calibration, num_done, num_frames);
  if (!guard.IsInterrupted()) return kExitSuccess;
  PrintWarning(FormatText("interrupted; %s has %d of %d images", folder.string().c_str(), num_done,
                          num_frames));
  return kExitInterrupted;
}

}  // namespace

Command AddSynthesizeCommand(CLI::App* app) {
  const auto arguments = std::make_shared<SynthesizeArguments>();
  CLI::App* command = app->add_subcommand("synthesize",
                                          "Render an RGB-D sequence in TUM layout with "
                                          "groundtruth.txt, truth.json (the true camera), "
                                          "accelerometer.txt and edges.ply, the true edges");
  AddSynthesizeArguments(command, arguments.get());
  const std::vector<CLI::Option*> options = command->get_options();
  command->footer(HelpFooter("msc_vo synthesize room --scene room --frames 260 --noise kinect"));
  return {command, [arguments, options] {
            arguments->values = ValuesOf(options);
            return Run(*arguments);
          }};
}

}  // namespace msc_vo
