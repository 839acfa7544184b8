// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Two folders of images without lists, see FindColorFolder() and FindDepth().

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/depth_folder.h"
#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_times.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/named_images.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/stream_times.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// Names a file of a folder without images; "" if there is no folder.
std::string OtherFile(const std::string& folder) {
  if (folder.empty()) return "";
  const std::vector<std::string> entries = ListFolder(folder);
  if (entries.empty()) return "";
  return "; " + *std::min_element(entries.begin(), entries.end()) +
         " is no image: write depth as PNG of 16 bits, or as TIFF or EXR of floating-point numbers";
}

bool Recognises(const std::string& directory) {
  return !ListImages(FindColorFolder(directory)).empty() && IsFolder(FindDepth(directory, ""));
}

bool HaveTimes(const std::vector<std::string>& color, const std::vector<std::string>& depth) {
  return ReadImageNames(color).certainty == NamedTimes::kCertain &&
         ReadImageNames(depth).certainty == NamedTimes::kCertain;
}

// Pairs the images, and finds their times: those of their names, or of files beside the images.
void PairImages(const std::string& directory, const std::vector<std::string>& color,
                const std::vector<std::string>& depth, SequenceIndex* index) {
  const std::string both = FindTimesFile(directory);
  const std::string of_color = FindStreamTimes(FindColorFolder(directory));
  const std::string of_depth = FindStreamTimes(FindDepth(directory, ""));
  if (!HaveTimes(color, depth) &&
      PairedByStreamTimes(of_color.empty() ? both : of_color, color, of_depth, depth, index)) {
    return;
  }
  PairByName(color, depth, index);
  OrderEntries(index);
  for (const std::string& path : {both, of_color, of_depth}) AdoptTimesOfFile(path, index);
  if (index->has_assumed_times) WarnOfUnusedTimes(directory, {both, of_color, of_depth}, index);
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  const std::vector<std::string> color = ListImages(FindColorFolder(directory));
  const std::vector<std::string> depth = ListImages(FindDepth(directory, "", &index.warnings));
  if (color.empty() || depth.empty()) {
    throw std::runtime_error(
        directory + ": needs images in rgb/ and in depth/; found " + std::to_string(color.size()) +
        " and " + std::to_string(depth.size()) +
        OtherFile(color.empty() ? FindColorFolder(directory) : FindDepth(directory, "")));
  }
  PairImages(directory, color, depth, &index);
  ReadTumGroundTruth(directory, WholeStamps::kFrameNumbers, &index);
  ReadFolderCamera(directory, &index);
  index.preset = GuessCameraPreset(directory);
  return index;
}

}  // namespace

const SequenceFormat kRgbDepthFormat = {
    "rgb-depth", "rgb/ and depth/ with images, paired by name or by order", "", Recognises, Read};

}  // namespace msc_vo
