// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Replica, as rendered for NICE-SLAM: results/frameXXXXXX.jpg, results/depthXXXXXX.png, traj.txt
// with one 4x4 matrix world_from_cam per row; row i is that of frame i; cam_params.json here or in
// the parent folder.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/name_pairing.h"
#include "msc_vo/datasets/named_images.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

bool Recognises(const std::string& directory) {
  return !ListImages(PathIn(directory, "results"), "frame").empty();
}

// Reads the poses of all rows; none: the row holds no valid one.
std::vector<std::optional<Rigid3>> ReadPoseRows(const std::string& path) {
  std::vector<std::optional<Rigid3>> poses;
  for (const TextLine& line : ReadTextLines(path)) {
    if (line.fields.size() != 16) {
      line.Fail("expected the 16 numbers of a 4x4 pose, found " +
                std::to_string(line.fields.size()) + "; correct the line");
    }
    const std::vector<double> values = ParseNumbers(line);
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    poses.push_back(PoseFromMatrix(matrix, line.Where()));
  }
  return poses;
}

// How the rows of the trajectory follow from the numbers of the frames.
enum class RowOrder { kFrameNumbers, kImages, kUnknown };

RowOrder OrderOfRows(const std::vector<int64_t>& numbers, size_t num_rows) {
  const auto num_images = static_cast<int64_t>(numbers.size());
  const auto count = static_cast<int64_t>(num_rows);
  if (numbers.empty() || numbers.back() < count) return RowOrder::kFrameNumbers;
  if (num_images == count) return RowOrder::kImages;
  const bool are_frames_missing = numbers.front() != 0 || numbers.back() != num_images - 1;
  return are_frames_missing ? RowOrder::kUnknown : RowOrder::kFrameNumbers;  // a shorter trajectory
}

std::string DescribeNumbers(const std::vector<int64_t>& numbers, size_t num_rows) {
  return FormatText("traj.txt: %zu rows for %zu images with the numbers %lld to %lld", num_rows,
                    numbers.size(), static_cast<long long>(numbers.front()),
                    static_cast<long long>(numbers.back()));
}

// Row i is the pose of frame i, or of image i if there are as many rows as images whose numbers
// reach beyond the rows. The numbers of frames are those in the names of the colour images.
void ReadPoses(const std::string& path, const NamedImages& color, SequenceIndex* index) {
  const std::vector<std::optional<Rigid3>> poses = ReadPoseRows(path);
  const std::vector<int64_t>& numbers = color.numbers;
  const RowOrder order = OrderOfRows(numbers, poses.size());
  if (order == RowOrder::kUnknown) {
    index->warnings.push_back(DescribeNumbers(numbers, poses.size()) +
                              "; the ground truth is left out; write a row for every image, or for "
                              "every frame number from 0 on");
    return;
  }
  std::map<std::string, double> stamps;
  for (const SequenceEntry& entry : index->entries) stamps[entry.color_path] = entry.timestamp;
  for (size_t row = 0; row < poses.size(); ++row) {
    if (!poses[row]) continue;
    double stamp = static_cast<double>(row) / kDefaultFrameRate;
    if (order == RowOrder::kImages) {
      const auto found = stamps.find(color.paths[row]);
      if (found == stamps.end()) continue;  // an image without depth
      stamp = found->second;
    }
    index->ground_truth.push_back({stamp, *poses[row]});
  }
  if (order == RowOrder::kImages) {
    index->warnings.push_back(DescribeNumbers(numbers, poses.size()) +
                              "; the poses are assigned to the images in their order");
  } else if (!numbers.empty() && numbers.back() >= static_cast<int64_t>(poses.size())) {
    index->warnings.push_back(DescribeNumbers(numbers, poses.size()) +
                              "; the last images have no ground truth");
  }
}

SequenceIndex Read(const std::string& directory) {
  SequenceIndex index;
  const std::vector<std::string> color = ListImages(PathIn(directory, "results"), "frame");
  PairByName(color, ListImages(PathIn(directory, "results"), "depth"), &index);
  index.preset = "replica";
  const std::string poses = PathIn(directory, "traj.txt");
  if (HasEntry(poses)) ReadPoses(poses, ReadImageNames(color), &index);
  ReadFolderCamera(directory, &index);
  ReadThirdPartyCamera(directory, {6553.5}, &index);
  return index;
}

}  // namespace

const SequenceFormat kReplicaFormat = {"replica",
                                       "results/frameXXXXXX.jpg, results/depthXXXXXX.png, traj.txt",
                                       "renderer of Replica for NICE-SLAM", Recognises, Read};

}  // namespace msc_vo
