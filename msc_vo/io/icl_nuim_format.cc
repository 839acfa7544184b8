// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// ICL-NUIM: a TUM-style folder whose stamps are frame numbers, depth first in its associations,
// ground truth in *.gt.freiburg, and a camera with negative fy.

#include <filesystem>

#include "msc_vo/io/image_folder.h"
#include "msc_vo/io/image_list.h"
#include "msc_vo/io/sequence_format.h"
#include "msc_vo/io/text_file.h"
#include "msc_vo/io/tum_folder.h"

namespace msc_vo {

namespace {

// The data set's own ground truth is what tells it from a TUM folder: nothing else justifies a
// guess of its mirrored camera.
bool Recognises(const std::string& directory) {
  return !FindFreiburgTruth(directory).empty() &&
         (!FindAssociations(directory).empty() ||
          std::filesystem::is_directory(std::filesystem::path(directory) / "rgb"));
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  const std::filesystem::path folder = directory;
  if (!FindAssociations(directory).empty() || std::filesystem::exists(folder / "rgb.txt")) {
    ReadTumEntries(directory, &index);
  } else {
    PairByFrameNumber(ListImages((folder / "rgb").string()),
                      ListImages((folder / "depth").string()), &index);
  }
  ReadTumGroundTruth(directory, &index);
  ReadFolderCamera(directory, &index);
  index.preset = "icl-nuim";
  return index;
}

}  // namespace

const SequenceFormat kIclNuimFormat = {
    "icl-nuim", "rgb/, depth/ or associations.txt with frame numbers, and *.gt.freiburg",
    Recognises, Read};

}  // namespace msc_vo
