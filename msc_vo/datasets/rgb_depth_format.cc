// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Two folders of images and nothing else: rgb/ and depth/ (or color/, colour/, image/, images/).

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

std::string ColorFolder(const std::string& directory) {
  for (const char* name : {"rgb", "color", "colour", "image", "images"}) {
    const std::string folder = (fs::path(directory) / name).string();
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

// Each image with the time that its name tells; empty if one has none or they do not ascend.
std::vector<ListedImage> StampedByName(const std::vector<std::string>& paths) {
  std::vector<ListedImage> images;
  for (const std::string& path : paths) {
    const std::optional<double> stamp = StampFromName(path);
    if (!stamp || (!images.empty() && *stamp <= images.back().stamp)) return {};
    images.push_back({*stamp, path, path});
  }
  return images;
}

// First with first, second with second, at kDefaultFrameRate.
void PairByPosition(const std::vector<std::string>& color, const std::vector<std::string>& depth,
                    SequenceIndex* index) {
  if (color.size() != depth.size()) {
    throw std::runtime_error(
        fs::path(color.front()).parent_path().string() + ": " + std::to_string(color.size()) +
        " colour images, but " + std::to_string(depth.size()) +
        " depth images, and their names tell no time; remove those without a partner");
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
  const std::vector<ListedImage> stamped_color = StampedByName(color);
  const std::vector<ListedImage> stamped_depth = StampedByName(depth);
  if (!stamped_color.empty() && !stamped_depth.empty()) {
    constexpr double kMaxDifference = 0.5 / kDefaultFrameRate;  // half a frame
    PairByTime(stamped_color, stamped_depth, kMaxDifference, &index);
  }
  // Names with unrelated numbers: the order is all that can be trusted.
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
