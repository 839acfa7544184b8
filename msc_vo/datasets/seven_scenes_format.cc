// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// 7-Scenes and 3DMatch: frame-XXXXXX.color.png, .depth.png (millimetres, 65535: invalid) and
// .pose.txt (4x4 matrix world_from_cam); 3DMatch adds camera-intrinsics.txt, BundleFusion and
// 12-Scenes info.txt or _info.txt.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

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

// The numbers of the line "name = 1 2 3" of an info.txt; empty if there is none.
std::vector<double> NumbersOf(const std::string& name, const std::vector<TextLine>& lines) {
  std::vector<double> numbers;
  for (const TextLine& line : lines) {
    if (line.fields.front() != name) continue;
    for (size_t i = 1; i < line.fields.size(); ++i) {
      const std::optional<double> number = ParseNumber(line.fields[i]);
      if (number) numbers.push_back(*number);
      if (!number && line.fields[i] != "=") line.Fail("is no '" + name + " = NUMBERS'; correct it");
    }
  }
  return numbers;
}

// Reads the colour camera of an info.txt; returns whether it has one.
bool ReadInfo(const std::string& path, SequenceIndex* index) {
  if (!HasEntry(path)) return false;
  const std::vector<TextLine> lines = ReadTextLines(path);
  const std::vector<double> k = NumbersOf("m_calibrationColorIntrinsic", lines);
  const std::vector<double> width = NumbersOf("m_colorWidth", lines);
  const std::vector<double> height = NumbersOf("m_colorHeight", lines);
  const std::vector<double> units = NumbersOf("m_depthShift", lines);
  if (k.size() != 16 || width.size() != 1 || height.size() != 1) return false;
  constexpr double kMaxSize = 65535.0;  // as in headers of JPEG files
  const auto is_size = [](double size) { return size >= 1.0 && size <= kMaxSize; };
  if (!is_size(width[0]) || !is_size(height[0])) return false;
  const ImageSize color = FirstImageSize(*index, ImageKind::kColor);
  const ImageSize depth = FirstImageSize(*index, ImageKind::kDepth);
  index->scale_color = HaveSimilarShape(color, depth);
  const PinholeCamera camera = {
      k[0], k[5], k[2], k[6], static_cast<int>(width[0]), static_cast<int>(height[0])};
  Calibration calibration;
  calibration.camera = ScaledCamera(camera, index->scale_color ? depth : color);
  calibration.depth_scale = units.empty() ? kMillimetres : units[0];
  calibration.origin = path;
  index->calibration = calibration;
  return true;
}

// The files are in the folder or, shared by several sequences, in its parent.
void ReadIntrinsics(const std::string& directory, SequenceIndex* index) {
  ReadFolderCamera(directory, index);
  if (index->calibration || index->entries.empty()) return;
  for (const fs::path& folder : {fs::path(directory), fs::path(directory).parent_path()}) {
    for (const char* name : {"info.txt", "_info.txt"}) {
      if (ReadInfo((folder / name).string(), index)) return;
    }
    const std::string path = (folder / "camera-intrinsics.txt").string();
    if (!HasEntry(path)) continue;
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
