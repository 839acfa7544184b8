// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

/// An image named by a row of rgb.txt or depth.txt, or by half a row of an association file.
struct ListedImage {
  double stamp = 0.0;  ///< in the unit of the list
  std::string path;
  std::string origin;  ///< for messages, "rgb.txt:12"
  int index = -1;      ///< position in SequenceIndex::container, if there is one
};

/// Returns the position of the first image, in the order of the list, at which the clock was set
/// back: a list that ascends otherwise goes back there into a time that it has passed, so that
/// sorting it would interleave two passages. None if the list ascends, has fewer than ten images,
/// or is not in order anyway, and where sorting does no harm: for lists that were joined in the
/// wrong order, displaced images, and rows that are repeated.
std::optional<size_t> FindClockStep(const std::vector<ListedImage>& images);

/// The colour and depth images of a folder.
struct ImageLists {
  std::vector<ListedImage> color;
  std::vector<ListedImage> depth;
};

/// Reads "time path" rows, whose paths are relative to the folder of the list, in order of time.
/// Backslashes in paths are read as slashes. Adds a warning if the rows are in another order, or
/// the stamps lost digits or zeros. Throws std::runtime_error naming file and line if a row does
/// not fit or the clock was set back, see FindClockStep().
std::vector<ListedImage> ReadImageList(const std::string& path, std::vector<std::string>* warnings);

/// Reads an association file with "time path time path" rows, colour and depth in either order. The
/// images of a row are at the same position of both lists, see IsDepthFirst(). Adds a warning if
/// the stamps lost digits or zeros.
/// Throws std::runtime_error naming file, line and fix if a row does not fit or the clock of the
/// colour images was set back.
ImageLists ReadAssociations(const std::string& path, std::vector<std::string>* warnings);

/// Tests whether the rows "time path time path" name the depth image first. The first row whose
/// images can both be read decides, by their channels and bit depth; if these are alike, or none of
/// the first ten rows can be read, the word "depth" in the paths of the first row, or else its only
/// image that can be read. `lines` must not be empty.
bool IsDepthFirst(const std::vector<TextLine>& lines);

/// Returns the path of the association file of a folder; empty if there is none.
std::string FindAssociations(const std::string& directory);

}  // namespace msc_vo
