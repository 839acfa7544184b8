// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/checkpoints.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <utility>

#include "apps/cli/command_log.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

std::string CheckpointFolder(const std::string& output) {
  return (std::filesystem::path(output) / "checkpoint").string();
}

std::string RemoveCheckpoint(const std::string& output) {
  const std::string folder = CheckpointFolder(output);
  if (!HasEntry(folder)) return "";
  CheckpointFile(folder).Remove();
  if (!HasEntry(CheckpointFile(folder).path())) return folder;
  PrintWarning(folder + ": cannot be removed, and is of no use any more");
  return "";
}

RunIdentity ReadIdentity(CheckpointFile* file) {
  RunIdentity identity;
  file->ReadDescription([&identity](BinaryReader& archive) { archive(identity); });
  return identity;
}

Checkpoints::Checkpoints(CheckpointFile file, RunIdentity identity, double interval,
                         const CheckpointedParts& parts)
    : file_(std::move(file)), identity_(std::move(identity)), interval_(interval), parts_(parts) {}

void Checkpoints::Restore(Odometry* odometry, CostMeter* cost, LoopProgress* progress) {
  file_.ReadState([&](BinaryReader& archive) {
    odometry->Restore(&archive);
    if (parts_.gravity != nullptr) archive(*parts_.gravity);
    RunCost earlier_cost;
    archive(*progress, earlier_cost, *parts_.views);
    cost->AddEarlier(earlier_cost);
  });
  Log().info("resumed at image {} from {}", progress->num_images, file_.path());
  pause_ = interval_;
}

void Checkpoints::SaveIfDue(Odometry* odometry, const CostMeter& cost,
                            const LoopProgress& progress) {
  if (pause_ && since_saved_.Milliseconds() < 1000.0 * *pause_) return;
  if (progress.num_images > progress.num_unreadable) Save(odometry, cost, progress);
}

void Checkpoints::Save(Odometry* odometry, const CostMeter& cost, const LoopProgress& progress) {
  constexpr double kPausePerDuration = 50.0;
  const Stopwatch stopwatch;
  try {
    file_.Save([&](BinaryWriter& archive) { archive(identity_); },
               [&](BinaryWriter& archive) {
                 // Waits for the mapper, which calls the gravity factors.
                 if (!odometry->Save(&archive)) return false;
                 if (parts_.gravity != nullptr) archive(*parts_.gravity);
                 archive(progress, cost.Read(), *parts_.views);
                 return true;
               });
  } catch (const std::exception& error) {
    if (!has_warned_) PrintWarning(std::string("no checkpoint: ") + error.what());
    has_warned_ = true;
  }
  const double seconds = 1e-3 * stopwatch.Milliseconds();
  Log().debug("checkpoint of {} images in {:.1f} ms", progress.num_images, 1e3 * seconds);
  pause_ = interval_ > 0.0 ? std::max(interval_, kPausePerDuration * seconds) : 0.0;
  since_saved_.Restart();
}

}  // namespace msc_vo
