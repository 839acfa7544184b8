// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// ICL-NUIM: a TUM-style folder whose stamps are frame numbers, depth first in its associations,
// ground truth in *.gt.freiburg, and a camera with negative fy.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Median step from which whole numbers may be milliseconds of images at 50 Hz or less.
constexpr double kMinMilliseconds = 20.0;

// Tests whether the association file names depth first and has frame numbers for stamps, which no
// other data set does.
bool HasIclNuimAssociations(const std::string& directory) {
  const std::string path = FindAssociations(directory);
  if (path.empty()) return false;
  std::vector<double> stamps;
  const std::vector<TextLine> lines = ReadTextLines(path);
  for (const TextLine& line : lines) {
    const std::optional<double> stamp = ParseNumber(line.fields.front());
    if (line.fields.size() != 4 || !stamp || line.fields[1].rfind("depth", 0) != 0) return false;
    stamps.push_back(*stamp);
  }
  return AreFrameNumbers(stamps) && AreFrameCounts(stamps) &&
         MedianInterval(stamps) < kMinMilliseconds && IsDepthFirst(lines);
}

// Requires properties of this data set only, because its camera is mirrored.
bool Recognises(const std::string& directory) {
  if (HasIclNuimAssociations(directory)) return true;
  return !FindFreiburgTruth(directory).empty() &&
         (!FindAssociations(directory).empty() ||
          IsFolder((std::filesystem::path(directory) / "rgb").string()));
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  const std::filesystem::path folder = directory;
  if (!FindAssociations(directory).empty() || HasEntry((folder / "rgb.txt").string())) {
    ReadTumEntries(directory, WholeStamps::kFrameNumbers, &index);
  } else {
    PairByName(ListImages((folder / "rgb").string()), ListImages((folder / "depth").string()),
               &index);
  }
  ReadTumGroundTruth(directory, WholeStamps::kFrameNumbers, &index);
  ReadFolderCamera(directory, &index);
  ReadThirdPartyCamera(directory, {5000.0}, &index);
  if (Recognises(directory)) index.preset = "icl-nuim";
  return index;
}

}  // namespace

const SequenceFormat kIclNuimFormat = {
    "icl-nuim",
    "depth-first associations.txt with frame numbers, or rgb/, depth/ and *.gt.freiburg",
    "renderer of ICL-NUIM", Recognises, Read};

}  // namespace msc_vo
