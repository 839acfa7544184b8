// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/sequence_calibration.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/intrinsics_file.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Overwrites the model and the coefficients that `settings` gives. `key`: the section of the
// configuration. Throws std::runtime_error if the model is unknown, or if a coefficient is missing
// or none of the model's.
void ApplyLens(const LensSettings& settings, const std::string& origin, const std::string& key,
               LensDistortion* lens) {
  const auto fail = [&](const std::string& name, const std::string& problem) {
    throw std::runtime_error(origin + ": " + key + "." + name + " " + problem);
  };
  bool needs_all = false;
  if (!settings.model.empty()) {
    const std::optional<LensModel> model = LensModelFromName(settings.model);
    if (!model) fail("lens", "'" + settings.model + "' is unknown; known: " + LensModelNames());
    needs_all = *model != lens->model;
    if (needs_all) *lens = LensDistortion{{}, *model};
  }
  const std::vector<std::string>& all_names = LensCoefficientNames(LensModel::kRational);
  const std::vector<std::string>& names = LensCoefficientNames(lens->model);
  const std::string lens_text = std::string("the lens ") + LensModelName(lens->model) + " (" +
                                LensCoefficientList(lens->model) + ")";
  for (size_t i = 0; i < all_names.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), all_names[i]);
    const std::optional<double>& value = settings.coefficients[i];
    if (found == names.end()) {
      if (value.value_or(0.0) == 0.0) continue;
      fail(all_names[i], "is not a coefficient of " + lens_text + "; remove it, or set " + key +
                             ".lens to another model");
    }
    if (needs_all && !value) {
      fail(all_names[i], "is missing; set all coefficients of " + lens_text);
    }
    double& k = lens->k[static_cast<size_t>(found - names.begin())];
    k = value.value_or(k);
  }
}

// Throws std::runtime_error if a side of the images is given as 0 or less: an image size of 0 means
// below that nothing gives it.
void CheckSide(const std::optional<int>& side, const std::string& name, const std::string& origin) {
  if (!side || *side > 0) return;
  throw std::runtime_error(origin + ": " + name + " = " + std::to_string(*side) +
                           " must be a positive number of pixels; leave it out to take that of the "
                           "first image");
}

// Overwrites the intrinsics and the size that the settings of a camera or of a depth camera give.
template <typename Settings>
void ApplyIntrinsics(const Settings& settings, const std::string& section,
                     const std::string& origin, PinholeCamera* camera) {
  CheckSide(settings.width, section + ".width", origin);
  CheckSide(settings.height, section + ".height", origin);
  camera->fx = settings.fx.value_or(camera->fx);
  camera->fy = settings.fy.value_or(camera->fy);
  camera->cx = settings.cx.value_or(camera->cx);
  camera->cy = settings.cy.value_or(camera->cy);
  camera->width = settings.width.value_or(camera->width);
  camera->height = settings.height.value_or(camera->height);
}

// Overwrites the values that are set; the camera is that of the recorded images afterwards. Throws
// std::runtime_error on an invalid image size or lens.
void Apply(const CameraSettings& settings, Calibration* calibration) {
  PinholeCamera recorded = calibration->Recorded();
  ApplyIntrinsics(settings, "camera", settings.origin, &recorded);
  calibration->SetRecorded(recorded);
  calibration->depth_scale = settings.depth_scale.value_or(calibration->depth_scale);
  ApplyLens(settings.lens, settings.origin, "camera", &calibration->distortion);
  if (settings.field_of_view) calibration->field_of_view = settings.field_of_view;
}

// Overwrites the values that are set; the image size is 0 if nothing gives it. Throws
// std::runtime_error on an invalid image size or if there is no complete depth camera.
void Apply(const DepthCameraSettings& settings, const std::string& origin,
           std::optional<DepthCamera>* depth_camera) {
  if (settings.IsEmpty()) return;
  if (!*depth_camera) {
    if (!settings.fx || !settings.fy || !settings.cx || !settings.cy) {
      throw std::runtime_error(origin +
                               ": camera.depth_camera must give fx, fy, cx and cy, because "
                               "no other source describes a depth camera");
    }
    *depth_camera = DepthCamera();
    (*depth_camera)->camera.width = 0;  // unknown
    (*depth_camera)->camera.height = 0;
  }
  ApplyIntrinsics(settings, "camera.depth_camera", origin, &(*depth_camera)->camera);
  Rigid3& depth_from_color = (*depth_camera)->depth_from_color;
  if (!settings.translation.empty()) {
    depth_from_color.translation() = Eigen::Vector3d::Map(settings.translation.data());
  }
  if (!settings.rotation.empty()) {
    const std::optional<Eigen::Quaterniond> rotation = NormalizedQuaternion(settings.rotation);
    if (!rotation) {
      throw std::runtime_error(origin +
                               ": camera.depth_camera.rotation must be a quaternion "
                               "[x, y, z, w] of length 1");
    }
    depth_from_color.rotation() = *rotation;
  }
  ApplyLens(settings.lens, origin, "camera.depth_camera", &(*depth_camera)->distortion);
  double& offset = (*depth_camera)->inverse_depth_offset;
  offset = settings.inverse_depth_offset.value_or(offset);
}

