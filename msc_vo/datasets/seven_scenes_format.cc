// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// 7-Scenes and 3DMatch: frame-XXXXXX.color.png, .depth.png (millimetres, 65535: invalid) and
// .pose.txt (4x4 matrix world_from_cam); 3DMatch adds camera-intrinsics.txt.

#include <filesystem>
#include <string>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

constexpr double kMillimetres = 1000.0;  // raw units per metre

bool Recognises(const std::string& directory) {
  return !ListImages(directory, "frame-", ".color").empty();
}

std::string PosePath(const SequenceEntry& entry) {
  const fs::path color = entry.color_path;
  const std::string frame = color.stem().stem().string();
  return (color.parent_path() / (frame + ".pose.txt")).string();
}

// camera-intrinsics.txt of 3DMatch is in the folder or, shared by several sequences, in its parent.
void ReadIntrinsics(const std::string& directory, SequenceIndex* index) {
  ReadFolderCamera(directory, index);
  if (index->calibration) return;
  for (const fs::path& folder : {fs::path(directory), fs::path(directory).parent_path()}) {
    const std::string path = (folder / "camera-intrinsics.txt").string();
    if (!HasEntry(path) || index->entries.empty()) continue;
    const Eigen::MatrixXd k = ReadMatrix(path, 3, 3);
    const ImageSize size = FirstImageSize(*index, ImageKind::kDepth);
    Calibration calibration;
    calibration.camera = {k(0, 0), k(1, 1), k(0, 2), k(1, 2), size.width, size.height};
    calibration.depth_scale = kMillimetres;
    calibration.origin = path;
    index->calibration = calibration;
    return;
  }
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  PairByName(ListImages(directory, "frame-", ".color"), ListImages(directory, "frame-", ".depth"),
             &index);
  index.invalid_depth = 65535;
  index.preset = "7-scenes";
  ReadPoseFiles(PosePath, &index);
  ReadIntrinsics(directory, &index);
  return index;
}

}  // namespace

const SequenceFormat kSevenScenesFormat = {
    "7-scenes", "frame-XXXXXX.color.png (or .jpg), .depth.png, .pose.txt (also 3DMatch)",
    "tools of 7-Scenes or 3DMatch", Recognises, Read};

}  // namespace msc_vo
