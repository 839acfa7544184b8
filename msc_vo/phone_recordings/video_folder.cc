// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A video of the colour images and a folder with a depth image for each of them: color.mp4 (colour,
// rgb, video; .mp4, .mov, .mkv, .avi) and depth/. times.txt may give the times, a line for each
// image, or timestamps.txt, which is ignored if it does not fit; camera.txt and groundtruth.txt are
// as in a TUM folder.

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/depth_folder.h"
#include "msc_vo/datasets/folder_camera.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/image_times.h"
#include "msc_vo/datasets/named_images.h"
#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/phone_recordings/phone_formats.h"
#include "msc_vo/phone_recordings/phone_images.h"
#include "msc_vo/phone_recordings/phone_sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// The video of the folder; empty if there is none.
std::string FindVideo(const std::string& directory) {
  std::vector<std::string> names;
  for (const char* name : {"color", "colour", "rgb", "video"}) {
    for (const char* ending : {".mp4", ".mov", ".mkv", ".avi"}) {
      names.push_back(std::string(name) + ending);
    }
  }
  return FirstEntry(directory, names);
}

bool IsVideoFolder(const std::string& directory) {
  return IsFolder(FindDepth(directory, "")) && !FindVideo(directory).empty();
}

std::vector<double> ReadTimes(const std::string& path, size_t num_images) {
  std::vector<double> times = ReadTimesFile(path).seconds;
  if (times.size() != num_images) {
    throw std::runtime_error(path + FormatText(": has %zu times for %zu images; write one line for "
                                               "each image of the video",
                                               times.size(), num_images));
  }
  CheckIntervals(times, path);
  return times;
}

std::vector<double> FindTimes(const std::string& directory, const VideoImages& video,
                              const std::vector<std::string>& depth, SequenceIndex* index) {
  if (const std::string path = FindTimesFile(directory); !path.empty()) {
    try {
      return ReadTimes(path, depth.size());
    } catch (const std::runtime_error& error) {
      // timestamps.txt may be of another stream.
      if (Lowercase(fs::path(path).stem().string()) == "times") throw;
      index->warnings.push_back(error.what() + std::string("; the file is not used"));
    }
  }
  const NamedImages names = ReadImageNames(depth);
  if (names.certainty == NamedTimes::kCertain && names.times.size() == depth.size()) {
    return names.times;
  }
  const double rate = video.FrameRate();
  if (!(rate > 0.0)) {
    throw std::runtime_error(video.path() +
                             ": has no frame rate; write times.txt with the time of each image");
  }
  index->warnings.push_back(
      FormatText("the times of the images follow from the frame rate of the video, %g per second; "
                 "times.txt may give them",
                 rate));
  index->has_assumed_times = true;
  std::vector<double> times;
  for (size_t i = 0; i < depth.size(); ++i) times.push_back(static_cast<double>(i) / rate);
  return times;
}

SequenceIndex ReadVideoFolder(const std::string& directory, const PhoneOptions& options) {
  SequenceIndex index;
  const std::string path = FindVideo(directory);
  const std::vector<std::string> depth = ListImages(FindDepth(directory, "", &index.warnings));
  if (path.empty() || depth.empty()) {
    throw std::runtime_error(directory +
                             ": needs a video, such as color.mp4, and a depth image for each of "
                             "its images in depth/");
  }
  const auto video = std::make_shared<const VideoImages>(path, options.make_video_reader);
  int num_images = 0;
  if (!video->HasImages(static_cast<int>(depth.size()), &num_images)) {
    throw std::runtime_error(path + FormatText(": has %d images, but there are %zu depth images; "
                                               "image k of the video belongs to the k-th depth "
                                               "image: remove those without a partner",
                                               num_images, depth.size()));
  }
  index.num_listed = depth.size();
  const std::vector<double> times = FindTimes(directory, *video, depth, &index);
  std::vector<PhoneImage> images;
  for (size_t i = 0; i < depth.size(); ++i) {
    PhoneImage image;
    image.color_path = path + FormatText("/%06zu", i);
    image.depth_path = depth[i];
    image.video_number = static_cast<int>(i);
    SequenceEntry entry;
    entry.timestamp = times[i];
    entry.color_path = image.color_path;
    entry.depth_path = image.depth_path;
    entry.color_index = entry.depth_index = static_cast<int>(i);
    index.entries.push_back(entry);
    images.push_back(std::move(image));
  }
  index.container = std::make_shared<PhoneImages>(std::move(images), nullptr, video,
                                                  ConfidenceValues(), options.least_confidence);
  ReadFolderCamera(directory, &index);
  index.preset = GuessCameraPreset(directory);
  ReadTumGroundTruth(directory, WholeStamps::kTimes, &index);
  return index;
}

}  // namespace

SequenceFormat VideoFolderFormat(const PhoneOptions& options) {
  return {"video-depth", "color.mp4 (or rgb, video; .mov, .mkv, .avi) and depth/", "",
          IsVideoFolder,
          [options](const std::string& directory) { return ReadVideoFolder(directory, options); }};
}

}  // namespace msc_vo
