// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <stdexcept>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

// An image of a sequence that cannot be used. The message names the file, the line that named it
// and the fix.
class UnreadableImage : public std::runtime_error {
 public:
  UnreadableImage(int index, const std::string& message)
      : std::runtime_error(message), index_(index) {}

  int index() const { return index_; }  // of the entry in the sequence

 private:
  int index_;
};

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
  // Throws UnreadableImage if a file is missing, damaged, of another size than the camera, or of
  // the wrong bit depth.
  RgbdImage Decode(int i) const;

 private:
  RgbdImage DecodeFiles(int i) const;

  SequenceIndex index_;
  Calibration calibration_;
};

}  // namespace msc_vo
