// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// From good to bad.
enum class ReportStatus { kTracked, kWeak, kDropped, kUnreadable, kPredicted, kLost };

/// One frame of the run.
struct ReportFrame {
  double timestamp = 0.0;  ///< seconds
  ReportStatus status = ReportStatus::kTracked;
  bool is_keyframe = false;
  Rigid3 world_from_cam;                 ///< metres; aligned to the truth, if there is one
  std::optional<double> position_error;  ///< metres from the truth; none: no truth at this time
  int num_points = 0;                    ///< features in the image
  int num_lines = 0;
  int num_inlier_points = 0;  ///< matched with the map and consistent with the pose
  int num_inlier_lines = 0;
  std::vector<double> stage_ms;  ///< milliseconds, one for each of ReportData::stages
  double tracking_ms = 0.0;  ///< milliseconds from the decoded image to the pose, stages included
  double mapping_ms = 0.0;   ///< of the keyframe step that this frame caused; 0: caused none
};

struct ReportTruthPose {
  double timestamp = 0.0;                              ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, camera centre in world
};

/// A line of the final map, in the same frame as the poses.
struct ReportLine {
  LineSegment3 segment;  ///< metres, world
  int axis = -1;         ///< Manhattan axis 0, 1, 2 that it belongs to; -1: none
};

/// A stage of tracking.
struct ReportStage {
  std::string name;
  /// False: a part of another stage that may run beside other parts, so that their sum says
  /// nothing; it stands in the table of times, not in the stack of stages.
  bool is_stacked = true;
};

/// A key number: "APE RMSE" "12.3 mm" "after SE(3) alignment". Short values are shown large.
struct ReportNumber {
  std::string name;
  std::string value;
  std::string note;  ///< may be empty
};

/// Everything that the report shows; plain data, filled by the command that made the run.
struct ReportData {
  std::string title;         // "living-noisy"
  std::string version;       // "msc_vo 0.1.0"
  std::string command_line;  ///< as typed
  std::string options_text;  ///< all options that were in effect, as YAML
  std::vector<ReportNumber> numbers;
  std::vector<ReportStage> stages;     ///< of tracking, in order of time
  std::vector<ReportFrame> frames;     ///< in order of time
  std::vector<ReportTruthPose> truth;  ///< in order of time; empty: no truth
  std::vector<ReportLine> lines;
  /// Which way is up in an upright camera: against y, as y points down; along y if fy is negative.
  /// The mean over all frames tells the top view from the side view.
  Eigen::Vector3d up_in_cam{0.0, -1.0, 0.0};
};

/// Writes one self-contained HTML page: style and plots (SVG) inside, no scripts, nothing loaded
/// from elsewhere; for light and dark screens and for paper. Long series are thinned to what the
/// plots can show, so that 5000 frames stay below 2 MB. Values that are not finite are left out.
/// Throws std::invalid_argument, naming the frame, if a `stage_ms` does not fit `stages`.
void WriteReport(const ReportData& data, std::ostream& out);

}  // namespace msc_vo
