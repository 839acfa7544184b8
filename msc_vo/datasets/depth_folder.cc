// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/depth_folder.h"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Tests for "aligned_depth_to_color", "depth_registered" and the like, but not "depth_unaligned" or
// "depth_aligned_preview".
bool IsNamedRegistered(const std::string& name) {
  static const std::regex kPattern(
      "(aligned|registered)[_-]?depth([_-]?to[_-]?(colou?r|rgb))?|"
      "depth[_-]?(aligned|registered)([_-]?to[_-]?(colou?r|rgb))?");
  return std::regex_match(name, kPattern);
}

}  // namespace

std::string FindDepth(const std::string& directory, const std::string& ending,
                      std::vector<std::string>* warnings) {
  std::vector<std::string> names = {"depth", "depths", "depth_images", "depth_left",
                                    "lowres_depth"};
  for (std::string& name : names) name += ending;
  const std::string plain = FirstEntry(directory, names);
  std::vector<std::string> entries = ListFolder(directory);
  std::sort(entries.begin(), entries.end());
  const auto registered = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) {
    const fs::path path = entry;
    return IsNamedRegistered(Lowercase(path.stem().string())) &&
           (ending.empty() ? !ListImages(entry).empty()
                           : Lowercase(path.extension().string()) == ending);
  });
  if (registered == entries.end()) return plain;
  if (warnings != nullptr && !plain.empty()) {
    warnings->push_back(*registered + " is used rather than " + plain +
                        ", because its name says that depth is registered to colour");
  }
  return *registered;
}

std::string FindColorFolder(const std::string& directory) {
  for (const char* name : {"rgb", "color", "colour", "image", "images", "rgb_images",
                           "color_images", "image_left", "lowres_wide"}) {
    std::string folder = FindEntry(directory, name);
    if (IsFolder(folder)) return folder;
  }
  return "";
}

std::string FindColorList(const std::string& directory) {
  return FirstEntry(directory, {"rgb.txt", "color.txt"});
}

}  // namespace msc_vo
