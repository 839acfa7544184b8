// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// TUM RGB-D: rgb.txt and depth.txt, or an association file; groundtruth.txt; camera.txt.

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/depth_folder.h"
#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

bool Recognises(const std::string& directory) {
  return !FirstEntry(directory, {"rgb.txt", "depth.txt"}).empty() ||
         !FindAssociations(directory).empty() ||
         (!FindColorList(directory).empty() && !FindDepth(directory, ".txt").empty());
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  ReadTumEntries(directory, WholeStamps::kTimes, &index);
  ReadTumGroundTruth(directory, WholeStamps::kTimes, &index);
  ReadFolderCamera(directory, &index);
  ReadThirdPartyCamera(directory, {5000.0}, &index);
  index.preset = GuessCameraPreset(directory);
  return index;
}

}  // namespace

const SequenceFormat kTumFormat = {
    "tum", "rgb.txt and depth.txt with 'time path' rows, or associations.txt",
    "tools of the TUM RGB-D benchmark, or msc_vo", Recognises, Read};

}  // namespace msc_vo
