// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_folder.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "msc_vo/datasets/image_name.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/text/ending.h"
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

bool IsNamedJpeg(const fs::path& path) {
  const std::string extension = Lowercase(path.extension().string());
  return extension == ".jpg" || extension == ".jpeg";
}

// Removes JPEG files beside a file of another format with the same stem.
void RemoveJpegCopies(std::vector<std::string>* paths) {
  const auto stem_of = [](const fs::path& path) { return path.stem().string(); };
  std::set<std::string> stems;
  for (const std::string& path : *paths) {
    if (!IsNamedJpeg(path)) stems.insert(stem_of(path));
  }
  const auto is_copy = [&](const std::string& path) {
    return IsNamedJpeg(path) && stems.count(stem_of(path)) > 0;
  };
  EraseIf(paths, is_copy);
}

bool StartsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

}  // namespace

std::vector<std::string> ListImages(const std::string& folder, const std::string& prefix,
                                    const std::string& suffix) {
  std::vector<std::string> paths;
  if (!IsFolder(folder)) return paths;
  for (const std::string& path : ListFolder(folder)) {
    const std::string stem = fs::path(path).stem().string();
    if (stem.empty() || stem[0] == '.' || !HasImageExtension(path) || IsFolder(path)) continue;
    if (StartsWith(stem, prefix) && HasEnding(stem, suffix)) paths.push_back(path);
  }
  RemoveJpegCopies(&paths);
  SortNames(&paths);
  return paths;
}

FolderImages FindFolderImages(const std::string& folder) {
  const std::vector<std::string> images = ListImages(folder);
  if (images.empty() || !FileProblem(images.front(), kMaxImageBytes).empty()) {
    return FolderImages::kNone;
  }
  try {
    const cv::Mat image = ReadImageFile(images.front());
    if (image.empty()) return FolderImages::kNone;
    if (image.channels() == 1 && image.elemSize1() > 1) return FolderImages::kDepth;
    const bool is_color = image.channels() > 1 && image.elemSize1() == 1;
    return is_color ? FolderImages::kColor : FolderImages::kOther;
  } catch (const std::runtime_error&) {
    return FolderImages::kNone;
  }
}

}  // namespace msc_vo
