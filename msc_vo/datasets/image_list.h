// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

/// An image named by a row of rgb.txt or depth.txt, or by half a row of an association file.
struct ListedImage {
  double stamp = 0.0;  ///< in the unit of the list
  std::string path;
  std::string origin;  ///< for messages, "rgb.txt:12"
  int index = -1;      ///< position in SequenceIndex::container, if there is one
};

/// The colour and depth images of a folder.
struct ImageLists {
  std::vector<ListedImage> color;
  std::vector<ListedImage> depth;
};

/// Reads "time path" rows, whose paths are relative to the folder of the list, in order of time.
/// Adds a warning if the rows are in another order or the stamps lost digits.
/// Throws std::runtime_error naming file and line if a row does not fit.
std::vector<ListedImage> ReadImageList(const std::string& path, std::vector<std::string>* warnings);

/// Reads an association file with "time path time path" rows, colour and depth in either order. The
/// images of a row are at the same position of both lists. Which column is depth follows from the
/// folder names, or else from the bit depth of the first pair. Adds a warning if the stamps lost
/// digits.
/// Throws std::runtime_error naming file, line and fix if a row does not fit.
ImageLists ReadAssociations(const std::string& path, std::vector<std::string>* warnings);

/// Returns the path of the association file of a folder; empty if there is none.
std::string FindAssociations(const std::string& directory);

}  // namespace msc_vo
