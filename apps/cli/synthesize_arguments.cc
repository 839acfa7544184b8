// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/synthesize_arguments.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "apps/cli/argument_checks.h"
#include "apps/cli/commands.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

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

// Checks the name of a depth sensor.
CLI::Validator SensorName() {
  const std::string names = Joined(SyntheticDepthNames(), ",");
  return CLI::Validator(
      [names](const std::string& text) {
        return SyntheticDepthFromName(text)
                   ? std::string()
                   : "'" + text + "' is not a depth sensor; known: " + names;
      },
      "{" + names + "}");
}

SpecularOptions SpecularSurfaces(const SynthesizeArguments& arguments) {
  const auto has = [&](const char* name) {
    const auto& names = arguments.specular;
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return {has("mirror"), has("glass"), has("floor"), has("screen")};
}

// An error of SyntheticSequenceOptions with the names of the arguments.
std::string NameArguments(std::string error) {
  for (const auto& [option, argument] :
       {std::pair("depth_delay", "--depth-delay"), std::pair("readout_time", "--readout-time"),
        std::pair("focal_length", "--focal-length"), std::pair("depth_rig", "--rig")}) {
    const size_t begin = error.find(option);
    if (begin != std::string::npos) error.replace(begin, std::string(option).size(), argument);
  }
  return error;
}

// Noise, artefacts and timing of the images.
void AddSensorArguments(CLI::App* command, SynthesizeArguments* arguments) {
  command
      ->add_option("--depth-sensor,--sensor,--noise", arguments->depth_sensor,
                   "Depth sensor with its noise and artefacts; none is exact, kinect is "
                   "structured-light")
      ->check(SensorName())
      ->capture_default_str();
  command
      ->add_option("--depth-offset", arguments->depth_offset,
                   "X,Y: displacement of the depth image of the sensor icl-nuim, pixels of a "
                   "sensor with a focal length of 525 px")
      ->delimiter(',')
      ->expected(2)
      ->check(NumberFrom(-100.0, 100.0));
  command
      ->add_option("--depth-bias", arguments->depth_bias,
                   "Amplitude of the smooth error of depth of time of flight, metres; default: "
                   "0.005")
      ->check(NumberFrom(0.0, 0.5));
  command
      ->add_option("--depth-factor", arguments->options.depth_factor,
                   "Recorded depth divided by true depth; camera.txt does not tell it")
      ->check(NumberFrom(0.1, 10.0))
      ->capture_default_str();
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
}

// Imperfections of the colour images.
void AddImageArguments(CLI::App* command, SynthesizeArguments* arguments) {
  command
      ->add_option("--image-sigma", arguments->options.image_sigma,
                   "Noise of colour images, standard deviation in grey levels")
      ->check(NumberFrom(0.0, 255.0))
      ->capture_default_str();
  command
      ->add_option("--light", arguments->light,
                   "Fraction of the light of a well-lit room, 0.001 to 1: photon noise, and gain "
                   "that makes the images as bright as without; default: no photon noise")
      ->check(NumberFrom(0.001, 1.0));
  command->add_flag("--hunting-exposure", arguments->options.hunting_exposure,
                    "Automatic exposure that hunts by 60 % within two seconds, and vignetting");
  command
      ->add_option("--motion-blur", arguments->options.motion_blur,
                   "Exposure time of colour images as a fraction of the time between two images")
      ->check(NumberFrom(0.0, 1.0))
      ->capture_default_str();
}

void AddCameraArguments(CLI::App* command, SynthesizeArguments* arguments) {
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
          ->expected(4)
          ->check(NumberFrom(-1e6, 1e6));
  command
      ->add_flag("--untold", arguments->untold,
                 "Leave the lens and the depth camera out of camera.txt")
      ->check([lens, rig](const std::string&) {
        return lens->count() + rig->count() > 0 ? std::string()
                                                : std::string("needs --lens or --rig");
      });
}

// What camera.txt gives wrongly.
void AddCalibrationErrors(CLI::App* command, SynthesizeArguments* arguments) {
  command
      ->add_option("--focal-length-error", arguments->focal_length_error,
                   "Error of the focal length of the colour camera in camera.txt, per cent")
      ->check(NumberFrom(-90.0, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--principal-point-error", arguments->principal_point_error,
                   "X,Y: error of the principal point of the colour camera in camera.txt, pixels")
      ->delimiter(',')
      ->expected(2)
      ->check(NumberFrom(-10000.0, 10000.0));
}

// Size, path and rate of the images.
void AddSequenceArguments(CLI::App* command, SynthesizeArguments* arguments) {
  command->add_option("out_dir", arguments->folder, "Folder to write")->required();
  command->add_option("--scene", arguments->scene, "Scene to render")
      ->check(CLI::IsMember(SceneKindNames()))
      ->capture_default_str();
  command
      ->add_option("--specular", arguments->specular,
                   "Surfaces of the room whose images show something that is not at their depth: "
                   "mirror, glass, floor (polished), screen; a list")
      ->delimiter(',')
      ->check(CLI::IsMember({"mirror", "glass", "floor", "screen"}));
  command
      ->add_option("--frames", arguments->frames,
                   "Number of frames; default: 260, or until the end of a walk that is no loop")
      ->transform(WholeNumberFrom(1, 1000000));
  command
      ->add_option("--seed", arguments->options.seed,
                   "Seed of the scene, the trajectory and the noise")
      ->transform(WholeNumberFrom(0, 1e15))
      ->capture_default_str();
  command
      ->add_option(
          "--path", arguments->options.walk.path,
          "Number of the path through the scene of this seed, 1 for the first: other paths "
          "have other noise, too")
      ->transform(WholeNumberFrom(1, 1000000))
      ->capture_default_str();
  command->add_flag("--returns", arguments->options.walk.returns,
                    "Come back to a place at the end of the path; needs a scene with places that "
                    "look alike: rooms, mirrored, floors, desks");
  command
      ->add_option("--width", arguments->options.width,
                   "Image width, pixels; the focal length is proportional")
      ->transform(WholeNumberFrom(32, 8192))
      ->capture_default_str();
  command
      ->add_option("--height", arguments->height, "Image height, pixels; default: 3/4 of the width")
      ->transform(WholeNumberFrom(32, 8192));
  command->add_option("--fps", arguments->options.fps, "Frames per second")
      ->check(NumberFrom(0.01, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--stride", arguments->stride,
                   "Write every STRIDE-th image of the path only, as a slower camera would")
      ->transform(WholeNumberFrom(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--speed", arguments->options.path.speed, "Speed of the camera, metres/second")
      ->check(NumberFrom(0.001, 100.0))
      ->capture_default_str();
  command
      ->add_option("--turn-rate", arguments->turn_rate,
                   "Turn rate of the camera, degrees/second; default: 26")
      ->check(NumberFrom(0.1, 10000.0));
}

// What is written, and how.
void AddOutputArguments(CLI::App* command, SynthesizeArguments* arguments) {
  CLI::Option* jpeg =
      command->add_flag("--jpeg", arguments->encoding.jpeg, "Write colour images as JPEG");
  command->add_option("--jpeg-quality", arguments->encoding.jpeg_quality, "JPEG quality, 1 to 100")
      ->transform(WholeNumberFrom(1, 100))
      ->needs(jpeg)
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print what was written as JSON");
  command->add_flag(
      "--overwrite", arguments->overwrite,
      "Write into a folder that holds other files or a sequence of other options; of the images "
      "there, only those of an earlier synthesize are removed");
}

}  // namespace

void AddSynthesizeArguments(CLI::App* command, SynthesizeArguments* arguments) {
  AddSequenceArguments(command, arguments);
  AddSensorArguments(command, arguments);
  AddImageArguments(command, arguments);
  AddCameraArguments(command, arguments);
  AddCalibrationErrors(command, arguments);
  AddOutputArguments(command, arguments);
}

SyntheticSequenceOptions SequenceOptions(const SynthesizeArguments& arguments) {
  SyntheticSequenceOptions options = arguments.options;
  options.scene = *SceneKindFromName(arguments.scene);
  options.fps /= arguments.stride;
  options.height = arguments.height > 0 ? arguments.height : options.width * 3 / 4;
  options.depth = *SyntheticDepthFromName(arguments.depth_sensor);
  if (arguments.depth_bias >= 0.0) {
    if (options.depth != SyntheticDepth::kTimeOfFlight) {
      throw UsageError("--depth-bias is an error of time of flight: give --depth-sensor tof");
    }
    options.time_of_flight.bias = arguments.depth_bias;
  }
  if (!arguments.depth_offset.empty()) {
    if (options.depth != SyntheticDepth::kIclNuim) {
      throw UsageError(
          "--depth-offset displaces the depth of ICL-NUIM's noise: give --depth-sensor icl-nuim");
    }
    options.icl_nuim.lateral_offset = {arguments.depth_offset[0], arguments.depth_offset[1]};
  }
  options.specular = SpecularSurfaces(arguments);
  if (options.specular.Any() && options.scene != SceneKind::kRoom) {
    throw UsageError("--specular needs the scene room: give --scene room");
  }
  if (arguments.light > 0.0) options.light = arguments.light;
  options.depth_rig = MakeRig(arguments.rig);
  options.lens = ParseLens(arguments.lens);
  if (arguments.turn_rate > 0.0) options.path.turn_rate = DegreesToRadians(arguments.turn_rate);
  if (options.walk.returns && !SupportsReturns(options.scene)) {
    throw UsageError(
        "--returns needs a scene with places that look alike: give --scene "
        "rooms, mirrored, floors or desks");
  }
  std::string error;
  if (!options.IsValid(&error)) throw UsageError(NameArguments(error));
  return options;
}

}  // namespace msc_vo
