// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// ScanNet, exported from its .sens files: color/N.jpg, depth/N.png (millimetres), pose/N.txt
// (4x4 matrix world_from_cam; -inf if tracking was lost), intrinsic/intrinsic_color.txt and
// intrinsic_depth.txt (4x4).

#include <filesystem>
#include <string>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

bool Recognises(const std::string& directory) {
  const auto has_folder = [&](const char* name) { return IsFolder(PathIn(directory, name)); };
  return has_folder("color") && has_folder("depth") &&
         (has_folder("pose") || has_folder("intrinsic"));
}

std::string PosePath(const SequenceEntry& entry) {
  const fs::path color = entry.color_path;
  return (color.parent_path().parent_path() / "pose" / (color.stem().string() + ".txt")).string();
}

// The intrinsics of images of one size, for those of another.
PinholeCamera CameraOf(const Eigen::MatrixXd& k, const ImageSize& from, const ImageSize& to) {
  return ScaledCamera({k(0, 0), k(1, 1), k(0, 2), k(1, 2), from.width, from.height}, to);
}

void ReadIntrinsics(const fs::path& folder, SequenceIndex* index) {
  ReadFolderCamera(folder.string(), index);
  if (index->calibration || index->entries.empty()) return;
  const ImageSize color = FirstImageSize(*index, ImageKind::kColor);
  const ImageSize depth = FirstImageSize(*index, ImageKind::kDepth);
  const std::string color_file = (folder / "intrinsic" / "intrinsic_color.txt").string();
  const std::string depth_file = (folder / "intrinsic" / "intrinsic_depth.txt").string();
  Calibration calibration;
  calibration.depth_scale = 1000.0;  // millimetres
  if (HasEntry(color_file)) {
    // Depth of another shape is not registered to colour: without a description of its camera,
    // decoding refuses it.
    index->scale_color = HaveSimilarShape(color, depth);
    calibration.camera =
        CameraOf(ReadMatrix(color_file, 4, 4), color, index->scale_color ? depth : color);
    calibration.origin = color_file;
  } else if (HasEntry(depth_file)) {
    calibration.camera = CameraOf(ReadMatrix(depth_file, 4, 4), depth, depth);
    calibration.origin = depth_file;
  } else {
    return;
  }
  index->calibration = calibration;
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  const fs::path folder = directory;
  PairByName(ListImages((folder / "color").string()), ListImages((folder / "depth").string()),
             &index);
  index.scale_color = true;
  ReadPoseFiles(PosePath, &index);
  if (index.ground_truth.empty() && IsFolder((folder / "pose").string()) &&
      !ListFolder((folder / "pose").string()).empty() && !index.entries.empty()) {
    index.warnings.push_back(
        "there is no ground truth, because pose/ has no valid pose with the "
        "name of a colour image, such as " +
        PosePath(index.entries.front()));
  }
  ReadIntrinsics(folder, &index);
  return index;
}

}  // namespace

const SequenceFormat kScanNetFormat = {
    "scannet", "color/, depth/, pose/, intrinsic/ as exported from .sens files",
    "ScanNet, exported with its SensReader", Recognises, Read};

}  // namespace msc_vo
