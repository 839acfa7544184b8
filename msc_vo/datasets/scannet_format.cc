// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// ScanNet, exported from its .sens files: color/N.jpg, depth/N.png (millimetres), pose/N.txt
// (4x4 matrix world_from_cam; -inf if tracking was lost), intrinsic/intrinsic_color.txt and
// intrinsic_depth.txt (4x4).

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/intrinsics_file.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

bool Recognises(const std::string& directory) {
  const auto has_folder = [&](const char* name) { return IsFolder(FindEntry(directory, name)); };
  return has_folder("color") && has_folder("depth") &&
         (has_folder("pose") || has_folder("intrinsic"));
}

std::string PosePath(const std::string& folder, const SequenceEntry& entry) {
  return PathIn(folder, fs::path(entry.color_path).stem().string() + ".txt");
}

// Size of the colour images that ScanNet publishes, for which it gives the intrinsics.
constexpr ImageSize kPublishedColor = {1296, 968};

// Reads a file of intrinsics; the size of the camera is that of the sizes whose centre fits, or 0.
// None if there is no such file. Throws std::runtime_error if it holds no camera matrix.
std::optional<GivenIntrinsics> ReadCamera(const std::string& path,
                                          const std::vector<ImageSize>& sizes) {
  if (path.empty()) return std::nullopt;
  std::optional<GivenIntrinsics> given = ReadIntrinsicsFile(path);
  if (!given) {
    throw std::runtime_error(path +
                             ": holds no camera matrix; write the rows 'fx 0 cx', '0 fy cy' "
                             "and '0 0 1'");
  }
  const ImageSize size = FindSizeOf(given->camera, sizes).value_or(ImageSize());
  given->camera.width = size.width;
  given->camera.height = size.height;
  return given;
}

// Warns if the intrinsics are those of images of another size than `size`.
void CheckSize(const GivenIntrinsics& given, const ImageSize& size, SequenceIndex* index) {
  if (given.camera.width == size.width && given.camera.height == size.height) return;
  index->warnings.push_back(
      given.path + FormatText(": cx and cy are those of images of %dx%d; the camera is scaled to "
                              "the colour images of %dx%d",
                              given.camera.width, given.camera.height, size.width, size.height));
}

void ReadIntrinsics(const std::string& directory, SequenceIndex* index) {
  ReadFolderCamera(directory, index);
  const std::string folder = FirstEntry(directory, {"intrinsic", "intrinsics"});
  if (index->calibration || index->entries.empty() || folder.empty()) return;
  const ImageSize color = FirstImageSize(*index, ImageKind::kColor);
  const ImageSize depth = FirstImageSize(*index, ImageKind::kDepth);
  const auto of_color =
      ReadCamera(FindEntry(folder, "intrinsic_color.txt"), {color, kPublishedColor});
  const auto of_depth = ReadCamera(FindEntry(folder, "intrinsic_depth.txt"), {depth});
  Calibration calibration;
  calibration.depth_scale = 1000.0;  // millimetres
  if (of_color && of_color->camera.width > 0) {
    CheckSize(*of_color, color, index);
    // Depth of another shape is not registered to colour: without a description of its camera,
    // decoding refuses it.
    index->scale_color = HaveSimilarShape(color, depth);
    calibration.camera = ScaledCamera(of_color->camera, index->scale_color ? depth : color);
    calibration.origin = of_color->path;
  } else if (of_depth && of_depth->camera.width > 0) {
    if (of_color) {
      index->warnings.push_back(of_color->path + ": is of images of another size; " +
                                of_depth->path + " is used");
    }
    calibration.camera = of_depth->camera;
    calibration.origin = of_depth->path;
  } else if (of_color || of_depth) {
    throw std::runtime_error(
        (of_color ? of_color : of_depth)->path +
        ": cx and cy are more than a tenth of the image size off the centre of "
        "the images; write camera.txt, or give the intrinsics of their size");
  } else {
    return;
  }
  index->calibration = calibration;
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  PairByName(ListImages(FindEntry(directory, "color")), ListImages(FindEntry(directory, "depth")),
             &index);
  index.scale_color = true;
  const std::string poses = FindEntry(directory, "pose");
  if (!poses.empty()) {
    ReadPoseFiles([&poses](const SequenceEntry& entry) { return PosePath(poses, entry); }, &index);
  }
  if (index.ground_truth.empty() && IsFolder(poses) && !ListFolder(poses).empty() &&
      !index.entries.empty()) {
    index.warnings.push_back(
        "there is no ground truth, because pose/ has no valid pose with the "
        "name of a colour image, such as " +
        PosePath(poses, index.entries.front()));
  }
  ReadIntrinsics(directory, &index);
  return index;
}

}  // namespace

const SequenceFormat kScanNetFormat = {
    "scannet", "color/, depth/, pose/, intrinsic/ as exported from .sens files",
    "ScanNet, exported with its SensReader", Recognises, Read};

}  // namespace msc_vo
