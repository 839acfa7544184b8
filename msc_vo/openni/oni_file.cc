// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Recordings of OpenNI2.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/openni/openni_source.h"
#include "msc_vo/openni/openni_stream.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// The frames of one stream in any order, efficient in ascending order. Each reader has a device
// handle of its own, because the streams of one handle share the position in the file. It goes back
// by opening the file again: seeking in OpenNI2 waits forever if it fails.
class OniReader {
 public:
  OniReader(const std::string& path, openni::SensorType sensor, const std::string& what)
      : path_(path), sensor_(sensor), what_(what) {
    Open();
    is_mirrored_ = source_->stream.getMirroringEnabled();
    num_frames_ = source_->device.getPlaybackControl()->getNumberOfFrames(source_->stream);
  }

  int num_frames() const { return num_frames_; }
  const openni::VideoStream& stream() const { return source_->stream; }
  openni::Device& device() { return source_->device; }
  bool is_mirrored() const { return is_mirrored_; }

  // Frame i, from 0.
  openni::VideoFrameRef Read(int i) {
    if (i < next_) Open();
    openni::VideoFrameRef frame;
    for (; next_ <= i; ++next_) {
      frame = ReadNext();
      for (int skipped = 0; !IsNext(frame) && skipped < num_frames_; ++skipped) frame = ReadNext();
      if (next_ == static_cast<int>(indices_.size())) indices_.push_back(frame.getFrameIndex());
    }
    return frame;
  }

 private:
  // Whether the player delivered frame next_: after it was opened, a recording that repeats may
  // start with one of its last frames.
  bool IsNext(const openni::VideoFrameRef& frame) const {
    const int index = frame.getFrameIndex();
    if (next_ < static_cast<int>(indices_.size())) return index == indices_[next_];
    return next_ == 0 ? index <= num_frames_ / 2 : index > indices_.back();
  }

  openni::VideoFrameRef ReadNext() {
    openni::VideoStream* stream = &source_->stream;
    int ready = 0;
    constexpr int kTimeout = 10000;  // milliseconds
    const std::string action = "reading " + what_ + " frame " + std::to_string(next_);
    CheckStatus(openni::OpenNI::waitForAnyStream(&stream, 1, &ready, kTimeout), path_, action);
    openni::VideoFrameRef frame;
    CheckStatus(source_->stream.readFrame(&frame), path_, action);
    return frame;
  }

  // Opens the file before its first frame.
  void Open() {
    source_.reset();  // closes the file
    source_ = std::make_unique<OpenNiStream>();
    next_ = 0;
    CheckStatus(source_->device.open(path_.c_str()), path_, "opening the recording");
    if (!source_->device.hasSensor(sensor_)) {
      throw std::runtime_error(path_ + ": the recording has no " + what_ + " stream");
    }
    CheckStatus(source_->stream.create(source_->device, sensor_), path_,
                "opening the " + what_ + " stream");
    openni::PlaybackControl& playback = *source_->device.getPlaybackControl();
    playback.setRepeatEnabled(true);  // the player waits at the first frame again, not at the end
    playback.setSpeed(-1.0f);         // as fast as frames are read
    CheckStatus(source_->stream.start(), path_, "reading the " + what_ + " stream");
  }

  std::string path_;
  openni::SensorType sensor_;
  std::string what_;
  std::unique_ptr<OpenNiStream> source_;
  bool is_mirrored_ = false;
  int num_frames_ = 0;
  int next_ = 0;
  std::vector<int> indices_;  // of the frames read so far, as recorded
};

class OniContainer : public ImageContainer {
 public:
  explicit OniContainer(const std::string& path)
      : path_(path),
        color_(path, openni::SENSOR_COLOR, "colour"),
        depth_(path, openni::SENSOR_DEPTH, "depth") {}

  StoredImage ReadColor(int index) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {"", ColorOf(color_.Read(index), color_.is_mirrored(), path_)};
  }
  StoredImage ReadDepth(int index) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {"", DepthOf(depth_.Read(index), depth_.is_mirrored(), path_)};
  }

  OniReader& color() { return color_; }
  OniReader& depth() { return depth_; }

 private:
  OpenNiLibrary library_;
  std::string path_;
  mutable std::mutex mutex_;
  mutable OniReader color_;
  mutable OniReader depth_;
};

std::vector<ListedImage> ListFrames(const std::string& name, OniReader* reader) {
  std::vector<ListedImage> images;
  for (int i = 0; i < reader->num_frames(); ++i) {
    images.push_back({TimeOf(reader->Read(i)), name + " " + std::to_string(i), "", i});
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const ListedImage& a, const ListedImage& b) { return a.stamp < b.stamp; });
  return images;
}

}  // namespace

SequenceIndex OpenOniFile(const std::string& path) {
  const std::string problem = FileProblem(path, UINTMAX_MAX);
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
  const auto container = std::make_shared<OniContainer>(path);
  SequenceIndex index;
  index.format = "oni";
  index.recorder = "recorder of OpenNI2";
  index.directory = path;
  index.container = container;
  const ImageLists images{ListFrames(path + ":colour", &container->color()),
                          ListFrames(path + ":depth", &container->depth())};
  PairByTime(images, MaxPairDifference(images), &index);
  OrderEntries(&index);
  RequireMostImages(index, FormatText("%s (%zu colour and %zu depth images)", path.c_str(),
                                      images.color.size(), images.depth.size()));
  index.depth_scale = DepthScaleOf(container->depth().stream());
  index.calibration = NominalCalibration(container->color().stream(), *index.depth_scale, path);
  if (!index.calibration) index.warnings.push_back("the recording has no field of view");
  if (container->color().device().getImageRegistrationMode() !=
      openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR) {
    index.warnings.push_back(
        "the recording does not say that its depth is registered to the colour image; if it is "
        "not, "
        "record again with registration");
  }
  return index;
}

}  // namespace msc_vo
