// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/exported_map.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/command_log.h"
#include "apps/cli/exported_images.h"
#include "apps/cli/output_file.h"
#include "apps/cli/recorded_session.h"
#include "apps/cli/run_map.h"
#include "msc_vo/exports/colmap_model.h"
#include "msc_vo/exports/exported_camera.h"
#include "msc_vo/exports/map_export.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// The submap with most keyframes: other programs know one world only.
SavedSubMap LargestSubMap(const std::string& file, MapContents* contents) {
  const auto largest =
      std::max_element(contents->submaps.begin(), contents->submaps.end(),
                       [](const SavedSubMap& a, const SavedSubMap& b) {
                         return a.map.keyframes().size() < b.map.keyframes().size();
                       });
  if (contents->submaps.size() > 1) {
    PrintWarning(FormatText("%s: of %zu submaps, submap %d with %zu keyframes is exported",
                            file.c_str(), contents->submaps.size(), largest->id,
                            largest->map.keyframes().size()));
  }
  return std::move(*largest);
}

// Leaves the keyframes of the session with these images: time stamps of others do not identify
// them.
void KeepSession(const RunExport& arguments, const RgbdDecoder& images, MapContents* contents) {
  const KeyframeRange session =
      FindSession({arguments.map, arguments.sequence.directory, arguments.session, false,
                   "give the sequence of one of them, name its session with --session, or leave "
                   "out --sequence: the images of all sessions are then named by numbers"},
                  *contents, images);
  std::vector<SavedSubMap> kept;
  for (SavedSubMap& submap : contents->submaps) {
    std::vector<KeyframeId> others;
    KeyframeId own = kNoId;
    for (const auto& [id, keyframe] : submap.map.keyframes()) {
      if (session.Contains(id)) {
        own = id;
      } else {
        others.push_back(id);
      }
    }
    if (own == kNoId) continue;
    for (const KeyframeId id : others) submap.map.RemoveKeyframe(id, own);
    kept.push_back(std::move(submap));
  }
  contents->submaps = std::move(kept);
}

// Throws std::runtime_error if the images of a sequence have another size than those that the
// keyframe was recorded with. Keyframes of earlier sessions are expressed in the camera of the
// last.
void CheckImageSize(const Keyframe& keyframe, const RgbdDecoder& decoder) {
  const Frame& frame = *keyframe.frame;
  const ExportedCamera recorded =
      ExportCamera(frame.intrinsics ? *frame.intrinsics : CameraIntrinsics{frame.camera, {}});
  const Calibration& calibration = decoder.calibration();
  const ExportedCamera camera = ExportCamera({calibration.camera, calibration.distortion});
  if (recorded.width == camera.width && recorded.height == camera.height) return;
  throw std::runtime_error(
      FormatText("%s: its images have %d x %d pixels, and that of the keyframe at %.6f s has "
                 "%d x %d; give the sequence of the map, or none: images are then named by numbers",
                 decoder.index().directory.c_str(), camera.width, camera.height, frame.timestamp,
                 recorded.width, recorded.height));
}

std::string NameByNumber(const Keyframe& keyframe) {
  return FormatText("keyframe_%06lld.png", static_cast<long long>(keyframe.id));
}

// Names the image of a keyframe by the sequence.
std::string NameInSequence(const RgbdDecoder& decoder, const Keyframe& keyframe) {
  const std::vector<SequenceEntry>& entries = decoder.index().entries;
  const SequenceEntry& nearest = entries[static_cast<size_t>(NearestEntry(keyframe, entries))];
  if (std::abs(nearest.timestamp - keyframe.frame->timestamp) > kMaxPoseDelay) {
    throw std::runtime_error(FormatText(
        "%s: has no image of the keyframe at %.6f s; give the sequence of the map, or none: "
        "images are then named by numbers",
        decoder.index().directory.c_str(), keyframe.frame->timestamp));
  }
  CheckImageSize(keyframe, decoder);
  return ColmapImageName(decoder.index(), nearest);
}

// The function that names the images of keyframes. With a sequence, leaves its keyframes only.
std::function<std::string(const Keyframe&)> ImageNames(const RunExport& arguments,
                                                       MapContents* contents) {
  if (arguments.sequence.directory.empty()) return NameByNumber;
  const auto decoder = std::make_shared<const RgbdDecoder>(OpenExportedSequence(arguments));
  RequireImageFiles(*decoder);
  KeepSession(arguments, *decoder, contents);
  return [decoder](const Keyframe& keyframe) { return NameInSequence(*decoder, keyframe); };
}

// Throws std::runtime_error if one file of an export may not be replaced.
void CheckFile(const RunExport& arguments, const std::string& file, const OutputKind& kind) {
  RefuseToOverwrite({arguments.map}, file);
  RefuseToReplace(file, kind, {arguments.sequence.directory}, arguments.overwrite);
}

}  // namespace

std::string ColmapImageName(const SequenceIndex& index, const SequenceEntry& entry) {
  return fs::path(entry.color_path).lexically_relative(index.directory).string();
}

void CheckMapExport(const RunExport& arguments) {
  if (arguments.format == "g2o") return CheckFile(arguments, arguments.output, {kG2oMark});
  for (const ModelFile& file : arguments.binary ? FormatColmapBinary({}) : FormatColmapText({})) {
    const std::string header = file.content.substr(0, file.content.find('\n'));
    CheckFile(arguments, PathIn(arguments.output, file.name), {arguments.binary ? "" : header});
  }
  RefuseSequenceFolder(arguments.output);
}

void WriteMapExport(const RunExport& arguments) {
  if (IsFolder(arguments.map)) {
    throw std::runtime_error(arguments.map + ": results of a run have no observations of points; " +
                             "run again with --map home.map, and export home.map");
  }
  CheckMapExport(arguments);
  MapContents contents = LoadKeyframes(arguments.map);
  if (arguments.format == "g2o") {
    const SavedSubMap submap = LargestSubMap(arguments.map, &contents);
    return WriteFile(arguments.output, FormatG2o(submap, contents.loops));
  }
  const auto names = ImageNames(arguments, &contents);
  const ColmapModel model = MakeColmapModel(LargestSubMap(arguments.map, &contents).map, names);
  const std::vector<ModelFile> files =
      arguments.binary ? FormatColmapBinary(model) : FormatColmapText(model);
  MakeFolder(arguments.output);
  for (const ModelFile& file : files) {
    WriteFile(PathIn(arguments.output, file.name), file.content);
  }
}

}  // namespace msc_vo
