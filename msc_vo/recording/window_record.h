// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// The kinds of record in a window file. Each has a keyword, a comment, the vector of WindowData
// that it records, and a function that passes the fields of one item to a visitor of text_record.h.
// To record more of WindowData, add a kind to ForEachWindowRecord().

struct CameraRecord {
  static constexpr const char* kKeyword = "camera";
  static constexpr const char* kComment = "pinhole, pixels; exactly one";
  template <typename Camera, typename Fields>
  static void Visit(Camera& camera, Fields& fields) {
    fields.Number("FX", camera.fx);
    fields.Number("FY", camera.fy);
    fields.Number("CX", camera.cx);
    fields.Number("CY", camera.cy);
    fields.Integer("WIDTH", camera.width);
    fields.Integer("HEIGHT", camera.height);
  }
};

/// Passes the seven parameters of a Rigid3 to a visitor: unit quaternion, translation.
template <typename Pose, typename Fields>
void VisitPose(Pose& pose, Fields& fields) {
  constexpr const char* kNames[] = {"QX", "QY", "QZ", "QW", "TX", "TY", "TZ"};
  for (int i = 0; i < 7; ++i) fields.Number(kNames[i], pose.params[i]);
}

struct KeyframeRecord {
  static constexpr const char* kKeyword = "keyframe";
  static constexpr const char* kComment = "cam_from_world: unit quaternion, translation in metres";
  static constexpr auto kItems = &WindowData::keyframes;
  template <typename Keyframe, typename Fields>
  static void Visit(Keyframe& keyframe, Fields& fields) {
    fields.Integer("ID", keyframe.id);
    fields.Flag("free", "fixed", keyframe.fixed);
    VisitPose(keyframe.cam_from_world, fields);
  }
};

struct PointRecord {
  static constexpr const char* kKeyword = "point";
  static constexpr const char* kComment =
      "position in the world, metres; noise factor of its observations' sigmas";
  static constexpr auto kItems = &WindowData::points;
  template <typename Point, typename Fields>
  static void Visit(Point& point, Fields& fields) {
    fields.Integer("ID", point.id);
    fields.Flag("free", "fixed", point.fixed);
    fields.Number("X", point.position[0]);
    fields.Number("Y", point.position[1]);
    fields.Number("Z", point.position[2]);
    fields.OptionalNumber("NOISE", point.noise);
  }
};

struct LineRecord {
  static constexpr const char* kKeyword = "line";
  static constexpr const char* kComment =
      "end points in the world, metres; noise factor of its observations' sigmas; metres by which "
      "its depths are measured too far";
  static constexpr auto kItems = &WindowData::lines;
  template <typename Line, typename Fields>
  static void Visit(Line& line, Fields& fields) {
    fields.Integer("ID", line.id);
    fields.Flag("free", "fixed", line.fixed);
    constexpr const char* kNames[2][3] = {{"SX", "SY", "SZ"}, {"EX", "EY", "EZ"}};
    for (int i = 0; i < 3; ++i) fields.Number(kNames[0][i], line.segment.start[i]);
    for (int i = 0; i < 3; ++i) fields.Number(kNames[1][i], line.segment.end[i]);
    fields.OptionalNumber("NOISE", line.noise);
    fields.OptionalNumber("DEPTH_OFFSET", line.depth_offset);
  }
};

struct PointObservationRecord {
  static constexpr const char* kKeyword = "point_observation";
  static constexpr const char* kComment =
      "undistorted pixel, its sigma; inverse depth (1/metres, 0: none), its sigma";
  static constexpr auto kItems = &WindowData::point_observations;
  template <typename Observation, typename Fields>
  static void Visit(Observation& observation, Fields& fields) {
    fields.Integer("KEYFRAME", observation.keyframe);
    fields.Integer("POINT", observation.point);
    fields.Number("U", observation.pixel[0]);
    fields.Number("V", observation.pixel[1]);
    fields.Number("SIGMA", observation.sigma);
    fields.Number("INVERSE_DEPTH", observation.inverse_depth);
    fields.Number("INVERSE_DEPTH_SIGMA", observation.inverse_depth_sigma);
    fields.Flag("kept", "rejected", observation.rejected);
    fields.OptionalFlag("depth_rejected", observation.depth_rejected);
  }
};

