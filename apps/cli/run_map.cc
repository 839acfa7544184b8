// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/run_map.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/cli/command_log.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/map_file/map_images.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/matching/local_map.h"
#include "msc_vo/results/thumbnail.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

bool AreSame(const MapSession& a, const MapSession& b) {
  return a.first_keyframe == b.first_keyframe && a.name == b.name;
}

// The keyframes of earlier sessions that show most of what the frame shows.
std::vector<KeyframeId> EarlierKeyframes(const TrackedImage& tracked) {
  const Map& map = tracked.map.map;
  std::vector<KeyframeId> keyframes;
  // A run that was not found has no such keyframe in its map, and ids ascend.
  if (map.keyframes().empty() || !map.IsOfEarlierSession(map.keyframes().front().first)) {
    return keyframes;
  }
  for (const Map::Covisible& observer : RankObservers(map, tracked.tracked.matches)) {
    if (map.IsOfEarlierSession(observer.keyframe)) keyframes.push_back(observer.keyframe);
  }
  return keyframes;
}

}  // namespace

void AddMapArguments(CLI::App* command, MapArguments* arguments) {
  const auto has_name = [](const std::string& file) -> std::string {
    return file.empty() ? "the name of the map file is empty" : "";
  };
  CLI::Option* map =
      command
          ->add_option("--map", arguments->map,
                       "Map file: the run finds itself in it and extends it; created if it does "
                       "not exist")
          ->check(has_name)
          ->type_name("FILE");
  command
      ->add_flag("--no-map-images", arguments->no_images,
                 "Leave the small images of the keyframes of this run out of the map")
      ->needs(map);
  command
      ->add_option("--localize", arguments->localize,
                   "Map file that is only read: poses are in its world, from the first image on "
                   "that is found in it")
      ->check(has_name)
      ->type_name("FILE")
      ->excludes(map);
}

std::string NewSessionName(const std::string& sequence) {
  using std::chrono::system_clock;
  const system_clock::time_point now = system_clock::now();
  const std::time_t seconds = system_clock::to_time_t(now);
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", &utc);
  return sequence + FormatText(", %s.%03d UTC", text, static_cast<int>(milliseconds));
}

MapContents LoadKeyframes(const std::string& path) {
  MapContents contents = LoadMap(path);
  const bool has_keyframes =
      std::any_of(contents.submaps.begin(), contents.submaps.end(),
                  [](const SavedSubMap& submap) { return !submap.map.keyframes().empty(); });
  if (!has_keyframes) {
    throw std::runtime_error(path + ": has no keyframes; build a map with msc_vo replay --map");
  }
  return contents;
}

RunMap::RunMap(const MapArguments& arguments, const std::string& session, double interval,
               bool resumed)
    : arguments_(arguments),
      session_(session),
      interval_(interval),
      resumed_(resumed),
      pause_(interval) {
  if (!arguments.map.empty()) {
    // The run had opened it before its first checkpoint.
    if (resumed && !HasEntry(arguments.map)) {
      throw std::runtime_error(arguments.map +
                               ": does not exist, but the run had begun to write this map; restore "
                               "it, or start a new run without --resume");
    }
    writer_ = std::make_unique<MapWriter>(arguments.map);
    earlier_ = writer_->Load();
  } else if (localizes()) {
    earlier_ = LoadKeyframes(arguments.localize);
  }
  num_worlds_ = static_cast<int>(earlier_.submaps.size());
}

// The file must be as this run left it: with the sessions that it began with, and possibly itself.
// The number of its worlds is then also that of the run.
void RunMap::CheckResumable(const MapContents& run) const {
  const std::vector<MapSession>& saved = earlier_.sessions;
  const std::vector<MapSession>& own = run.sessions;
  const bool is_own = (saved.size() == own.size() || saved.size() + 1 == own.size()) &&
                      std::equal(saved.begin(), saved.end(), own.begin(), AreSame);
  if (is_own) return;
  throw std::runtime_error((localizes() ? arguments_.localize : arguments_.map) +
                           ": has been written by another run since; start a new run without "
                           "--resume");
}

void RunMap::Begin(Odometry* odometry) {
  if (!resumed_) {
    if (!earlier_.submaps.empty()) odometry->SetMap(std::exchange(earlier_, {}));
    return;
  }
  const std::optional<MapContents> run = odometry->ShareMaps(session_);
  if (run && (writer_ || localizes())) CheckResumable(*run);
  earlier_ = {};
}

void RunMap::Add(const TrackedImage& tracked) {
  const KeyframeProposal& keyframe = tracked.tracked.keyframe;
  if (writer_ && !arguments_.no_images && keyframe.is_due()) {
    images_[keyframe.id] = EncodeMapImage(tracked.image);
  }
  if (!was_found_) FindPlace(tracked);
}

void RunMap::FindPlace(const TrackedImage& tracked) {
  const std::vector<KeyframeId> keyframes = EarlierKeyframes(tracked);
  if (keyframes.empty()) return;
  was_found_ = true;
  try {
    const auto image = FirstImage(keyframes);
    if (!image) return;
    place_ = {static_cast<int>(tracked.result.id), EncodeMapImage(tracked.image), image->first,
              image->second};
  } catch (const std::exception& error) {
    Log().warn("no image of the place in the map: {}", error.what());
  }
}

std::optional<std::pair<KeyframeId, std::string>> RunMap::FirstImage(
    const std::vector<KeyframeId>& keyframes) const {
  std::optional<MapImages> read_only;
  if (!writer_) read_only.emplace(arguments_.localize);
  for (const KeyframeId id : keyframes) {
    std::string jpeg = writer_ ? writer_->ReadImage(id) : read_only->Read(id);
    if (!jpeg.empty()) return std::pair(id, std::move(jpeg));
  }
  return std::nullopt;
}

void RunMap::Save(Odometry* odometry) {
  if (!writer_) return;
  std::optional<MapContents> contents = odometry->ShareMaps(session_);
  if (!contents) return;
  LeaveOutEmptySession(&*contents);
  if (contents->submaps.empty() || contents->sessions.empty()) return;
  KeyframeId next = 0;
  for (const SavedSubMap& submap : contents->submaps) {
    next = std::max(next, submap.map.next_keyframe());
  }
  writer_->Write(std::move(*contents), [this](KeyframeId id) {
    const auto image = images_.find(id);
    return image != images_.end() ? image->second : std::string();
  });
  // Saved, or of keyframes that the map does not have any more.
  images_.erase(images_.begin(), images_.lower_bound(next));
}

void RunMap::SaveIfDue(Odometry* odometry) {
  constexpr double kPausePerDuration = 50.0;
  if (!writer_ || since_saved_.Milliseconds() < 1000.0 * pause_) return;
  const Stopwatch stopwatch;
  try {
    Save(odometry);
  } catch (const std::exception& error) {
    if (!has_warned_) PrintWarning(std::string("the map is not saved: ") + error.what());
    has_warned_ = true;
  }
  const double milliseconds = stopwatch.Milliseconds();
  Log().debug("map saved in {:.1f} ms", milliseconds);
  pause_ = interval_ > 0.0 ? std::max(interval_, kPausePerDuration * 1e-3 * milliseconds) : 0.0;
  since_saved_.Restart();
}

}  // namespace msc_vo
