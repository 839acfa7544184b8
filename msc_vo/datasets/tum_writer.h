// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

/// Writes a sequence folder in TUM layout image by image: rgb/, depth/, rgb.txt, depth.txt,
/// associations.txt, camera.txt, and mask/ if there are masks. Whenever the program ends, the lists
/// name only complete images.
class TumWriter {
 public:
  /// Creates the folder and writes camera.txt. `comment` is one line about the source. Throws
  /// std::runtime_error, naming the folder, if it is not empty or cannot be written, and
  /// std::invalid_argument on an impossible depth scale.
  TumWriter(const std::string& folder, const Calibration& calibration, const std::string& comment);

  /// Writes a pair of images with their times in seconds, which must differ from those before.
  /// Encoded images are written as they are, which must be PNG or JPEG; pixels as PNG. Depth in
  /// metres is converted to the depth scale of the calibration. Throws std::runtime_error naming
  /// the file, for instance because the disk is full; the folder then holds the pairs before.
  /// `mask`: CV_8UC1, of the size of the colour image, not 0: left out; empty: none. It is written
  /// with the name of the colour image, as ImageMasks reads it.
  void Add(double color_time, double depth_time, const StoredImage& color, const StoredImage& depth,
           const cv::Mat& mask = {});

  int num_pairs() const { return num_pairs_; }

 private:
  // A list whose last line is complete even if it cannot be extended.
  class List {
   public:
    List(const std::string& path, const std::string& header);
    void Append(const std::string& line);
    void TruncateTo(size_t size);
    size_t size() const { return size_; }

   private:
    std::string path_;
    GrowingFile file_;
    size_t size_ = 0;
  };

  void AppendLines(const std::string& color_line, const std::string& depth_line);

  std::string folder_;
  double depth_scale_;
  List color_list_;
  List depth_list_;
  List associations_;
  int num_pairs_ = 0;
};

}  // namespace msc_vo
