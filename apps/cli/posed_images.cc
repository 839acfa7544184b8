// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/posed_images.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "apps/cli/command_log.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/evaluation/association.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

std::vector<TimedPose> ReadUsable(const std::string& path, bool all_poses) {
  std::vector<TimedPose> poses;
  const std::vector<TimedPose> all = ReadTrajectory(path);
  if (all.empty()) throw std::runtime_error(path + ": has no poses; is it the right file?");
  for (const TimedPose& pose : all) {
    if (pose.is_estimated || all_poses) poses.push_back(pose);
  }
  if (poses.empty()) {
    throw std::runtime_error(path + ": has no estimated pose; --all-poses of msc_vo export and " +
                             "fuse takes the others, too");
  }
  return poses;
}

void KeepLargestWorld(const std::string& path, std::vector<TimedPose>* poses) {
  std::map<int, int> num_poses;
  for (const TimedPose& pose : *poses) ++num_poses[pose.world];
  if (num_poses.size() < 2) return;
  const auto largest =
      std::max_element(num_poses.begin(), num_poses.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const size_t num_all = poses->size();
  EraseIf(poses, [&](const TimedPose& pose) { return pose.world != largest->first; });
  PrintWarning(
      FormatText("%s: the segments of the run are not all joined; %zu of %zu poses are in the "
                 "world of segment %d and are used",
                 path.c_str(), poses->size(), num_all, largest->first));
}

template <typename Item>
std::vector<Item> EveryNth(const std::vector<Item>& items, int n) {
  std::vector<Item> selected;
  for (size_t i = 0; i < items.size(); i += static_cast<size_t>(n)) selected.push_back(items[i]);
  return selected;
}

}  // namespace

std::vector<TimedPose> ReadPoses(const std::string& path, const PoseSelection& selection) {
  return EveryNth(ReadUsable(path, selection.all_poses), selection.every);
}

std::vector<TimedPose> ReadPosesOfOneWorld(const std::string& path,
                                           const PoseSelection& selection) {
  std::vector<TimedPose> poses = ReadUsable(path, selection.all_poses);
  KeepLargestWorld(path, &poses);
  return EveryNth(poses, selection.every);
}

std::vector<PosedImage> FindPosedImages(const std::string& path, const PoseSelection& selection,
                                        const RgbdDecoder& decoder) {
  const std::vector<TimedPose> poses = ReadPosesOfOneWorld(path, {1, selection.all_poses});
  const std::vector<double> pose_stamps = TimestampsOf(poses, &TimedPose::timestamp);
  const std::vector<double> stamps =
      TimestampsOf(decoder.index().entries, &SequenceEntry::timestamp);
  std::vector<PosedImage> images;
  for (const StampMatch& match : AssociateStamps(stamps, pose_stamps, kMaxPoseDelay)) {
    images.push_back({match.reference, poses[static_cast<size_t>(match.query)]});
  }
  if (images.empty()) {
    throw std::runtime_error(path + ": none of its " + std::to_string(poses.size()) +
                             " poses belongs to an image of " + decoder.index().directory +
                             "; are the time stamps those of the sequence?");
  }
  return EveryNth(images, selection.every);
}

}  // namespace msc_vo
