// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// 7-Scenes and 3DMatch: frame-XXXXXX.color.png, .depth.png (millimetres, 65535: invalid) and
// .pose.txt (4x4 matrix world_from_cam); 3DMatch adds camera-intrinsics.txt, BundleFusion and
// 12-Scenes info.txt or _info.txt.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/datasets/sequence_format.h"
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

// A camera of an info.txt, "Color" or "Depth"; none if the file does not describe it.
std::optional<PinholeCamera> CameraOf(const std::string& kind, const std::vector<TextLine>& lines) {
  const std::string lowercase = Lowercase(kind);
  const std::vector<double> k = NumbersOf("m_calibration" + kind + "Intrinsic", lines);
  const std::vector<double> width = NumbersOf("m_" + lowercase + "Width", lines);
  const std::vector<double> height = NumbersOf("m_" + lowercase + "Height", lines);
  if (k.size() != 16 || width.size() != 1 || height.size() != 1) return std::nullopt;
  constexpr double kMaxSize = 65535.0;  // as in headers of JPEG files
  const auto is_size = [](double size) { return size >= 1.0 && size <= kMaxSize; };
  if (!is_size(width[0]) || !is_size(height[0])) return std::nullopt;
  return PinholeCamera{
      k[0], k[5], k[2], k[6], static_cast<int>(width[0]), static_cast<int>(height[0])};
}

// The transform of an info.txt to the axes of a camera, "Color" or "Depth"; identity if there is
// none.
Rigid3 ExtrinsicOf(const std::string& kind, const std::vector<TextLine>& lines) {
  const std::vector<double> e = NumbersOf("m_calibration" + kind + "Extrinsic", lines);
  if (e.size() != 16) return Rigid3();
  return RigidFromMatrix(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(e.data()))
      .value_or(Rigid3());
}

// Reads the cameras of an info.txt; returns whether it has that of colour. Depth of the shape of
// colour is registered to it, other depth has its own camera.
bool ReadInfo(const std::string& path, SequenceIndex* index) {
  if (path.empty()) return false;
  const std::vector<TextLine> lines = ReadTextLines(path);
  const std::optional<PinholeCamera> camera = CameraOf("Color", lines);
  if (!camera) return false;
  const std::vector<double> units = NumbersOf("m_depthShift", lines);
  const ImageSize color = FirstImageSize(*index, ImageKind::kColor);
  const ImageSize depth = FirstImageSize(*index, ImageKind::kDepth);
  index->scale_color = HaveSimilarShape(color, depth);
  Calibration calibration;
  calibration.camera = ScaledCamera(*camera, index->scale_color ? depth : color);
  calibration.depth_scale = units.empty() ? kMillimetres : units[0];
  calibration.origin = path;
  const std::optional<PinholeCamera> depth_camera = CameraOf("Depth", lines);
  if (!index->scale_color && depth_camera) {
    calibration.depth_camera =
        DepthCamera{ScaledCamera(*depth_camera, depth),
                    ExtrinsicOf("Depth", lines) * ExtrinsicOf("Color", lines).Inverse()};
  }
  index->calibration = calibration;
  return true;
}

// The files are in the folder or, shared by several sequences, in its parent.
void ReadIntrinsics(const std::string& directory, SequenceIndex* index) {
  ReadFolderCamera(directory, index);
  if (index->calibration || index->entries.empty()) return;
  for (const std::string& folder : {directory, ParentFolder(directory)}) {
    if (ReadInfo(FirstEntry(folder, {"info.txt", "_info.txt"}), index)) return;
  }
  ReadThirdPartyCamera(directory, {kMillimetres, /*is_certain=*/true}, index);
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
