// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/report/report.h"

namespace msc_vo {

// The data of the interactive page as JSON, which web/run_model.js reads. Numbers of frames,
// features and the map are base64 of little-endian arrays.

/// The data block of a report. The text is safe inside of a <script> element.
std::string FormatRunJson(const ReportData& data);

/// The data block of a live page, without frames. `run`: identifies the run, so that a page notices
/// that another one uses its port.
std::string FormatLiveRunJson(const std::string& run, const ReportData& data);

/// What has changed since a live page asked last.
struct RunUpdate {
  std::string run;
  std::string state;                ///< "running", "paused", "finished"
  double speed = 0.0;               ///< times the pace of the time stamps; 0: as fast as possible
  bool can_pause = true;            ///< false in real time
  int num_processed = 0;            ///< frames
  int num_total = 0;                ///< frames of the sequence
  double start = 0.0;               ///< seconds, time stamp of the first frame
  int first_frame = 0;              ///< index of frames[0]
  bool has_more = false;            ///< there are frames after these
  int map_version = -1;             ///< of the newest map
  const ReportMap* map = nullptr;   ///< null: the page has it
  const FrameView* view = nullptr;  ///< null: the page has it
  std::vector<ReportFrame> frames;
  /// The first frames of the run, which the page has, if a loop or a join of two maps has moved
  /// them since; else empty.
  std::vector<ReportFrame> moved_frames;
  // Sent with the map:
  std::vector<ReportLoop> loops;   ///< so far
  std::optional<int> found_frame;  ///< as ReportData::found_frame
  std::optional<PlaceView> place;  ///< as ReportData::place
};

/// The answer to a live page. Throws std::invalid_argument if the sizes of ReportFrame::stage_ms
/// differ.
std::string FormatRunUpdate(const RunUpdate& update);

}  // namespace msc_vo
