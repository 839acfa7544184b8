// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Two folders of images without lists: rgb/ (or color/, colour/, image/, images/) and depth/.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/image_name.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

std::string ColorFolder(const std::string& directory) {
  for (const char* name : {"rgb", "color", "colour", "image", "images"}) {
    std::string folder = (fs::path(directory) / name).string();
    if (IsFolder(folder)) return folder;
  }
  return "";
}

std::string DepthFolder(const std::string& directory) {
  return (fs::path(directory) / "depth").string();
}

bool Recognises(const std::string& directory) {
  return !ListImages(ColorFolder(directory)).empty() && IsFolder(DepthFolder(directory));
}

// Whether the stamps that the names encode are frame numbers, not times.
bool AreNumbered(const std::vector<ListedImage>& images) {
  const std::optional<int64_t> number = FrameNumber(images.front().path);
  return number && images.front().stamp == static_cast<double>(*number) / kDefaultFrameRate;
}

// Returns the images with the stamps that their names encode; empty if a name encodes none or the
// stamps do not ascend.
std::vector<ListedImage> StampedByName(const std::vector<std::string>& paths) {
  std::vector<ListedImage> images;
  for (const std::string& path : paths) {
    const std::optional<double> stamp = StampFromName(path);
    if (!stamp || (!images.empty() && *stamp <= images.back().stamp)) return {};
    images.push_back({*stamp, path, path});
  }
  return images;
}

// Pairs images at the same position of both folders, at kDefaultFrameRate.
void PairByPosition(const std::vector<std::string>& color, const std::vector<std::string>& depth,
                    SequenceIndex* index) {
  if (color.size() != depth.size()) {
    throw std::runtime_error(
        fs::path(color.front()).parent_path().string() + ": " + std::to_string(color.size()) +
        " colour images, but " + std::to_string(depth.size()) +
        " depth images, and their names contain no time; remove those without a partner");
  }
  for (size_t i = 0; i < color.size(); ++i) {
    index->entries.push_back({i / kDefaultFrameRate, color[i], depth[i], ""});
  }
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  const std::vector<std::string> color = ListImages(ColorFolder(directory));
  const std::vector<std::string> depth = ListImages(DepthFolder(directory));
  if (color.empty() || depth.empty()) {
    throw std::runtime_error(directory + ": needs images in rgb/ and in depth/; found " +
                             std::to_string(color.size()) + " and " + std::to_string(depth.size()));
  }
  const ImageLists stamped = {StampedByName(color), StampedByName(depth)};
  if (!stamped.color.empty() && !stamped.depth.empty()) {
    constexpr double kSameNumber = 0.5 / kDefaultFrameRate;
    const bool numbered = AreNumbered(stamped.color) && AreNumbered(stamped.depth);
    PairByTime(stamped, numbered ? kSameNumber : MaxPairDifference(stamped), &index);
  }
  // If the numbers in the names are unrelated, images are paired by their order.
  if (index.entries.empty()) {
    index.warnings.clear();
    PairByPosition(color, depth, &index);
  }
  ReadTumGroundTruth(directory, WholeStamps::kFrameNumbers, &index);
  ReadFolderCamera(directory, &index);
  index.preset = GuessCameraPreset(directory);
  return index;
}

}  // namespace

const SequenceFormat kRgbDepthFormat = {
    "rgb-depth", "rgb/ and depth/ with images, paired by name or by order", Recognises, Read};

}  // namespace msc_vo
