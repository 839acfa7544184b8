// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/number_range.h"
#include "apps/cli/progress.h"
#include "apps/cli/rendered_frames.h"
#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// A line of camera.txt that identifies folders written by this command.
constexpr char kMark[] = "written by msc_vo synthesize";

struct Arguments {
  std::string folder;
  std::string scene = "room";
  std::string noise = "none";
  std::string sensor;  // empty: that of `noise`
  int frames = 260;
  int stride = 1;
  int height = 0;  // pixels; 0: three quarters of the width
  ColorEncoding encoding;
  bool overwrite = false;
  bool json = false;
  std::vector<double> rig;  // focal length, x, y, roll; empty: registered depth
  std::string lens;         // MODEL:COEFFICIENTS; empty: none
  bool untold = false;      // rig and lens are not in camera.txt
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

// The rig that --rig describes; none without.
std::optional<DepthRig> MakeRig(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  const Eigen::AngleAxisd roll(DegreesToRadians(numbers[3]), Eigen::Vector3d::UnitZ());
  return DepthRig{numbers[0],
                  {Eigen::Quaterniond(roll), Eigen::Vector3d(numbers[1], numbers[2], 0.0)}};
}

// The lens that --lens describes; none without. Throws std::invalid_argument.
LensDistortion ParseLens(const std::string& text) {
  LensDistortion lens;
  if (text.empty()) return lens;
  const size_t colon = std::min(text.find(':'), text.size());
  const std::optional<LensModel> model = LensModelFromName(text.substr(0, colon));
  if (!model) {
    throw std::invalid_argument("unknown model '" + text.substr(0, colon) +
                                "'; known: " + LensModelNames());
  }
  lens.model = *model;
  const size_t expected = LensCoefficientNames(*model).size();
  std::istringstream numbers(text.substr(std::min(colon + 1, text.size())));
  std::string number;
  size_t count = 0;
  for (; std::getline(numbers, number, ','); ++count) {
    const std::optional<double> k = ParseNumber(number);
    if (!k) throw std::invalid_argument("'" + number + "' is not a number");
    if (count < expected) lens.k[count] = *k;
  }
  if (count != expected) {
    throw std::invalid_argument("expected the coefficients " + LensCoefficientList(*model) +
                                " of the model " + LensModelName(*model) + ", found " +
                                std::to_string(count) + " numbers");
  }
  return lens;
}

// What camera.txt tells of the cameras.
Calibration ToldCalibration(const Arguments& arguments, const SyntheticSequence& sequence,
                            const LensDistortion& lens, const std::optional<DepthRig>& rig) {
  Calibration calibration;
  calibration.camera = sequence.camera();
  calibration.depth_scale = kRenderedDepthScale;
  if (arguments.untold) return calibration;
  calibration.distortion = lens;
  calibration.SetUndistorted();
  if (rig) {
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
                                         {"depth_scale", kRenderedDepthScale}}}};
  std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

SyntheticDepth DepthOf(const Arguments& arguments) {
  const std::string& name = arguments.sensor.empty() ? arguments.noise : arguments.sensor;
  if (name == "kinect") return SyntheticDepth::kStructuredLight;
  if (name == "tof") return SyntheticDepth::kTimeOfFlight;
  if (name == "stereo") return SyntheticDepth::kStereo;
  return name == "lidar" ? SyntheticDepth::kLidar : SyntheticDepth::kExact;
}

