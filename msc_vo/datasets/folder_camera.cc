// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/folder_camera.h"

#include <optional>
#include <stdexcept>

#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/intrinsics_file.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

bool AreEqual(const PinholeCamera& a, const PinholeCamera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

// The camera that the files describe; none if they describe none, or different ones.
std::optional<GivenIntrinsics> OnlyCamera(const std::vector<std::string>& files) {
  std::optional<GivenIntrinsics> only;
  for (const std::string& path : files) {
    const std::optional<GivenIntrinsics> given = ReadIntrinsicsFile(path);
    if (!given) continue;
    if (!only) only = given;
    if (!AreEqual(only->camera, given->camera)) return std::nullopt;
    if (!only->depth_scale) only->depth_scale = given->depth_scale;
    if (given->depth_scale && given->depth_scale != only->depth_scale) return std::nullopt;
  }
  return only;
}

// Sets the size of a camera without one; returns whether an image has it.
bool FitsImages(const SequenceIndex& index, PinholeCamera* camera) {
  if (camera->width > 0 && camera->height > 0) return true;
  const std::optional<ImageSize> size = FindSizeOf(
      *camera,
      {FirstImageSize(index, ImageKind::kColor), FirstImageSize(index, ImageKind::kDepth)});
  if (!size) return false;
  camera->width = size->width;
  camera->height = size->height;
  return true;
}

}  // namespace

void ReadFolderCamera(const std::string& directory, SequenceIndex* index) {
  const std::string path = FindEntry(directory, "camera.txt");
  if (!path.empty()) index->calibration = ReadCameraFile(path);
}

void ReadThirdPartyCamera(const std::string& directory, const LayoutDepthScale& depth_scale,
                          SequenceIndex* index) {
  if (index->calibration || index->entries.empty()) return;
  std::optional<GivenIntrinsics> given = OnlyCamera(FindCalibrationFiles(directory));
  const bool is_own = given.has_value();
  if (!is_own && !HasPublishedName(directory)) given = OnlyCamera(CalibrationFilesNear(directory));
  if (!given) return;
  if (!FitsImages(*index, &given->camera)) {
    if (!is_own) return;
    throw std::runtime_error(
        given->path +
        ": cx and cy are more than a tenth of the image size off the centre of "
        "the images; write camera.txt, or give the intrinsics of their size");
  }
  Calibration calibration;
  calibration.camera = given->camera;
  calibration.depth_scale = given->depth_scale.value_or(depth_scale.units_per_metre);
  calibration.origin = given->path;
  std::string error;
  if (!calibration.IsValid(&error)) {
    if (!is_own) return;
    throw std::runtime_error(given->path + ": " + error);
  }
  index->calibration = calibration;
  if (given->depth_scale || depth_scale.is_certain) return;
  index->warnings.push_back(
      FormatText("%s: gives no depth scale; %g raw depth units per metre are assumed, as usual in "
                 "this layout; --set camera.depth_scale=UNITS sets another scale",
                 given->path.c_str(), depth_scale.units_per_metre));
}

std::vector<std::string> CalibrationFilesNear(const std::string& directory) {
  if (!FolderProblem(directory).empty()) return {};
  const std::vector<std::string> own = FindCalibrationFiles(directory);
  const std::string parent = ParentFolder(directory);
  return own.empty() && FolderProblem(parent).empty() ? FindCalibrationFiles(parent) : own;
}

}  // namespace msc_vo
