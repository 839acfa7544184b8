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
  if (!Accepts(path, [&] { lists = ReadAssociations(path); })) return 0;
  Require(lists.color.size() == lists.depth.size() && !lists.color.empty(), "pairs of images");
  const SequenceIndex index = OpenSequence(folder.path(), "tum");
  Require(!index.entries.empty(), "a list that is read has entries");
  for (const SequenceEntry& entry : index.entries) {
    Require(std::isfinite(entry.timestamp) && std::isfinite(entry.depth_delay), "finite stamps");
  }
  return 0;
}
