// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "msc_vo/exports/exported_camera.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

/// A sparse model of COLMAP. Ids count from 1 in the order of the vectors.
struct ColmapModel {
  struct Feature {
    Eigen::Vector2d pixel;  ///< in the recorded image
    int point = 0;          ///< index of the point that it observes
  };
  struct Image {
    std::string name;
    Rigid3 cam_from_world;
    int camera = 0;  ///< index
    std::vector<Feature> features;
  };
  struct Track {
    int image = 0;    ///< index
    int feature = 0;  ///< in the image
  };
  struct Point {
    Eigen::Vector3d position;  ///< metres
    double error = 0.0;        ///< mean distance of its features from its projections, pixels
    std::vector<Track> track;
  };
  std::vector<ExportedCamera> cameras;
  std::vector<Image> images;
  std::vector<Point> points;
};

/// Keyframes of a map and the points that two of them or more observe. `name_of` gives the name of
/// the image of a frame.
ColmapModel MakeColmapModel(const Map& map,
                            const std::function<std::string(const Keyframe&)>& name_of);

/// The files of a model, by their names.
struct ModelFile {
  std::string name;
  std::string content;
};
/// Throws std::runtime_error if the name of an image has blanks, at which readers split the lines.
void RequireColmapTextName(const std::string& name);
/// Throws std::runtime_error as RequireColmapTextName().
std::vector<ModelFile> FormatColmapText(const ColmapModel& model);
std::vector<ModelFile> FormatColmapBinary(const ColmapModel& model);

}  // namespace msc_vo
