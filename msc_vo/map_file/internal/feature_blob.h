// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// The features of a keyframe that observe landmarks, as blobs (docs/map_file.md). The others are
/// left out: a frame is found by landmarks.
struct FeatureBlobs {
  PerKind<std::string> features;
  PerKind<std::string> landmarks;  ///< that the features observe
  std::string depth_ranges;        ///< empty: unknown
};

/// Throws std::invalid_argument if a feature cannot be stored.
FeatureBlobs EncodeFeatures(const Keyframe& keyframe);

/// Appends features and the landmarks that they observe. Throws BlobError if the bytes are not
/// valid.
void DecodeFeatures(std::string_view bytes, std::vector<PointFeature>* points);
void DecodeFeatures(std::string_view bytes, std::vector<LineFeature>* lines);
void DecodeLandmarks(std::string_view bytes, std::vector<LandmarkId>* landmarks);
DepthRanges DecodeDepthRanges(std::string_view bytes);

}  // namespace msc_vo
