// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// associations.txt: colour and depth images of one frame in a row.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/sequence.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  const std::string path = folder.Write("associations.txt", AsText(data, size));
  ImageLists lists;
  std::vector<std::string> warnings;
  if (!Accepts(path, [&] { lists = ReadAssociations(path, &warnings); })) return 0;
  Require(lists.color.size() == lists.depth.size() && !lists.color.empty(), "pairs of images");
  SequenceIndex index;
  if (!Accepts(folder.path(), [&] { index = OpenSequence(folder.path(), "tum"); })) return 0;
  Require(2 * index.entries.size() >= lists.color.size(), "most of the list is used");
  for (const SequenceEntry& entry : index.entries) {
    Require(std::isfinite(entry.timestamp) && std::isfinite(entry.depth_delay), "finite stamps");
  }
  return 0;
}
