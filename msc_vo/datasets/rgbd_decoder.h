// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/rgbd_camera.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/sensor/depth_registration.h"
#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

/// Thrown for an image of a sequence that cannot be used. The message names the file, the line of
/// the list and the fix.
class UnreadableImage : public std::runtime_error {
 public:
  UnreadableImage(int index, const std::string& message)
      : std::runtime_error(message), index_(index) {}

  int index() const { return index_; }  ///< of the entry in the sequence

 private:
  int index_;
};

/// A pair of images as its source stores it.
struct StoredRgbd {
  StoredImage color;
  StoredImage depth;
  cv::Mat mask = {};  ///< CV_8UC1, of the size of the colour image, not 0: left out; empty: none
};

/// Decodes the images of a sequence. Thread-safe: has no mutable state.
class RgbdDecoder {
 public:
  /// `calibration` must be valid; without a depth camera, its image size is also that of the depth
  /// images. Throws std::invalid_argument on an impossible depth scale.
  RgbdDecoder(SequenceIndex index, Calibration calibration);

  int size() const { return static_cast<int>(index_.entries.size()); }
  const SequenceIndex& index() const { return index_; }
  const Calibration& calibration() const { return calibration_; }

  /// What the user should know of the sequence, one sentence each: the warnings of the index, and
  /// clipped depth.
  std::vector<std::string> Warnings() const;

  /// Decodes entry i, 0 <= i < size(): converts colour to grey and depth to metres (0: no
  /// measurement, which includes clipped depth), scales colour down to the size of the camera if
  /// the index requires it, registers depth to colour if the calibration has a depth camera, and
  /// leaves out what the masks of the index leave out.
  /// The id of the image is i. Throws UnreadableImage if a file is missing, damaged, of another
  /// size than the camera, or of the wrong bit depth.
  RgbdImage Decode(int i) const;

  /// Returns entry i for a copy of the sequence: PNG and JPEG as they are stored, unless the index
  /// says that colour has to be scaled or that depth has other values than 0 for no measurement;
  /// otherwise pixels. Depth is whole where the mask leaves it out. Throws UnreadableImage as
  /// Decode() does.
  StoredRgbd ReadForExport(int i) const;

  /// Decodes the depth image of entry i only, before registration: CV_16UC1, raw units, or
  /// CV_32FC1, metres; 0: no measurement. Clipped values are included. Throws UnreadableImage as
  /// Decode() does.
  cv::Mat DecodeRawDepth(int i) const;

  /// Converts a pair of images of SequenceIndex::camera. Throws std::runtime_error if its size is
  /// not that of the camera.
  RgbdImage Convert(const CameraImage& image, int id) const;

 private:
  StoredImage ReadStoredDepth(int i) const;
  StoredRgbd ReadStored(int i) const;
  cv::Mat DecodeDepth(const StoredImage& stored, const SequenceEntry& entry) const;
  RgbdImage DecodePair(int i, const StoredRgbd& stored) const;
  RgbdImage MakeImage(int i, const SequenceEntry& entry, cv::Mat color, const cv::Mat& depth) const;
  void CheckDepthType(const cv::Mat& depth, const SequenceEntry& entry) const;
  void CheckDepthSize(const cv::Mat& depth, const ImageSize& color,
                      const SequenceEntry& entry) const;
  void CheckColorSize(const cv::Mat& color, const cv::Mat& depth, const SequenceEntry& entry) const;

  SequenceIndex index_;
  Calibration calibration_;
  std::shared_ptr<const DepthRegistration> registration_;  // null: depth is registered
};

}  // namespace msc_vo
