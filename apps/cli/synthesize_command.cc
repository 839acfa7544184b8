// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/progress.h"
#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// Raw units per metre of TUM's depth images: 0.2 mm steps, 13 m at most.
constexpr double kDepthFactor = 5000.0;
// A line of camera.txt that identifies folders written by this command.
constexpr char kMark[] = "written by msc_vo synthesize";

struct Arguments {
  std::string folder;
  std::string scene = "room";
  std::string noise = "none";
  std::string sensor;  // empty: that of `noise`
  int frames = 260;
  int height = 0;  // pixels; 0: three quarters of the width
  bool jpeg = false;
  int jpeg_quality = 95;
  bool overwrite = false;
  bool json = false;
  std::vector<double> rig;  // focal length, x, y, roll; empty: registered depth
  bool untold = false;      // the rig is not in camera.txt
  SyntheticSequenceOptions options;
};

bool IsOurs(const fs::path& folder) {
  const std::string camera = (folder / "camera.txt").string();
  return FileProblem(camera).empty() && ReadFile(camera).find(kMark) != std::string::npos;
}

// Creates OUT_DIR with empty rgb/ and depth/. Other files in an existing folder are kept.
void PrepareFolder(const fs::path& folder, bool overwrite) {
  const std::string name = folder.string();
  if (HasEntry(name) && !ListFolder(name).empty() && !IsOurs(folder) && !overwrite) {
    throw std::runtime_error(name +
                             " is not empty and was not written by msc_vo synthesize: give another "
                             "folder, or use --overwrite");
  }
  for (const char* images : {"rgb", "depth"}) {
    fs::remove_all(folder / images);
    MakeFolder((folder / images).string());
  }
}

void WriteImage(const fs::path& path, const cv::Mat& image, const std::vector<int>& parameters) {
  std::vector<uchar> bytes;
  cv::imencode(path.extension().string(), image, bytes, parameters);
  WriteFile(path.string(), std::string(bytes.begin(), bytes.end()));
}

