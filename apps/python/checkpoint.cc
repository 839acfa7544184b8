// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/checkpoint.h"

#include <stdexcept>
#include <utility>

#include "msc_vo/config/option_list.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

// Begins the description of checkpoints of this class; those of the command begin otherwise.
constexpr char kKind[] = "checkpoint of msc_vo in Python";

void AddCamera(const std::string& name, const PinholeCamera& camera,
               std::map<std::string, std::string>* facts) {
  std::string text;
  for (const double number : {camera.fx, camera.fy, camera.cx, camera.cy}) {
    text += FormatNumber(number) + " ";
  }
  (*facts)[name] = text + std::to_string(camera.width) + "x" + std::to_string(camera.height);
}

// The message of a file without the option of the command that does not read it.
std::string InPython(std::string message) {
  const std::string option = " without --resume";
  const size_t position = message.find(option);
  return position == std::string::npos ? message : message.erase(position, option.size());
}

}  // namespace

RunCheckpoint::RunCheckpoint(const OdometryOptions& options, const PinholeCamera& camera,
                             const LensDistortion& distortion) {
  OdometryOptions copy = options;
  for (const Option& option : ListOptions(&copy)) {
    if (option.AffectsResults()) facts_["option " + option.path] = FormatOption(option);
  }
  AddCamera("camera", camera, &facts_);
  AddCamera("camera of the recorded images", distortion.Recorded(camera), &facts_);
  std::string lens = LensModelName(distortion.model);
  for (const double k : distortion.Coefficients()) lens += " " + FormatNumber(k);
  facts_["lens"] = lens;
}

void RunCheckpoint::Save(const std::string& folder, Odometry* odometry) {
  if (!file_ || folder != folder_) file_.emplace(folder);
  folder_ = folder;
  bool has_failed_step = false;
  file_->Save(
      [&](BinaryWriter& archive) { archive(std::string(kKind), std::string(kVersion), facts_); },
      [&](BinaryWriter& archive) {
        has_failed_step = !odometry->Save(&archive);
        return !has_failed_step;
      });
  if (has_failed_step) {
    throw std::runtime_error(
        "a step of the mapper has failed: process() or finish() raises its exception, then save() "
        "again");
  }
}

void RunCheckpoint::Restore(const std::string& folder, Odometry* odometry) {
  try {
    Read(folder, odometry);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(InPython(error.what()));
  }
}

void RunCheckpoint::Read(const std::string& folder, Odometry* odometry) {
  CheckpointFile file = CheckpointFile::Open(folder);
  std::string kind, version;
  std::map<std::string, std::string> facts;
  file.ReadDescription([&](BinaryReader& archive) {
    archive(kind);
    if (kind != kKind) throw std::runtime_error("was not written by Odometry.save() in Python");
    archive(version, facts);
  });
  if (version != kVersion) {
    throw std::runtime_error(file.path() + ": was written by msc_vo " + version + ", this is " +
                             kVersion + "; restore it with that version");
  }
  CheckRun(file.path(), facts);
  file.ReadState([&](BinaryReader& archive) { odometry->Restore(&archive); });
  file_ = std::move(file);
  folder_ = folder;
}

void RunCheckpoint::CheckRun(const std::string& path,
                             const std::map<std::string, std::string>& saved) const {
  for (const auto& [name, now] : facts_) {
    const auto then = saved.find(name);
    const std::string value = then == saved.end() ? "" : then->second;
    if (value == now) continue;
    throw std::invalid_argument(path + ": is of another run: " + name + " was '" + value +
                                "' and is '" + now +
                                "' now; give the options and the camera of "
                                "that run");
  }
}

}  // namespace msc_vo