bool IsComplete(const CameraSettings& settings) {
  return settings.fx && settings.fy && settings.cx && settings.cy && settings.depth_scale;
}

// Names the keys of a camera that the settings leave out.
std::string DescribeMissing(const CameraSettings& settings) {
  std::string missing;
  for (const auto& [name, value] :
       {std::pair("fx", settings.fx), std::pair("fy", settings.fy), std::pair("cx", settings.cx),
        std::pair("cy", settings.cy), std::pair("depth_scale", settings.depth_scale)}) {
    if (!value) missing += (missing.empty() ? "camera." : ", camera.") + std::string(name);
  }
  return settings.origin + ": does not give " + missing;
}

// The line of camera.txt for a calibration file near the images; its name alone if it cannot be
// read.
std::string DescribeCalibrationFile(const std::string& path, const SequenceIndex& index) {
  const std::optional<GivenIntrinsics> given = ReadIntrinsicsFile(path);
  if (!given) return path + " may describe the camera, but its format is not supported";
  const PinholeCamera& k = given->camera;
  const std::string unit = given->depth_scale ? FormatNumber(*given->depth_scale) : "DEPTH_SCALE";
  ImageSize size = {k.width, k.height};
  if (size.width == 0) size = FirstImageSize(index, ImageKind::kColor);
  return path + ": the line of camera.txt is '" +
         FormatText("%s %s %s %s %d %d ", FormatNumber(k.fx).c_str(), FormatNumber(k.fy).c_str(),
                    FormatNumber(k.cx).c_str(), FormatNumber(k.cy).c_str(), size.width,
                    size.height) +
         unit + "'" +
         (given->depth_scale ? "" : " with the raw depth units per metre, 1000 for millimetres");
}

[[noreturn]] void FailWithoutCalibration(const CameraSettings& settings,
                                         const SequenceIndex& index) {
  std::string names;
  for (const CameraPreset& preset : CameraPresets()) names += " " + preset.name;
  const std::string file =
      index.container || index.camera
          ? ""
          : "  add " + index.directory + "/camera.txt with one line " + kCameraFileFormat + "\n";
  std::string reasons;
  if (!settings.IsEmpty()) reasons += "\n" + DescribeMissing(settings);
  for (const std::string& path : CalibrationFilesNear(index.directory)) {
    reasons += "\n" + DescribeCalibrationFile(path, index);
  }
  for (const std::string& warning : index.warnings) reasons += "\n" + warning;
  throw std::runtime_error(index.directory + ": the camera is not known. Do one of:\n" + file +
                           "  give --config FILE with the camera's calibration\n" +
                           "  give --camera with one of:" + names + reasons);
}

// Whether the folder is a sequence of the data set of the preset, not only similar to one.
bool IsIdentified(const SequenceIndex& index) {
  return HasPublishedName(index.directory) ||
         (index.preset == "icl-nuim" && !FindFreiburgTruth(index.directory).empty());
}

// The preset that the folder suggests, without readout time. Adds a warning unless it is certain.
Calibration GuessedPreset(SequenceIndex* index) {
  Calibration guess = FindCameraPreset(index->preset).calibration;
  guess.origin += " (guessed from the folder)";
  guess.readout_time.reset();
  guess.readout_origin = Calibration::kSelfCalibrated;
  if (IsIdentified(*index)) return guess;
  std::string warning = "the camera is not known; that of " + index->preset +
                        " is guessed from the names of files and folders";
  if (guess.camera.fy < 0.0) {
    warning += ", with fy < 0 for mirrored images: if they are not mirrored, the world is";
  }
  for (const std::string& path : CalibrationFilesNear(index->directory)) {
    warning += "; " + path + " is not used";
  }
  index->warnings.push_back(warning + "; add camera.txt or give --camera-file, or --camera " +
                            index->preset + " if it is right");
  return guess;
}

// The calibration that the settings are applied to.
Calibration BaseCalibration(const CameraSettings& settings, const std::string& preset,
                            SequenceIndex* index) {
  if (!settings.preset.empty()) return FindCameraPreset(settings.preset).calibration;
  if (IsComplete(settings)) {  // no value of another source may remain, such as a distortion
    Calibration blank;
    blank.camera.width = 0;  // unknown
    blank.camera.height = 0;
    return blank;
  }
  if (index->calibration) {
    if (!preset.empty()) {
      index->warnings.push_back("the camera preset " + preset + " is not used, because " +
                                index->calibration->origin + " gives the calibration");
    }
    return *index->calibration;
  }
  if (!preset.empty()) return FindCameraPreset(preset).calibration;
  const bool is_described = FolderProblem(index->directory).empty() && !IsIdentified(*index) &&
                            !FindCalibrationFiles(index->directory).empty();
  if (index->preset.empty() || is_described) FailWithoutCalibration(settings, *index);
  return GuessedPreset(index);
}

