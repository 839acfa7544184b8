// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/tum_folder.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/trajectory.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Numbers frames / kDefaultFrameRate if that is what the stamps of `items` are.
template <typename Item>
void FrameNumbersToSeconds(double Item::*stamp, std::vector<Item>* items) {
  std::vector<double> stamps;
  for (const Item& item : *items) stamps.push_back(item.*stamp);
  if (!AreFrameNumbers(stamps)) return;
  for (Item& item : *items) item.*stamp /= kDefaultFrameRate;
}

std::vector<ListedImage> ReadListOf(const fs::path& folder, const char* name) {
  const fs::path path = folder / name;
  if (!fs::exists(path)) {
    throw std::runtime_error(path.string() +
                             ": does not exist; a TUM folder needs rgb.txt and depth.txt (or "
                             "associations.txt). --format rgb-depth pairs rgb/ and depth/ by name");
  }
  std::vector<ListedImage> images = ReadImageList(path.string());
  FrameNumbersToSeconds(&ListedImage::stamp, &images);
  return images;
}

}  // namespace

void ReadTumEntries(const std::string& directory, SequenceIndex* index) {
  const std::string associations = FindAssociations(directory);
  if (!associations.empty()) {
    index->entries = ReadAssociations(associations);
    FrameNumbersToSeconds(&SequenceEntry::timestamp, &index->entries);
    return;
  }
  PairByTime(ReadListOf(directory, "rgb.txt"), ReadListOf(directory, "depth.txt"),
             kMaxPairDifference, index);
}

void ReadTumGroundTruth(const std::string& directory, SequenceIndex* index) {
  const fs::path path = fs::path(directory) / "groundtruth.txt";
  const std::string truth = fs::exists(path) ? path.string() : FindFreiburgTruth(directory);
  if (truth.empty()) return;
  index->ground_truth = ReadTrajectory(truth);
  FrameNumbersToSeconds(&TimedPose::timestamp, &index->ground_truth);
}

void ReadFolderCamera(const std::string& directory, SequenceIndex* index) {
  const fs::path path = fs::path(directory) / "camera.txt";
  if (fs::exists(path)) index->calibration = ReadCameraFile(path.string());
}

std::string FindFreiburgTruth(const std::string& directory) {
  constexpr char kEnding[] = ".gt.freiburg";
  std::string first;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const std::string path = entry.path().string();
    const size_t at = path.rfind(kEnding);
    if (at == std::string::npos || at + sizeof(kEnding) - 1 != path.size()) continue;
    if (first.empty() || path < first) first = path;
  }
  return first;
}

}  // namespace msc_vo
