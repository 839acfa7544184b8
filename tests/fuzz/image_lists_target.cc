// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// rgb.txt, depth.txt and groundtruth.txt of a folder: pairing in time, units of stamps, frame
// numbers.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {
namespace {

// Fills the folder. Without a third file there is no ground truth.
void WriteFiles(const std::vector<std::string_view>& files, InputFolder* folder) {
  folder->Write("rgb.txt", files[0]);
  folder->Write("depth.txt", files.size() > 1 ? files[1] : files[0]);
  if (files.size() > 2) {
    folder->Write("groundtruth.txt", files[2]);
  } else {
    folder->Remove("groundtruth.txt");
  }
}

void CheckIndex(const SequenceIndex& index) {
  for (size_t i = 0; i < index.entries.size(); ++i) {
    const SequenceEntry& entry = index.entries[i];
    Require(std::isfinite(entry.timestamp) && std::isfinite(entry.depth_delay), "finite stamps");
    Require(i == 0 || entry.timestamp > index.entries[i - 1].timestamp, "ascending stamps");
  }
  for (size_t i = 0; i < index.ground_truth.size(); ++i) {
    const TimedPose& pose = index.ground_truth[i];
    Require(std::isfinite(pose.timestamp) && pose.world_from_cam.params.allFinite(),
            "finite ground truth");
    Require(i == 0 || pose.timestamp >= index.ground_truth[i - 1].timestamp,
            "ground truth in order of time");
  }
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  WriteFiles(SplitFiles(AsText(data, size)), &folder);
  SequenceIndex index;
  const char* format = size % 2 == 0 ? "tum" : "icl-nuim";
  if (Accepts(folder.path(), [&] { index = OpenSequence(folder.path(), format); })) {
    CheckIndex(index);
  }
  return 0;
}