int Run(const Arguments& arguments) {
  SyntheticSequenceOptions options = arguments.options;
  options.scene = *SceneKindFromName(arguments.scene);
  options.fps /= arguments.stride;
  options.height = arguments.height > 0 ? arguments.height : options.width * 3 / 4;
  options.depth = DepthOf(arguments);
  options.depth_rig = MakeRig(arguments.rig);
  options.lens = ParseLens(arguments.lens);
  const SyntheticSequence sequence(options);

  const fs::path folder = arguments.folder;
  PrepareFolder(folder, arguments.overwrite);
  WriteFile((folder / "camera.txt").string(),
            FormatCameraFile(ToldCalibration(arguments, sequence, options.lens, options.depth_rig),
                             kMark));
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
  RenderedFrames frames(sequence, arguments.encoding, arguments.frames);
  int num_done = 0;
  for (int i = 0; i < arguments.frames && !guard.IsInterrupted(); ++i) {
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
  if (arguments.json) PrintJson(arguments, sequence.camera(), num_done);
  return guard.IsInterrupted() ? kExitInterrupted : kExitSuccess;
}

// Noise, artefacts and timing of the images.
void AddSensorArguments(CLI::App* command, Arguments* arguments) {
  CLI::Option* noise =
      command->add_option("--noise", arguments->noise, "Depth noise: none or that of a Kinect")
          ->check(CLI::IsMember({"none", "kinect"}))
          ->capture_default_str();
  command
      ->add_option("--sensor", arguments->sensor,
                   "Depth sensor with its noise and artefacts; default: exact depth")
      ->check(CLI::IsMember({"kinect", "tof", "stereo", "lidar"}))
      ->excludes(noise);
  command
      ->add_option("--depth-delay", arguments->options.depth_delay,
                   "Delay of depth images relative to colour images, seconds")
      ->check(NumberFrom(-1.0, 1.0))
      ->capture_default_str();
  command
      ->add_option(
          "--readout-time", arguments->options.readout_time,
          "Readout time of a rolling shutter, seconds (Kinect: 0.026); time stamps refer to "
          "the middle row")
      ->check(NumberFrom(-1.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--image-sigma", arguments->options.image_sigma,
                   "Noise of colour images, standard deviation in grey levels")
      ->check(NumberFrom(0.0, 255.0))
      ->capture_default_str();
}

void AddCameraArguments(CLI::App* command, Arguments* arguments) {
  command
      ->add_option("--focal-length", arguments->options.focal_length,
                   "Focal length of the colour camera, pixels; default: 525/640 of the width")
      ->check(NumberFrom(1.0, 1e6));
  CLI::Option* lens =
      command
          ->add_option("--lens", arguments->lens,
                       "MODEL:K1,K2,...: lens of the colour camera, and of depth without --rig: "
                       "radial-tangential, rational or fisheye, with its coefficients in OpenCV's "
                       "order")
          ->check([](const std::string& text) {
            try {
              ParseLens(text);
            } catch (const std::invalid_argument& error) {
              return std::string(error.what());
            }
            return std::string();
          });
  CLI::Option* rig =
      command
          ->add_option("--rig", arguments->rig,
                       "FX,TX,TY,ROLL: a second camera records depth, which is not registered: "
                       "focal length in pixels, translation of depth_from_color in metres, roll in "
                       "degrees")
          ->delimiter(',')
          ->expected(4);
  command
      ->add_flag("--untold", arguments->untold,
                 "Leave the lens and the depth camera out of camera.txt")
      ->check([lens, rig](const std::string&) {
        return lens->count() + rig->count() > 0 ? std::string()
                                                : std::string("needs --lens or --rig");
      });
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
      ->check(CLI::IsMember({"room", "corridor", "bare", "slanted", "house", "box"}))
      ->capture_default_str();
  command->add_option("--frames", arguments->frames, "Number of frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--seed", arguments->options.seed,
                   "Seed of the scene, the trajectory and the noise")
      ->check(NumberFrom(0.0, 1e15))
      ->capture_default_str();
  command
      ->add_option("--width", arguments->options.width,
                   "Image width, pixels; the focal length is proportional")
      ->check(CLI::Range(32, 8192))
      ->capture_default_str();
  command
      ->add_option("--height", arguments->height, "Image height, pixels; default: 3/4 of the width")
      ->check(CLI::Range(32, 8192));
  command->add_option("--fps", arguments->options.fps, "Frames per second")
      ->check(NumberFrom(0.01, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--stride", arguments->stride,
                   "Write every STRIDE-th image of the path only, as a slower camera would")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--speed", arguments->options.path.speed, "Speed of the camera, metres/second")
      ->check(NumberFrom(0.001, 100.0))
      ->capture_default_str();
  AddSensorArguments(command, arguments.get());
  AddCameraArguments(command, arguments.get());
  CLI::Option* jpeg =
      command->add_flag("--jpeg", arguments->encoding.jpeg, "Write colour images as JPEG");
  command->add_option("--jpeg-quality", arguments->encoding.jpeg_quality, "JPEG quality, 1 to 100")
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
