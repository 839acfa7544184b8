// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Stray Scanner: rgb.mp4, depth/XXXXXX.png (millimetres), confidence/XXXXXX.png (0, 1, 2),
// camera_matrix.csv (3x3), odometry.csv with a row for each image: "timestamp, frame, x, y, z, qx,
// qy, qz, qw" and, from newer versions, "fx, fy, cx, cy". Its repository strayrobots/scanner
// documents these files (docs/format.md); its encoder turns the camera's axes to x right, y down, z
// forward.

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/phone_recordings/phone_formats.h"
#include "msc_vo/phone_recordings/phone_sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/named_columns.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

bool IsStrayScanner(const std::string& directory) {
  return HasEntry(PathIn(directory, "odometry.csv")) && HasEntry(PathIn(directory, "rgb.mp4"));
}

// A row of odometry.csv.
struct OdometryRow {
  double timestamp = 0.0;
  int frame = 0;
  std::optional<Rigid3> world_from_cam;
  std::optional<PinholeCamera> camera;  // without its size
};

constexpr ColumnFixes kFixes = {
    "the first line must name the columns timestamp, frame, x, y, z, qx, qy, qz, qw (older "
    "versions of Stray Scanner do not write the times: record again with a newer one)",
    "correct the line, or copy the recording again"};

OdometryRow ReadRow(const NamedColumns& table, size_t row) {
  const auto at = [&](const char* name) { return table.Number(row, table.Column(name)); };
  OdometryRow odometry;
  odometry.timestamp = at("timestamp");
  const std::optional<int> frame = WholeNumber(at("frame"));
  if (!frame || *frame < 0) table.Fail(row, "the frame must be a whole number from 0");
  odometry.frame = *frame;
  const auto rotation = NormalizedQuaternion({at("qx"), at("qy"), at("qz"), at("qw")});
  if (!rotation) table.Fail(row, "qx, qy, qz, qw are no quaternion of length 1");
  odometry.world_from_cam = Rigid3(*rotation, Eigen::Vector3d(at("x"), at("y"), at("z")));
  if (table.Has("fx") && table.Has("fy") && table.Has("cx") && table.Has("cy")) {
    odometry.camera.emplace();
    odometry.camera->fx = at("fx");
    odometry.camera->fy = at("fy");
    odometry.camera->cx = at("cx");
    odometry.camera->cy = at("cy");
  }
  return odometry;
}

std::vector<OdometryRow> ReadOdometry(const std::string& path) {
  const NamedColumns table(path, kFixes);
  std::vector<OdometryRow> rows;
  for (size_t row = 0; row < table.num_rows(); ++row) rows.push_back(ReadRow(table, row));
  if (rows.empty()) throw std::runtime_error(path + ": has no rows; copy the recording again");
  return rows;
}

// Paths of the images of a folder by the numbers that are their names.
std::map<int, std::string> NumberedImages(const std::string& folder) {
  std::map<int, std::string> images;
  for (const std::string& path : ListImages(folder)) {
    const std::optional<double> number = ParseNumber(fs::path(path).stem().string());
    const std::optional<int> whole = number ? WholeNumber(*number) : std::nullopt;
    if (whole) images[*whole] = path;
  }
  return images;
}

std::string Find(const std::map<int, std::string>& images, int number) {
  const auto found = images.find(number);
  return found == images.end() ? "" : found->second;
}

// Image k of the video belongs to row k, unless the frames of the rows count the images of the
// video. Throws std::runtime_error if neither fits the number of its images.
std::vector<int> VideoNumbers(const VideoImages& video, const std::vector<OdometryRow>& rows,
                              const std::string& odometry) {
  std::vector<int> numbers;
  int num_images = 0;
  const int num_rows = static_cast<int>(rows.size());
  const bool is_by_row = video.HasImages(num_rows, &num_images);
  const bool is_by_frame =
      rows.back().frame + 1 == num_images &&
      std::adjacent_find(rows.begin(), rows.end(), [](const OdometryRow& a, const OdometryRow& b) {
        return a.frame >= b.frame;
      }) == rows.end();
  if (!is_by_row && !is_by_frame) {
    throw std::runtime_error(video.path() + " has " + std::to_string(num_images) + " images, but " +
                             odometry + " has " + std::to_string(num_rows) +
                             " rows, one for each image; copy the recording again. If the video "
                             "only ends earlier, remove the last rows");
  }
  for (int i = 0; i < num_rows; ++i) numbers.push_back(is_by_row ? i : rows[i].frame);
  return numbers;
}

PinholeCamera ReadCameraMatrix(const std::string& path) {
  const Eigen::MatrixXd k = ReadMatrix(path, 3, 3);
  PinholeCamera camera;
  camera.fx = k(0, 0);
  camera.fy = k(1, 1);
  camera.cx = k(0, 2);
  camera.cy = k(1, 2);
  return camera;
}

SequenceIndex ReadStrayScanner(const std::string& directory, const PhoneOptions& options) {
  const std::string odometry = PathIn(directory, "odometry.csv");
  const std::vector<OdometryRow> rows = ReadOdometry(odometry);
  const auto depth = NumberedImages(PathIn(directory, "depth"));
  const auto confidence = NumberedImages(PathIn(directory, "confidence"));
  if (depth.empty()) {
    throw std::runtime_error(PathIn(directory, "depth") +
                             ": has no images 000000.png and so on; depth of old versions of Stray "
                             "Scanner (.npy) is not read");
  }
  PhoneRecording recording;
  recording.video =
      std::make_shared<const VideoImages>(PathIn(directory, "rgb.mp4"), options.make_video_reader);
  const std::vector<int> numbers = VideoNumbers(*recording.video, rows, odometry);
  const bool has_own_intrinsics = rows.front().camera.has_value();
  recording.intrinsics = has_own_intrinsics ? odometry : PathIn(directory, "camera_matrix.csv");
  PinholeCamera shared;
  if (!has_own_intrinsics) shared = ReadCameraMatrix(recording.intrinsics);
  const cv::Mat first = recording.video->Read(numbers.front());
  for (size_t i = 0; i < rows.size(); ++i) {
    PhoneFrame frame;
    frame.timestamp = rows[i].timestamp;
    frame.image.video_number = numbers[i];
    frame.image.color_path = PathIn(directory, "rgb.mp4") + FormatText("/%06d", rows[i].frame);
    frame.image.depth_path = Find(depth, rows[i].frame);
    frame.image.confidence_path = Find(confidence, rows[i].frame);
    frame.camera = rows[i].camera.value_or(shared);
    frame.camera.width = first.cols;
    frame.camera.height = first.rows;
    frame.world_from_cam = rows[i].world_from_cam;
    if (!frame.image.depth_path.empty()) recording.frames.push_back(std::move(frame));
  }
  const size_t num_without = rows.size() - recording.frames.size();
  if (num_without > 0) {
    recording.warnings.push_back(FormatText(
        "%zu of %zu images have no depth image and are left out", num_without, rows.size()));
  }
  recording.num_listed = rows.size();
  recording.poses_by = "ARKit";
  recording.times = odometry;
  return MakePhoneSequence(std::move(recording), options.least_confidence);
}

}  // namespace

SequenceFormat StrayScannerFormat(const PhoneOptions& options) {
  return {"stray-scanner",
          "rgb.mp4, odometry.csv, camera_matrix.csv, depth/ and confidence/ of Stray Scanner",
          "Stray Scanner, on an iPhone or iPad with LiDAR", IsStrayScanner,
          [options](const std::string& directory) { return ReadStrayScanner(directory, options); }};
}

}  // namespace msc_vo
