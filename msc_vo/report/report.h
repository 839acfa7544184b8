// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/plane_extent.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/report/frame_view.h"

namespace msc_vo {

/// Tracking status of a frame, from best to worst.
enum class ReportStatus { kTracked, kWeak, kDropped, kUnreadable, kPredicted, kLost };

/// ReportFrame::submap of a frame without a pose.
constexpr int kNoSubMapNumber = -1;

/// Largest standard deviations of the camera in its own frame.
struct CameraSigma {
  double rotation_deg = 0.0;
  double position = 0.0;  ///< metres
};

/// One frame of the run.
struct ReportFrame {
  double timestamp = 0.0;  ///< seconds
  ReportStatus status = ReportStatus::kTracked;
  bool is_keyframe = false;
  /// Number of the submap whose world the pose refers to; kNoSubMapNumber: there is no pose. Poses
  /// of different submaps have an unknown transform between them.
  int submap = 0;
  Rigid3 world_from_cam;                 ///< metres; aligned to the ground truth, if there is one
  std::optional<double> position_error;  ///< metres; nullopt without ground truth at this time
  /// Largest standard deviation of the pose relative to the map nearby, degrees and metres; nullopt
  /// without an estimate.
  std::optional<double> rotation_sigma_deg;
  std::optional<double> translation_sigma;
  std::optional<CameraSigma> world_sigma;     ///< relative to the origin of the world
  std::optional<CameraSigma> odometry_sigma;  ///< of the pose by odometry alone
  int num_points = 0;                         ///< features in the image
  int num_lines = 0;
  int num_inlier_points = 0;  ///< matches with map points that agree with the pose
  int num_inlier_lines = 0;
  std::vector<double> stage_ms;  ///< milliseconds, one for each of ReportData::stages
  double tracking_ms = 0.0;      ///< milliseconds from the decoded image to the pose
  double mapping_ms = 0.0;       ///< of the keyframe step that this frame caused; 0 without one
};

struct ReportGroundTruthPose {
  double timestamp = 0.0;                              ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, camera centre in world
};

/// A line of the final map, in the same frame as the poses.
struct ReportLine {
  LineSegment3 segment;  ///< metres, world
  int axis = -1;         ///< Manhattan axis 0, 1, 2 that it is parallel to; -1: none
};

/// A plane of the final map, in the same frame as the poses.
struct ReportPlane {
  PlaneExtent extent;  ///< metres, world
  int axis = -1;       ///< Manhattan axis 0, 1, 2 that its normal is parallel to; -1: none
};

/// Keyframes of an earlier run that built the map.
struct ReportSession {
  std::string name;                        ///< empty: several runs, or unknown
  std::vector<Eigen::Vector3d> positions;  ///< metres, camera centres in world, in order of time
};

/// The map as it is drawn, in the same frame as the poses.
struct ReportMap {
  std::vector<ReportLine> lines;
  std::vector<ReportPlane> planes;
  std::vector<Eigen::Vector3d> points;                ///< metres, world
  std::optional<Eigen::Quaterniond> world_from_axes;  ///< Manhattan axes, if there are any
  std::vector<ReportSession> sessions;                ///< earlier runs, in order; may be empty
};

/// A closed loop: two frames show the same place.
struct ReportLoop {
  int frame = 0;      ///< index in ReportData::frames of the frame that completed the loop
  int reference = 0;  ///< index of the older frame
};

/// A stage of tracking.
struct ReportStage {
  std::string name;
  /// False for a part of another stage that may run in parallel to other parts. Such stages do not
  /// add up; they are listed in the table of times, but not stacked in the plot.
  bool is_stacked = true;
};

/// A key figure: "APE RMSE", "12.3 mm", "after SE(3) alignment". Short values are shown as tiles.
struct ReportNumber {
  std::string name;
  std::string value;
  std::string note;  ///< may be empty
};

/// Contents of the report.
struct ReportData {
  std::string title;         ///< "living-noisy"
  std::string version;       ///< "msc_vo 0.1.0"
  std::string command_line;  ///< as typed
  std::string options_text;  ///< all options in effect, as YAML
  std::vector<ReportNumber> numbers;
  std::vector<ReportNumber> self_calibration;       ///< what was estimated beside poses and map
  std::vector<ReportStage> stages;                  ///< of tracking, in order of time
  std::vector<ReportFrame> frames;                  ///< in order of time
  std::vector<ReportGroundTruthPose> ground_truth;  ///< in order of time; may be empty
  std::string truth_name = "ground truth";          ///< what `ground_truth` is called
  std::vector<ReportLoop> loops;                    ///< in order of time; may be empty
  /// Camera centres before any loop was closed, metres, one per frame or none at all; not finite
  /// where the path has a gap.
  std::vector<Eigen::Vector3d> odometry;
  /// Index of the first frame that was found in the map of earlier runs; nullopt: none.
  std::optional<int> found_frame;
  std::optional<PlaceView> place;  ///< where it was found; nullopt: not known
  ReportMap map;                   ///< at the end of the run
  std::vector<FrameView> views;    ///< by ascending frame; may be empty
  PinholeCamera camera;
  /// Up direction of an upright camera: -y, because y points down, or y if fy is negative. The mean
  /// over all frames is the up direction of the views.
  Eigen::Vector3d up_in_cam{0.0, -1.0, 0.0};
};

/// Whether pages show the run in three dimensions: three.js was found when msc_vo was built.
bool HasViewer();

/// Writes a self-contained HTML page that loads nothing, for light and dark screens and for print.
/// A script shows the run and draws the plots over time; numbers, tables and the top and side view
/// of the trajectory need none. The page takes about 1 MB, 0.3 kB per frame and 4/3 of the bytes of
/// the views. Values that are not finite are skipped. Throws std::invalid_argument, naming the
/// frame, if the size of a `stage_ms` differs from that of `stages`.
void WriteReport(const ReportData& data, std::ostream& out);

}  // namespace msc_vo
