// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_folder.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "msc_vo/datasets/image_name.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

bool HasImageExtension(const fs::path& path) {
  const std::string extension = Lowercase(path.extension().string());
  constexpr const char* kExtensions[] = {".png", ".jpg",  ".jpeg", ".pgm", ".ppm", ".pnm",
                                         ".bmp", ".tiff", ".tif",  ".exr", ".webp"};
  return std::find(std::begin(kExtensions), std::end(kExtensions), extension) !=
         std::end(kExtensions);
}

bool StartsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool EndsWith(const std::string& text, const std::string& suffix) {
  return text.size() >= suffix.size() &&
         text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

}  // namespace

std::vector<std::string> ListImages(const std::string& folder, const std::string& prefix,
                                    const std::string& suffix) {
  std::vector<std::string> paths;
  if (!IsFolder(folder)) return paths;
  for (const std::string& path : ListFolder(folder)) {
    const std::string stem = fs::path(path).stem().string();
    if (stem.empty() || stem[0] == '.' || !HasImageExtension(path) || IsFolder(path)) continue;
    if (StartsWith(stem, prefix) && EndsWith(stem, suffix)) paths.push_back(path);
  }
  std::sort(paths.begin(), paths.end(), NaturalLess);
  return paths;
}

}  // namespace msc_vo
