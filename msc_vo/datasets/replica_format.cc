// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Replica, as rendered for NICE-SLAM: results/frameXXXXXX.jpg, results/depthXXXXXX.png, traj.txt
// with one 4x4 matrix world_from_cam per row and frame.

#include <filesystem>
#include <string>
#include <vector>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

std::string ImageFolder(const std::string& directory) {
  return (fs::path(directory) / "results").string();
}

bool Recognises(const std::string& directory) {
  return !ListImages(ImageFolder(directory), "frame").empty();
}

// Row i is the pose of frame i.
void ReadPoses(const std::string& path, SequenceIndex* index) {
  int row = 0;
  for (const TextLine& line : ReadTextLines(path)) {
    if (line.fields.size() != 16) {
      line.Fail("expected the 16 numbers of a 4x4 pose, found " +
                std::to_string(line.fields.size()) + "; correct the line");
    }
    const std::vector<double> values = ParseNumbers(line);
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    if (const auto pose = RigidFromMatrix(matrix)) {
      index->ground_truth.push_back({row / kDefaultFrameRate, *pose});
    }
    ++row;
  }
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  PairByName(ListImages(ImageFolder(directory), "frame"),
             ListImages(ImageFolder(directory), "depth"), &index);
  index.preset = "replica";
  const std::string poses = (fs::path(directory) / "traj.txt").string();
  if (HasEntry(poses)) ReadPoses(poses, &index);
  ReadFolderCamera(directory, &index);
  return index;
}

}  // namespace

const SequenceFormat kReplicaFormat = {"replica",
                                       "results/frameXXXXXX.jpg, results/depthXXXXXX.png, traj.txt",
                                       "renderer of Replica for NICE-SLAM", Recognises, Read};

}  // namespace msc_vo