// Adds the warnings about cameras that the settings do not give.
void AddCameraWarnings(const CameraSettings& settings, SequenceIndex* index) {
  const auto& [color, depth] = index->camera_warnings;
  if (!depth.empty() && settings.depth_camera.IsEmpty()) index->warnings.push_back(depth);
  if (!color.empty() && !IsComplete(settings)) index->warnings.push_back(color);
}

ImageSize ImageSizeOf(const SequenceIndex& index, const SequenceEntry& entry, ImageKind kind) {
  const bool is_depth = kind == ImageKind::kDepth;
  if (!index.container) return ReadImageSize(is_depth ? entry.depth_path : entry.color_path);
  const StoredImage stored = is_depth ? index.container->ReadDepth(entry.depth_index)
                                      : index.container->ReadColor(entry.color_index);
  const cv::Mat image =
      stored.bytes.empty() ? stored.pixels : DecodeImage(stored.bytes, cv::IMREAD_UNCHANGED);
  return {image.cols, image.rows};
}

// As FirstImageSize(), but none where that throws.
std::optional<ImageSize> FindImageSize(const SequenceIndex& index, ImageKind kind) {
  constexpr size_t kMaxTries = 10;
  for (size_t i = 0; i < std::min(index.entries.size(), kMaxTries); ++i) {
    try {
      const ImageSize size = ImageSizeOf(index, index.entries[i], kind);
      if (size.width > 0) return size;
    } catch (const std::runtime_error&) {  // the next one
    }
  }
  return std::nullopt;
}

// Takes the size if the camera has none. Throws std::runtime_error if the images have none either.
void SetMissingSize(const std::optional<ImageSize>& size, const SequenceIndex& index,
                    ImageKind kind, PinholeCamera* camera) {
  if (camera->width != 0 && camera->height != 0) return;
  if (index.entries.empty()) {
    throw std::runtime_error(index.directory +
                             ": give the size of the images, camera.width and camera.height");
  }
  const ImageSize known = size ? *size : ImageSizeOf(index, index.entries.front(), kind);
  camera->width = known.width;
  camera->height = known.height;
}

// Colour is scaled to the size of depth: so is a camera of the stored colour images.
void ScaleToDepth(const ImageSize& depth, const SequenceIndex& index, Calibration* calibration) {
  const std::optional<ImageSize> stored = FindImageSize(index, ImageKind::kColor);
  const PinholeCamera recorded = calibration->Recorded();
  if (!stored || calibration->depth_camera || !HaveSimilarShape(*stored, depth)) return;
  if (recorded.width != stored->width || recorded.height != stored->height) return;
  calibration->SetRecorded(ScaledCamera(recorded, depth));
}

// Sets the sizes that no source gives, and fits the calibration to those of the images.
void FitToImages(std::optional<int> max_width, SequenceIndex* index, Calibration* calibration) {
  const std::optional<ImageSize> depth = FindImageSize(*index, ImageKind::kDepth);
  std::optional<ImageSize> color =
      index->scale_color ? depth : FindImageSize(*index, ImageKind::kColor);
  if (index->scale_color && depth) ScaleToDepth(*depth, *index, calibration);
  if (!color && !calibration->depth_camera) color = depth;  // registered to colour
  SetMissingSize(color, *index, ImageKind::kColor, &calibration->camera);
  if (calibration->depth_camera) {
    SetMissingSize(depth, *index, ImageKind::kDepth, &calibration->depth_camera->camera);
  }
  if (color && depth) FitToImageSizes(*color, *depth, max_width, index, calibration);
}

}  // namespace

ImageSize FirstImageSize(const SequenceIndex& index, ImageKind kind) {
  const std::optional<ImageSize> size = FindImageSize(index, kind);
  return size ? *size : ImageSizeOf(index, index.entries.front(), kind);
}

Calibration ResolveCalibration(const CameraSettings& settings, const std::string& preset,
                               SequenceIndex* index) {
  AddCameraWarnings(settings, index);
  Calibration calibration = BaseCalibration(settings, preset, index);
  if (index->depth_scale) calibration.depth_scale = *index->depth_scale;
  Apply(settings, &calibration);
  Apply(settings.depth_camera, settings.origin, &calibration.depth_camera);
  if (calibration.origin.empty()) {
    calibration.origin = settings.origin;
  } else if (!settings.IsEmpty()) {
    calibration.origin += ", " + settings.origin;
  }
  index->float_depth_scale = settings.float_depth_scale.value_or(1.0);
  FitToImages(settings.max_width, index, &calibration);
  calibration.SetUndistorted();
  std::string error;
  if (!calibration.IsValid(&error)) {
    throw std::runtime_error(calibration.origin + ": " + error);
  }
  return calibration;
}

}  // namespace msc_vo