void WriteColor(const fs::path& path, int jpeg_quality, RenderedImage* image) {
  const cv::Mat rgb(image->height, image->width, CV_8UC3, image->rgb.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  // PNG level 1, because image noise does not compress.
  WriteImage(path, bgr, {cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
}

void WriteDepth(const fs::path& path, RenderedImage* image) {
  const cv::Mat depth(image->height, image->width, CV_32FC1, image->depth.data());
  cv::Mat raw;
  depth.convertTo(raw, CV_16U, kDepthFactor);  // rounds, and saturates at 13.1 m
  // Quantised depth compresses: level 6 saves a fifth of level 1.
  WriteImage(path, raw, {cv::IMWRITE_PNG_COMPRESSION, 6});
}

// The rig that --rig describes; none without.
std::optional<DepthRig> MakeRig(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  const Eigen::AngleAxisd roll(DegreesToRadians(numbers[3]), Eigen::Vector3d::UnitZ());
  return DepthRig{numbers[0],
                  {Eigen::Quaterniond(roll), Eigen::Vector3d(numbers[1], numbers[2], 0.0)}};
}

// What camera.txt tells of the cameras.
Calibration ToldCalibration(const Arguments& arguments, const SyntheticSequence& sequence,
                            const std::optional<DepthRig>& rig) {
  Calibration calibration;
  calibration.camera = sequence.camera();
  calibration.depth_scale = kDepthFactor;
  if (rig && !arguments.untold) {
    calibration.depth_camera = DepthCamera{sequence.depth_camera(), rig->depth_from_color};
  }
  return calibration;
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

void PrintJson(const Arguments& arguments, const PinholeCamera& camera, int num_frames) {
  const nlohmann::ordered_json json = {{"directory", arguments.folder},
                                       {"scene", arguments.scene},
                                       {"seed", arguments.options.seed},
                                       {"frames", num_frames},
                                       {"complete", num_frames == arguments.frames},
                                       {"camera",
                                        {{"fx", camera.fx},
                                         {"fy", camera.fy},
                                         {"cx", camera.cx},
                                         {"cy", camera.cy},
                                         {"width", camera.width},
                                         {"height", camera.height},
                                         {"depth_scale", kDepthFactor}}}};
  std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

SyntheticDepth DepthOf(const Arguments& arguments) {
  const std::string& name = arguments.sensor.empty() ? arguments.noise : arguments.sensor;
  if (name == "kinect") return SyntheticDepth::kKinect;
  if (name == "tof") return SyntheticDepth::kTimeOfFlight;
  if (name == "stereo") return SyntheticDepth::kStereo;
  return name == "lidar" ? SyntheticDepth::kLidar : SyntheticDepth::kExact;
}

int Run(const Arguments& arguments) {
  SyntheticSequenceOptions options = arguments.options;
  options.scene = *SceneKindFromName(arguments.scene);
  options.height = arguments.height > 0 ? arguments.height : options.width * 3 / 4;
  options.depth = DepthOf(arguments);
  options.depth_rig = MakeRig(arguments.rig);
  const SyntheticSequence sequence(options);

  const fs::path folder = arguments.folder;
  PrepareFolder(folder, arguments.overwrite);
  WriteFile((folder / "camera.txt").string(),
            FormatCameraFile(ToldCalibration(arguments, sequence, options.depth_rig), kMark));
  std::vector<LineSegment3> edges = sequence.scene().edges;
  const std::vector<LineSegment3> painted = sequence.scene().PaintedEdges();
  edges.insert(edges.end(), painted.begin(), painted.end());
  WriteAccelerometer(folder, sequence.AccelerometerReadings(arguments.frames));
  WriteFile((folder / "edges.ply").string(), FormatEdgesPly(edges));
  GrowingFile rgb_list((folder / "rgb.txt").string());
  GrowingFile depth_list((folder / "depth.txt").string());
  GrowingFile associations((folder / "associations.txt").string());
  GrowingFile truth((folder / "groundtruth.txt").string());
  for (GrowingFile* list : {&rgb_list, &depth_list}) list->Append("# timestamp filename\n");
  truth.Append("# timestamp tx ty tz qx qy qz qw (camera in world)\n");
  const InterruptGuard guard;
  Progress progress(arguments.frames);
  int num_done = 0;
  for (int i = 0; i < arguments.frames && !guard.IsInterrupted(); ++i) {
    SyntheticFrame frame = sequence.Render(i);
    const std::string stamp = FormatText("%.6f", frame.pose.timestamp);
    const std::string rgb = "rgb/" + stamp + (arguments.jpeg ? ".jpg" : ".png");
    const std::string depth_stamp = FormatText("%.6f", frame.pose.timestamp + options.depth_delay);
    const std::string depth = "depth/" + depth_stamp + ".png";
    WriteColor(folder / rgb, arguments.jpeg_quality, &frame.image);
    WriteDepth(folder / depth, &frame.image);
    rgb_list.Append(stamp + " " + rgb + "\n");
    depth_list.Append(depth_stamp + " " + depth + "\n");
    associations.Append(stamp + " " + rgb + " " + depth_stamp + " " + depth + "\n");
    truth.Append(PoseLine(stamp, frame.pose.world_from_cam));
    progress.Update(++num_done, "");
  }
  progress.Finish();
  if (arguments.json) PrintJson(arguments, sequence.camera(), num_done);
  return guard.IsInterrupted() ? kExitInterrupted : kExitSuccess;
}

void AddNoiseArguments(CLI::App* command, Arguments* arguments) {
  CLI::Option* noise =
      command->add_option("--noise", arguments->noise, "Depth noise: none or that of a Kinect")
          ->check(CLI::IsMember({"none", "kinect"}))
          ->capture_default_str();
  command
      ->add_option("--sensor", arguments->sensor,
                   "Depth sensor with its noise and artefacts; default: exact depth")
      ->check(CLI::IsMember({"kinect", "tof", "stereo", "lidar"}))
      ->excludes(noise);
}

void AddRigArguments(CLI::App* command, Arguments* arguments) {
  CLI::Option* rig =
      command
          ->add_option("--rig", arguments->rig,
                       "FX,TX,TY,ROLL: a second camera records depth, which is not registered: "
                       "focal length in pixels, translation of depth_from_color in metres, roll in "
                       "degrees")
          ->delimiter(',')
          ->expected(4);
  command->add_flag("--untold", arguments->untold, "Leave the depth camera out of camera.txt")
      ->needs(rig);
}

}  // namespace

Command AddSynthesizeCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand("synthesize",
                                          "Render an RGB-D sequence in TUM layout with "
                                          "groundtruth.txt, accelerometer.txt and edges.ply, the "
                                          "true edges");
  command->add_option("out_dir", arguments->folder, "Folder to write")->required();
  command->add_option("--scene", arguments->scene, "Scene to render")
      ->check(CLI::IsMember({"room", "corridor", "bare", "slanted", "house"}))
      ->capture_default_str();
  command->add_option("--frames", arguments->frames, "Number of frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--seed", arguments->options.seed,
                   "Seed of the scene, the trajectory and the noise")
      ->capture_default_str();
  AddNoiseArguments(command, arguments.get());
  command
      ->add_option("--width", arguments->options.width,
                   "Image width, pixels; the focal length is proportional")
      ->capture_default_str();
  command->add_option("--height", arguments->height,
                      "Image height, pixels; default: 3/4 of the width");
  command->add_option("--fps", arguments->options.fps, "Frames per second")->capture_default_str();
  command
      ->add_option("--depth-delay", arguments->options.depth_delay,
                   "Delay of depth images relative to colour images, seconds")
      ->capture_default_str();
  command
      ->add_option(
          "--readout-time", arguments->options.readout_time,
          "Readout time of a rolling shutter, seconds (Kinect: 0.026); time stamps refer to "
          "the middle row")
      ->capture_default_str();
  command
      ->add_option("--speed", arguments->options.path.speed, "Speed of the camera, metres/second")
      ->capture_default_str();
  command
      ->add_option("--image-sigma", arguments->options.image_sigma,
                   "Noise of colour images, standard deviation in grey levels")
      ->capture_default_str();
  AddRigArguments(command, arguments.get());
  CLI::Option* jpeg = command->add_flag("--jpeg", arguments->jpeg, "Write colour images as JPEG");
  command->add_option("--jpeg-quality", arguments->jpeg_quality, "JPEG quality, 1 to 100")
      ->check(CLI::Range(1, 100))
      ->needs(jpeg)
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print what was written as JSON");
  command->add_flag(
      "--overwrite", arguments->overwrite,
      "Write into a folder that synthesize did not create; replaces its rgb/ and depth/");
  command->footer(HelpFooter("msc_vo synthesize room --scene room --frames 260 --noise kinect"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
