// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// Bytes of the largest image that a map file takes for a keyframe.
constexpr size_t kMaxMapImageBytes = size_t{64} << 10;

/// Returns the image of a keyframe as the bytes of a JPEG file; empty: none is known.
using KeyframeImageSource = std::function<std::string(KeyframeId)>;

/// The images of the keyframes in a map file, which are read one at a time.
class MapImages {
 public:
  /// Opens a map without loading it. Throws as LoadMap().
  explicit MapImages(const std::string& path);
  MapImages(MapImages&&) noexcept;
  MapImages& operator=(MapImages&&) noexcept;
  ~MapImages();

  /// Ids of the keyframes that have an image, ascending. Throws as LoadMap().
  std::vector<KeyframeId> Keyframes() const;
  /// The image of a keyframe as the bytes of a JPEG file; empty if it has none. Throws as
  /// LoadMap().
  std::string Read(KeyframeId id) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
