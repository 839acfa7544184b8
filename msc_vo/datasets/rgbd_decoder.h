// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

// Turns entry i of a sequence into an RgbdImage. Holds no state that changes: may be used from
// several threads.
class RgbdDecoder {
 public:
  RgbdDecoder(SequenceIndex index, Calibration calibration);

  int size() const { return static_cast<int>(index_.entries.size()); }
  const SequenceIndex& index() const { return index_; }
  const Calibration& calibration() const { return calibration_; }

  // Decodes entry i, 0 <= i < size(): colour to grey, depth to metres (0: no measurement), colour
  // scaled down if the index says so. The id is i.
  // Throws std::runtime_error naming the file, the line that named it and the fix if a file is
  // missing, damaged, of another size than the camera, or of the wrong bit depth.
  RgbdImage Decode(int i) const;

 private:
  SequenceIndex index_;
  Calibration calibration_;
};

}  // namespace msc_vo
