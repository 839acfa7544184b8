// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/replay_views.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "apps/cli/commands.h"
#include "apps/cli/image_feed.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/report/viewer_page.h"
#include "msc_vo/results/report_frame.h"
#include "msc_vo/text/ending.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr int kDefaultPort = 8765;
constexpr int kMaxPort = 65535;
constexpr std::chrono::seconds kLongestWaitForViewers(5);
constexpr char kNoReport[] =
    "<!DOCTYPE html>\n<title>msc_vo</title>\n<p>The run has ended; its report cannot be "
    "read.</p>\n";

// Mean rate of the images, frames per second.
double FrameRate(const std::vector<SequenceEntry>& entries) {
  constexpr double kDefault = 30.0;
  if (entries.size() < 2) return kDefault;
  const double seconds = entries.back().timestamp - entries.front().timestamp;
  const double rate = static_cast<double>(entries.size() - 1) / seconds;
  return seconds > 0.0 ? std::clamp(rate, 1.0, 240.0) : kDefault;
}

// For a URL: an IPv6 address is written in brackets.
std::string UrlHost(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

}  // namespace

void AddViewArguments(CLI::App* command, ViewArguments* arguments) {
  arguments->view =
      command
          ->add_option("--view", arguments->port,
                       "Serve a page that shows the run while it goes on; default port: " +
                           std::to_string(kDefaultPort) + ", 0: any free port")
          ->expected(0, 1)
          ->type_name("[PORT]");
  command
      ->add_option("--view-address", arguments->address,
                   "Address to serve the page at. Others can see and control the run if it is not "
                   "a loopback address")
      ->needs(arguments->view)
      ->capture_default_str();
  command
      ->add_option("--overlay", arguments->overlay,
                   "Write a video of the images with their tracked features")
      ->type_name("FILE.mp4")
      ->check([](const std::string& file) -> std::string {
        const bool is_mp4 = file != ".mp4" && HasEnding(file, ".mp4");
        return is_mp4 ? "" : "the name of the video must end with .mp4, not " + file;
      });
}

std::optional<int> ViewPort(const ViewArguments& arguments) {
  if (arguments.view->empty()) return std::nullopt;
  if (!HasLiveServer()) {
    throw std::runtime_error(
        "this msc_vo was built without the live view; install libcpp-httplib-dev and libjs-three, "
        "and build it again");
  }
  if (arguments.port.empty()) return kDefaultPort;
  const std::optional<double> number = ParseNumber(arguments.port);
  const std::optional<int> port = number ? WholeNumber(*number) : std::nullopt;
  if (!port || *port < 0 || *port > kMaxPort) {
    throw UsageError("--view: " + arguments.port +
                     " is not a port (0 to 65535); put --view behind the sequence, or give "
                     "the port");
  }
  return port;
}

ReplayViews::ReplayViews(const ViewArguments& arguments, const RgbdDecoder& decoder,
                         const Configuration& configuration, int max_frames)
    : collector_(NumFrames(decoder, max_frames), decoder.calibration().distortion) {
  const Calibration& calibration = decoder.calibration();
  if (!arguments.overlay.empty()) {
    video_ = std::make_unique<OverlayVideo>(arguments.overlay, FrameRate(decoder.index().entries),
                                            calibration.camera.width, calibration.camera.height,
                                            calibration.distortion);
  }
  const std::optional<int> port = ViewPort(arguments);
  if (!port) return;
  LiveRunOptions options;
  options.num_frames = NumFrames(decoder, max_frames);
  options.can_pause = !configuration.odometry.snapshots.realtime;
  options.distortion = calibration.distortion;
  StartLive(arguments.address, *port, decoder, options);
}

void ReplayViews::StartLive(const std::string& address, int port, const RgbdDecoder& decoder,
                            const LiveRunOptions& options) {
  ReportData data;
  data.title = SequenceName(decoder.index().directory);
  data.command_line = CommandLine();
  data.stages = ReportStages();
  data.camera = decoder.calibration().camera;
  data.up_in_cam.y() = data.camera.fy < 0.0 ? 1.0 : -1.0;
  run_ = std::make_unique<LiveRun>(options);
  std::ostringstream page;
  WriteLivePage(run_->id(), data, page);
  server_ = std::make_unique<LiveServer>(address, port, page.str(), run_.get());
  const std::string url =
      "http://" + UrlHost(address) + ":" + std::to_string(server_->port()) + "/";
  std::cerr << "live view: " << url << std::endl;
  Log().info("live view: {}", url);
}

void ReplayViews::Show(const TrackedImage& tracked) {
  collector_.Add(tracked);
  if (video_) video_->Add(tracked);
  if (run_) run_->Show(tracked);
}

void ReplayViews::ShowPlace(const PlaceView& place) {
  if (run_) run_->ShowPlace(place);
}

void ReplayViews::Continue(const std::vector<FrameResult>& frames) {
  if (run_) run_->Continue(frames);
}

void ReplayViews::Add(const FrameResult& frame, const std::function<bool()>& is_interrupted) {
  if (run_) run_->Add(frame, is_interrupted);
}

void ReplayViews::Complete(const std::string& report_file) {
  if (run_) {
    run_->Finish(FileProblem(report_file).empty() ? ReadFile(report_file) : kNoReport);
    run_->WaitForViewers(kLongestWaitForViewers);
  }
  if (video_) video_->Finish();
}

std::string ReplayViews::RemoveVideo() {
  const std::string path = PartialVideo();
  video_.reset();
  return path;
}

}  // namespace msc_vo
