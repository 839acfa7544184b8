// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <deque>
#include <memory>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/map/keyframe.h"
#include "msc_vo/sensor/recorded_image.h"

namespace msc_vo {

/// The images of the newest keyframes, in which depths are measured again when their registration
/// is corrected.
class RecordedImages {
 public:
  /// A bound of the memory; the registration of most recordings is decided within as many.
  static constexpr size_t kMaxImages = 16;

  void Add(KeyframeId keyframe, const std::shared_ptr<const RecordedImage>& image);
  void Clear() { images_.clear(); }

  /// The image of a keyframe; null: it is not known.
  std::shared_ptr<const RecordedImage> Find(KeyframeId keyframe) const;

  /// Whether depth edges lie on image edges better with the corrected intrinsics than with the
  /// given ones, see EdgeComparison.
  bool EdgesAgree(const CameraIntrinsics& given, const CameraIntrinsics& corrected) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(images_);
  }

 private:
  struct KeyframeImage {
    KeyframeId keyframe = kNoId;
    std::shared_ptr<const RecordedImage> image;
  };

  std::deque<KeyframeImage> images_;
};

}  // namespace msc_vo
