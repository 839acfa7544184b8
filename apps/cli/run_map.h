// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "msc_vo/map/map_contents.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/odometry/tracking_observer.h"
#include "msc_vo/report/frame_view.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

/// Arguments about a map that outlives the run.
struct MapArguments {
  std::string map;         ///< file that is extended, or created; may be empty
  std::string localize;    ///< file that is only read; may be empty
  bool no_images = false;  ///< leaves the images of the run out of the map
};

/// Declares --map, --no-map-images and --localize.
void AddMapArguments(CLI::App* command, MapArguments* arguments);

/// A name for the session of a run that begins now: the name of its sequence and the time. No other
/// run has it.
std::string NewSessionName(const std::string& sequence);

/// Reads a map that must have keyframes. Throws as LoadMap(), and std::runtime_error if it has
/// none.
MapContents LoadKeyframes(const std::string& path);

/// The map of earlier sessions that a run begins with, and the file that it is saved to while the
/// run is in progress. The clock decides when it is saved, and affects nothing else.
class RunMap {
 public:
  /// `session`: name of the run. `interval`: seconds between saves, longer where saving takes more
  /// than a fiftieth of the time. Opens the file; throws std::runtime_error that names it if it is
  /// no map or is in use. `resumed`: the run continues, its checkpoint contains the map.
  RunMap(const MapArguments& arguments, const std::string& session, double interval, bool resumed);

  bool localizes() const { return !arguments_.localize.empty(); }
  const std::string& localize() const { return arguments_.localize; }
  /// The frame as a run that only localises reports it (KeepLocalizedPose()); other runs: as it is.
  FrameResult Reported(const FrameResult& frame) const {
    return localizes() ? KeepLocalizedPose(num_worlds_, frame) : frame;
  }

  /// Call before the first image, after the run has been restored if it is resumed. Throws
  /// std::runtime_error if another run has written the file since.
  void Begin(Odometry* odometry);
  /// Call with every frame that has been tracked: keeps the image of a keyframe until it is saved
  /// with the map, and finds where the run is in the map of earlier sessions.
  void Add(const TrackedImage& tracked);
  /// The place where the run was found in that map; nullopt if it was not found yet, or the map has
  /// no image of the place.
  const std::optional<PlaceView>& place() const { return place_; }

  /// Call after every image. A map that cannot be saved is a warning: the one before remains.
  void SaveIfDue(Odometry* odometry);
  /// Call at the end. Throws std::runtime_error that names the file if it cannot be written.
  void Save(Odometry* odometry);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(images_, was_found_, place_);
  }

 private:
  void CheckResumable(const MapContents& run) const;
  void FindPlace(const TrackedImage& tracked);
  // The first of the keyframes that has an image in the file, and the image; nullopt: none has.
  std::optional<std::pair<KeyframeId, std::string>> FirstImage(
      const std::vector<KeyframeId>& keyframes) const;

  MapArguments arguments_;
  std::string session_;
  double interval_;
  bool resumed_;
  std::unique_ptr<MapWriter> writer_;  // null if the map is only read
  MapContents earlier_;                // until Begin()
  int num_worlds_ = 0;                 // submaps of the map
  Stopwatch since_saved_;
  double pause_;  // seconds until the next save
  bool has_warned_ = false;
  std::map<KeyframeId, std::string> images_;  // of keyframes that are yet to be saved
  bool was_found_ = false;
  std::optional<PlaceView> place_;
};

}  // namespace msc_vo
