// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <utility>

#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/decompression.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

std::unique_ptr<BagFile> OpenRos2Bag(const std::string& path) {
  std::unique_ptr<TemporaryFile> unpacked;
  if (IsZstd(ReadBeginning(path, 4))) unpacked = UnpackZstdFile(path);
  const std::string file = unpacked ? unpacked->path() : path;
  if (ReadBeginning(file, 5) == "\x89MCAP") return OpenMcapBag(path, file);
  std::unique_ptr<BagFile> bag = OpenDb3Bag(path, file);
  return IsRealSenseBag(*bag) ? TranslateRealSenseBag(std::move(bag)) : std::move(bag);
}

}  // namespace msc_vo