struct LineObservationRecord {
  static constexpr const char* kKeyword = "line_observation";
  static constexpr const char* kComment =
      "end points in undistorted pixels, sigma across the line; inverse depths there (1/metres), "
      "their covariance by rows, inliers of the fit";
  static constexpr auto kItems = &WindowData::line_observations;
  template <typename Observation, typename Fields>
  static void Visit(Observation& observation, Fields& fields) {
    fields.Integer("KEYFRAME", observation.keyframe);
    fields.Integer("LINE", observation.line);
    fields.Number("SU", observation.segment.start[0]);
    fields.Number("SV", observation.segment.start[1]);
    fields.Number("EU", observation.segment.end[0]);
    fields.Number("EV", observation.segment.end[1]);
    fields.Number("SIGMA", observation.sigma);
    fields.Flag("kept", "rejected", observation.rejected);
    fields.Flag("no_depth", "depth", observation.has_depth);
    fields.Number("SW", observation.depth.start);
    fields.Number("EW", observation.depth.end);
    constexpr const char* kNames[2][2] = {{"C00", "C01"}, {"C10", "C11"}};
    for (int row = 0; row < 2; ++row) {
      for (int col = 0; col < 2; ++col) {
        fields.Number(kNames[row][col], observation.depth.covariance(row, col));
      }
    }
    fields.Integer("INLIERS", observation.depth.num_inliers);
    fields.Number("INLIER_RATIO", observation.depth.inlier_ratio);
    fields.OptionalFlag("depth_rejected", observation.depth_rejected);
  }
};

/// Fields of ParallelRecord and PerpendicularRecord.
struct LinePairFields {
  template <typename Pair, typename Fields>
  static void Visit(Pair& pair, Fields& fields) {
    fields.Integer("LINE", pair.a);
    fields.Integer("LINE", pair.b);
    fields.Number("SIGMA", pair.sigma);
    fields.Integer("COUNT", pair.count);
    fields.Flag("kept", "rejected", pair.rejected);
  }
};

struct ParallelRecord : LinePairFields {
  static constexpr const char* kKeyword = "parallel";
  static constexpr const char* kComment =
      "pair of lines; sigma in radians, number of keyframes observing both";
  static constexpr auto kItems = &WindowData::parallel_pairs;
};

struct PerpendicularRecord : LinePairFields {
  static constexpr const char* kKeyword = "perpendicular";
  static constexpr const char* kComment = "as parallel";
  static constexpr auto kItems = &WindowData::perpendicular_pairs;
};

struct AxisAlignmentRecord {
  static constexpr const char* kKeyword = "axis_alignment";
  static constexpr const char* kComment = "line parallel to a unit vector; sigma in radians";
  static constexpr auto kItems = &WindowData::axis_alignments;
  template <typename Alignment, typename Fields>
  static void Visit(Alignment& alignment, Fields& fields) {
    fields.Integer("LINE", alignment.line);
    fields.Number("X", alignment.axis[0]);
    fields.Number("Y", alignment.axis[1]);
    fields.Number("Z", alignment.axis[2]);
    fields.Number("SIGMA", alignment.sigma);
    fields.Flag("kept", "rejected", alignment.rejected);
  }
};

struct PosePriorRecord {
  static constexpr const char* kKeyword = "pose_prior";
  static constexpr const char* kComment =
      "mean of a keyframe's cam_from_world; covariance by rows of rotation vector (radians, camera "
      "frame), then translation (metres)";
  static constexpr auto kItems = &WindowData::pose_priors;
  template <typename Prior, typename Fields>
  static void Visit(Prior& prior, Fields& fields) {
    fields.Integer("KEYFRAME", prior.keyframe);
    VisitPose(prior.cam_from_world, fields);
    for (int row = 0; row < 6; ++row) {
      for (int col = 0; col < 6; ++col) {
        const char name[] = {'C', static_cast<char>('0' + row), static_cast<char>('0' + col), 0};
        fields.Number(name, prior.covariance(row, col));
      }
    }
  }
};

/// Calls `action` with a value of every kind of record except the camera, in the order of the file.
template <typename Action>
void ForEachWindowRecord(const Action& action) {
  action(KeyframeRecord());
  action(PointRecord());
  action(LineRecord());
  action(PointObservationRecord());
  action(LineObservationRecord());
  action(ParallelRecord());
  action(PerpendicularRecord());
  action(AxisAlignmentRecord());
  action(PosePriorRecord());
}

}  // namespace msc_vo
