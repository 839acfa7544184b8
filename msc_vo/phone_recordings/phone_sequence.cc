// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/phone_sequence.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr double kMillimetres = 1000.0;  // raw units per metre

void CheckCameras(const std::vector<PhoneFrame>& frames, const std::string& origin) {
  const PinholeCamera& first = frames.front().camera;
  for (const PhoneFrame& frame : frames) {
    std::string error;
    if (!frame.camera.IsValid(&error)) {
      throw std::runtime_error(origin + ", " + frame.image.color_path + ": " + error);
    }
    if (frame.camera.width == first.width && frame.camera.height == first.height) continue;
    throw std::runtime_error(frame.image.color_path +
                             FormatText(": is %dx%d, but the first image is %dx%d; put images of "
                                        "one size into a folder of their own",
                                        frame.camera.width, frame.camera.height, first.width,
                                        first.height));
  }
}

void DescribeCamera(const CommonCamera& camera, size_t num_frames, SequenceIndex* index) {
  if (camera.num_resampled() == 0) return;
  index->warnings.push_back(FormatText(
      "the intrinsics change from image to image, by up to %.1f pixels at %.0f pixels of width; %d "
      "of %zu images are resampled to the median camera",
      camera.largest_displacement(), CommonCamera::kReferenceWidth, camera.num_resampled(),
      num_frames));
}

void DescribeConfidence(const PhoneImages& images, const std::vector<PhoneFrame>& frames,
                        DepthConfidence least, SequenceIndex* index) {
  size_t num_without = 0;
  for (const PhoneFrame& frame : frames) num_without += frame.image.confidence_path.empty();
  if (num_without > 0) {
    index->warnings.push_back(FormatText(
        "%zu of %zu depth images have no image of confidence; all of their depths are used",
        num_without, frames.size()));
  }
  if (least == DepthConfidence::kLow || num_without == frames.size()) return;
  const double ratio = images.RemovedDepthRatio();
  if (ratio == 0.0) return;
  index->warnings.push_back(
      FormatText("depths of less than %s confidence are left out, %.1f %% of a sample; "
                 "--min-confidence changes that",
                 ToString(least), 100.0 * ratio));
}

void DescribePoses(const PhoneRecording& recording, SequenceIndex* index) {
  const std::vector<PhoneFrame>& frames = recording.frames;
  const auto damaged = std::find_if(frames.begin(), frames.end(), [](const PhoneFrame& frame) {
    return !frame.world_from_cam.has_value();
  });
  if (damaged != frames.end()) {
    index->warnings.push_back(FormatText(
        "%zu of %zu poses of %s are no rotation and translation and are left out, first that of %s",
        frames.size() - index->ground_truth.size(), frames.size(), recording.poses_by.c_str(),
        damaged->image.color_path.c_str()));
  }
  if (index->ground_truth.empty()) return;
  index->reference = recording.poses_by;
  index->warnings.push_back("the poses of " + recording.poses_by +
                            " are a reference to compare with, not ground truth");
}

}  // namespace

void CheckIntervals(const std::vector<double>& times, const std::string& origin) {
  constexpr double kShortest = 1.0 / 250.0, kLongest = 10.0;
  if (times.size() < 2) return;
  const double interval = MedianInterval(times);
  if (interval >= kShortest && interval <= kLongest) return;
  throw std::runtime_error(origin +
                           FormatText(": the median interval of the images would be %g s, which is "
                                      "none of a camera; correct the unit of the times",
                                      interval));
}

std::optional<Rigid3> PoseFromArkit(const Eigen::Matrix4d& world_from_arkit_camera) {
  Eigen::Matrix4d pose = world_from_arkit_camera;
  pose.middleCols<2>(1) *= -1.0;  // y and z
  return RigidFromMatrix(pose);
}

SequenceIndex MakePhoneSequence(PhoneRecording recording, DepthConfidence least) {
  std::vector<PhoneFrame>& frames = recording.frames;
  SequenceIndex index;
  index.warnings = std::move(recording.warnings);
  index.num_listed = recording.num_listed;
  if (frames.empty()) return index;
  CheckCameras(frames, recording.intrinsics);
  std::vector<double> times;
  std::vector<PinholeCamera> cameras;
  std::vector<PhoneImage> images;
  for (const PhoneFrame& frame : frames) {
    const int i = static_cast<int>(images.size());
    times.push_back(frame.timestamp);
    cameras.push_back(frame.camera);
    images.push_back(frame.image);
    SequenceEntry entry;
    entry.timestamp = frame.timestamp;
    entry.color_path = frame.image.color_path;
    entry.depth_path = frame.image.depth_path;
    entry.color_index = i;
    entry.depth_index = i;
    index.entries.push_back(entry);
    if (frame.world_from_cam) {
      index.ground_truth.push_back({frame.timestamp, *frame.world_from_cam});
    }
  }
  CheckIntervals(times, recording.times);
  const auto camera = std::make_shared<const CommonCamera>(std::move(cameras));
  const auto container = std::make_shared<PhoneImages>(std::move(images), camera, recording.video,
                                                       recording.confidence, least);
  DescribeCamera(*camera, frames.size(), &index);
  DescribeConfidence(*container, frames, least, &index);
  Calibration calibration;
  calibration.camera = camera->camera();
  calibration.depth_scale = kMillimetres;
  calibration.depth_sensor = DepthSensor::kLidar;
  calibration.origin = recording.intrinsics;
  index.calibration = calibration;
  index.container = container;
  index.is_same_view = true;
  DescribePoses(recording, &index);
  return index;
}

}  // namespace msc_vo
