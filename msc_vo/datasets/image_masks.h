// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/image_files/image_file.h"

namespace msc_vo {

struct SequenceEntry;
struct SequenceIndex;

/// Masks of the colour images of a sequence: one image for all of them, or a folder with one for
/// each. A mask belongs to the image of the same name up to the ending, or has the name of the
/// image and an ending of its own ("7.jpg": "7.png" or "7.jpg.png").
class ImageMasks {
 public:
  /// Which pixels of a mask are left out.
  enum class LeftOut {
    kNonZero,  ///< as detectors write them: the numbers of objects, or white
    kZero,     ///< as COLMAP, nerfstudio and OpenCV use them
  };

  /// `path`: an image file or a folder. `entries`: the images, which must have a mask in a folder.
  /// Throws std::runtime_error naming the file or the image and the fix, also if a single mask
  /// leaves out every pixel.
  ImageMasks(const std::string& path, LeftOut left_out, const std::vector<SequenceEntry>& entries);

  /// Returns the mask of a colour image, CV_8UC1, 255 where pixels are left out, of any size of the
  /// shape of `size`. Throws std::runtime_error, naming the file, if it is damaged or has another
  /// shape than the image.
  cv::Mat Read(const std::string& color_path, const ImageSize& size) const;

  const std::string& path() const { return path_; }
  LeftOut left_out() const { return left_out_; }
  /// What decides on the masks: path, number and bytes of the files, meaning of zero.
  const std::string& description() const { return description_; }

 private:
  void ListFolderOfMasks(const std::vector<SequenceEntry>& entries);
  cv::Mat ReadMask(const std::string& path) const;

  std::string path_;
  LeftOut left_out_;
  std::string description_;
  cv::Mat single_;                            // empty: a folder
  std::map<std::string, std::string> files_;  // of a folder, by their names without ending
};

/// Returns a mask (CV_8UC1) for an image of another size: 255 where a pixel overlaps a masked
/// (non-zero) one, else 0.
cv::Mat ScaledMask(const cv::Mat& mask, const cv::Size& size);

/// The masks of a sequence; null if `path` is empty. `zero`: pixels that are zero are left out.
/// Throws as ImageMasks() does, and if a live camera is given a folder.
std::shared_ptr<const ImageMasks> OpenMasks(const std::string& path, bool zero,
                                            const SequenceIndex& index);

}  // namespace msc_vo
