// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/cli/overlay_video.h"
#include "apps/live/live_run.h"
#include "apps/live/live_server.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/results/frame_view_collector.h"

namespace msc_vo {

/// Arguments of a replay that can be watched.
struct ViewArguments {
  CLI::Option* view = nullptr;  ///< --view
  std::string port;
  std::string address = "127.0.0.1";
  std::string overlay;  ///< file; empty: no video
};

/// Declares --view, --view-address and --overlay.
void AddViewArguments(CLI::App* command, ViewArguments* arguments);

/// The port of --view, nullopt without it. Throws UsageError if it is no port, std::runtime_error
/// if this program has no live view.
std::optional<int> ViewPort(const ViewArguments& arguments);

/// Everything that shows the frames of a replay: views for the report, the live page, the video.
class ReplayViews {
 public:
  /// Starts the server of the live page and prints its address to standard error, and creates the
  /// video, as the arguments say. `max_frames`: 0: all. Throws std::runtime_error if the port or
  /// the file cannot be used. `decoder` must outlive this object.
  ReplayViews(const ViewArguments& arguments, const RgbdDecoder& decoder,
              const Configuration& configuration, int max_frames);

  /// Begins with the frames of a run that is resumed.
  void Continue(const std::vector<FrameResult>& frames);
  /// Takes a tracked frame.
  void Show(const TrackedImage& tracked);
  /// Shows where the run was found in the map of earlier runs.
  void ShowPlace(const PlaceView& place);
  /// Takes the result of every frame, also of those without an image; waits where a viewer has
  /// paused the run. Returns early if `is_interrupted` returns true.
  void Add(const FrameResult& frame, const std::function<bool()>& is_interrupted);

  /// Returns the views for the report; call once, after the last frame.
  std::vector<FrameView> TakeViews() { return collector_.Take(); }

  /// Hands the report (file) to those who watch and waits a moment until they have it; completes
  /// the video. Throws std::runtime_error if the video could not be written.
  void Complete(const std::string& report_file);
  /// The file that the video is written to until it is complete; empty if there is none.
  std::string PartialVideo() const { return video_ ? video_->partial() : ""; }
  /// Gives up the video. Returns the name of the file that is removed; empty if there is none.
  std::string RemoveVideo();

  /// Lists the state for a checkpoint: the views for the report.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(collector_);
  }

 private:
  void StartLive(const std::string& address, int port, const RgbdDecoder& decoder,
                 const LiveRunOptions& options);

  FrameViewCollector collector_;
  std::unique_ptr<OverlayVideo> video_;  // may be null
  std::unique_ptr<LiveRun> run_;         // may be null
  std::unique_ptr<LiveServer> server_;   // of run_; ends before it
};

}  // namespace msc_vo
