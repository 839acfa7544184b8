// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/checkpoints.h"

#include <algorithm>
#include <chrono>
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
    archive(*progress, earlier_cost, *parts_.views, *parts_.map);
    cost->AddEarlier(earlier_cost);
  });
  Log().info("resumed at image {} from {}", progress->num_images, file_.path());
  pause_ = interval_;
}

void Checkpoints::SaveIfDue(Odometry* odometry, const CostMeter& cost,
                            const LoopProgress& progress) {
  constexpr double kLongestDelay = 1000.0;  // milliseconds, by a mapper that is never idle
  constexpr uint64_t kMaxNewBytes = uint64_t{2} << 20;  // some 2 ms
  const double delay = since_saved_.Milliseconds() - 1000.0 * pause_.value_or(0.0);
  if (delay < 0.0 || progress.num_images == progress.num_unreadable) return;
  if (!pause_ || interval_ == 0.0) return Save(odometry, cost, progress);
  const bool is_free =
      !commit_.valid() || commit_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (!is_free ||
      (std::min(delay, since_part_.Milliseconds()) < kLongestDelay && odometry->IsMapping())) {
    return;
  }
  Write(odometry, cost, progress, kMaxNewBytes);
}

void Checkpoints::Save(Odometry* odometry, const CostMeter& cost, const LoopProgress& progress) {
  constexpr uint64_t kUnlimited = uint64_t{1} << 40;
  Write(odometry, cost, progress, kUnlimited);
  Wait();
}

void Checkpoints::Wait() {
  if (commit_.valid()) Try([this] { commit_.get(); });
}

template <typename Function>
void Checkpoints::Try(const Function& function) {
  try {
    function();
  } catch (const std::exception& error) {
    if (!has_warned_) PrintWarning(std::string("no checkpoint: ") + error.what());
    has_warned_ = true;
  }
}

void Checkpoints::Write(Odometry* odometry, const CostMeter& cost, const LoopProgress& progress,
                        uint64_t max_new_bytes) {
  constexpr double kPausePerDuration = 50.0;
  const Stopwatch stopwatch;
  Wait();
  bool is_written = true;  // a checkpoint that failed is not due again at once
  Try([&] {
    is_written = file_.Write([&](BinaryWriter& archive) { archive(identity_); },
                             [&](BinaryWriter& archive) {
                               // Waits for the mapper, which calls the gravity factors.
                               if (!odometry->Save(&archive)) return false;
                               if (parts_.gravity != nullptr) archive(*parts_.gravity);
                               archive(progress, cost.Read(), *parts_.views, *parts_.map);
                               return true;
                             },
                             max_new_bytes);
    if (is_written) commit_ = std::async(std::launch::async, [this] { file_.Commit(); });
  });
  const double part = stopwatch.Milliseconds();
  since_part_.Restart();
  duration_ += part;
  longest_part_ = std::max(longest_part_, part);
  if (!is_written) return;
  Log().debug("checkpoint of {} images in {:.1f} ms, at most {:.1f} ms after an image",
              progress.num_images, duration_, longest_part_);
  const double seconds = 1e-3 * duration_;
  pause_ = interval_ > 0.0 ? std::max(interval_, kPausePerDuration * seconds) : 0.0;
  duration_ = longest_part_ = 0.0;
  since_saved_.Restart();
}

}  // namespace msc_vo
