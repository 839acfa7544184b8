// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/run_json.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <nlohmann/json.hpp>

#include "msc_vo/report/base64.h"
#include "msc_vo/report/trajectory_view.h"

namespace msc_vo {

namespace {

using Json = nlohmann::ordered_json;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
// Bounds on the size of the page; maps of rooms are far below.
constexpr size_t kMaxLines = 20'000;
constexpr size_t kMaxPoints = 50'000;
// Positions of features are stored in eighths of a pixel (PIXEL_SCALE in web/frame_panel.js).
constexpr float kPixelScale = 8.0F;
constexpr uint8_t kNoAxis = 3;
constexpr uint16_t kNoSubMap = std::numeric_limits<uint16_t>::max();

uint16_t ToCount(int count) {
  return static_cast<uint16_t>(std::clamp<int>(count, 0, std::numeric_limits<uint16_t>::max()));
}

uint16_t ToSubpixel(float pixel) {
  constexpr float kMax = std::numeric_limits<uint16_t>::max();
  return static_cast<uint16_t>(std::lround(std::clamp(kPixelScale * pixel, 0.0F, kMax)));
}

void Append(const Eigen::Vector3d& x, std::vector<float>* values) {
  for (const double coordinate : x) values->push_back(static_cast<float>(coordinate));
}

void Append(const Rigid3& pose, std::vector<float>* values) {
  Append(Eigen::Vector3d(pose.translation()), values);
  const Eigen::Vector4d quaternion = pose.rotation().coeffs();
  for (const double q : quaternion) values->push_back(static_cast<float>(q));
}

uint16_t ToSubMap(int number) {
  return number >= 0 && number < kNoSubMap ? static_cast<uint16_t>(number) : kNoSubMap;
}

uint8_t ToAxis(int axis) {
  return axis >= 0 && axis < kNoAxis ? static_cast<uint8_t>(axis) : kNoAxis;
}

float ToFloat(const std::optional<double>& value) {
  return value ? static_cast<float>(*value) : kNone;
}

// Of `size` elements, every how many'th is kept.
size_t StrideFor(size_t size, size_t max_size) {
  return std::max<size_t>(1, (size + max_size - 1) / max_size);
}

// The columns of FRAME_COLUMNS in web/run_model.js.
Json FramesToJson(const std::vector<ReportFrame>& frames, int first, double start) {
  std::vector<float> time, pose, sigma, error, stage_ms, tracking_ms, mapping_ms;
  std::vector<uint8_t> status, keyframe;
  std::vector<uint16_t> counts, submap;
  for (const ReportFrame& frame : frames) {
    time.push_back(static_cast<float>(frame.timestamp - start));
    Append(frame.world_from_cam, &pose);
    submap.push_back(ToSubMap(frame.submap));
    status.push_back(static_cast<uint8_t>(frame.status));
    keyframe.push_back(frame.is_keyframe ? 1 : 0);
    for (const int count :
         {frame.num_points, frame.num_lines, frame.num_inlier_points, frame.num_inlier_lines}) {
      counts.push_back(ToCount(count));
    }
    sigma.insert(sigma.end(),
                 {ToFloat(frame.rotation_sigma_deg), ToFloat(frame.translation_sigma)});
    for (const auto& camera : {frame.world_sigma, frame.odometry_sigma}) {
      sigma.push_back(camera ? static_cast<float>(camera->rotation_deg) : kNone);
      sigma.push_back(camera ? static_cast<float>(camera->position) : kNone);
    }
    error.push_back(ToFloat(frame.position_error));
    for (const double ms : frame.stage_ms) stage_ms.push_back(static_cast<float>(ms));
    tracking_ms.push_back(static_cast<float>(frame.tracking_ms));
    mapping_ms.push_back(static_cast<float>(frame.mapping_ms));
  }
  return {{"first", first},
          {"time", EncodeBase64(time)},
          {"pose", EncodeBase64(pose)},
          {"status", EncodeBase64(status)},
          {"keyframe", EncodeBase64(keyframe)},
          {"submap", EncodeBase64(submap)},
          {"counts", EncodeBase64(counts)},
          {"sigma", EncodeBase64(sigma)},
          {"error", EncodeBase64(error)},
          {"stage_ms", EncodeBase64(stage_ms)},
          {"tracking_ms", EncodeBase64(tracking_ms)},
          {"mapping_ms", EncodeBase64(mapping_ms)}};
}

Json RotationToJson(const Eigen::Matrix3d& rotation) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rows.push_back(rotation(row, column));
  }
  return rows;
}

// Pairs of frame indices. Loops with a frame that is not among the frames are left out.
Json LoopsToJson(const std::vector<ReportLoop>& loops, int num_frames) {
  Json json = Json::array();
  for (const ReportLoop& loop : loops) {
    if (std::min(loop.frame, loop.reference) < 0) continue;
    if (std::max(loop.frame, loop.reference) >= num_frames) continue;
    json.push_back({loop.frame, loop.reference});
  }
  return json;
}

Json SessionsToJson(const std::vector<ReportSession>& sessions) {
  Json json = Json::array();
  for (const ReportSession& session : sessions) {
    std::vector<float> positions;
    for (const Eigen::Vector3d& position : session.positions) Append(position, &positions);
    json.push_back({{"name", session.name}, {"positions", EncodeBase64(positions)}});
  }
  return json;
}

// The poses of the first frames.
Json PosesToJson(const std::vector<ReportFrame>& frames) {
  std::vector<float> pose;
  std::vector<uint16_t> submap;
  for (const ReportFrame& frame : frames) {
    Append(frame.world_from_cam, &pose);
    submap.push_back(ToSubMap(frame.submap));
  }
  return {{"pose", EncodeBase64(pose)}, {"submap", EncodeBase64(submap)}};
}

// Triangles of the polygons, and the axis of each triangle.
Json PlanesToJson(const std::vector<ReportPlane>& planes) {
  std::vector<float> triangles;
  std::vector<uint8_t> axes;
  for (const ReportPlane& plane : planes) {
    const bool is_finite =
        std::all_of(plane.extent.begin(), plane.extent.end(),
                    [](const Eigen::Vector3d& vertex) { return vertex.allFinite(); });
    if (!is_finite) continue;
    for (size_t i = 2; i < plane.extent.size(); ++i) {
      for (const size_t corner : {size_t{0}, i - 1, i}) Append(plane.extent[corner], &triangles);
      axes.push_back(ToAxis(plane.axis));
    }
  }
  return {{"triangles", EncodeBase64(triangles)}, {"axes", EncodeBase64(axes)}};
}

Json MapToJson(const ReportMap& map) {
  std::vector<float> lines, points;
  std::vector<uint8_t> axes;
  for (size_t i = 0; i < map.lines.size(); i += StrideFor(map.lines.size(), kMaxLines)) {
    const ReportLine& line = map.lines[i];
    if (!line.segment.start.allFinite() || !line.segment.end.allFinite()) continue;
    Append(line.segment.start, &lines);
    Append(line.segment.end, &lines);
    axes.push_back(ToAxis(line.axis));
  }
  for (size_t i = 0; i < map.points.size(); i += StrideFor(map.points.size(), kMaxPoints)) {
    if (map.points[i].allFinite()) Append(map.points[i], &points);
  }
  Json json = {{"lines", EncodeBase64(lines)},
               {"line_axes", EncodeBase64(axes)},
               {"points", EncodeBase64(points)}};
  if (!map.planes.empty()) json["planes"] = PlanesToJson(map.planes);
  if (!map.sessions.empty()) json["sessions"] = SessionsToJson(map.sessions);
  if (map.world_from_axes) json["axes"] = RotationToJson(map.world_from_axes->toRotationMatrix());
  return json;
}

Json ViewToJson(const FrameView& view) {
  std::vector<uint16_t> points, lines;
  std::vector<uint8_t> point_depth, line_colors;
  for (const ViewedPoint& point : view.features.points) {
    points.insert(points.end(), {ToSubpixel(point.pixel.x()), ToSubpixel(point.pixel.y())});
    point_depth.push_back(point.has_depth ? 1 : 0);
  }
  for (const ViewedLine& line : view.features.lines) {
    lines.insert(lines.end(), {ToSubpixel(line.start.x()), ToSubpixel(line.start.y()),
                               ToSubpixel(line.end.x()), ToSubpixel(line.end.y())});
    line_colors.push_back(static_cast<uint8_t>(line.color));
  }
  return {{"frame", view.frame},
          {"jpeg", EncodeBase64(view.jpeg.data(), view.jpeg.size())},
          {"points", EncodeBase64(points)},
          {"point_depth", EncodeBase64(point_depth)},
          {"lines", EncodeBase64(lines)},
          {"line_colors", EncodeBase64(line_colors)}};
}

Json PlaceToJson(const PlaceView& place) {
  return {{"frame", place.frame},
          {"jpeg", EncodeBase64(place.jpeg.data(), place.jpeg.size())},
          {"keyframe", place.keyframe},
          {"keyframe_jpeg", EncodeBase64(place.keyframe_jpeg.data(), place.keyframe_jpeg.size())}};
}

// What both kinds of pages begin with.
Json HeadToJson(const ReportData& data, const Eigen::Matrix3d& view_from_world) {
  const PinholeCamera& camera = data.camera;
  Json stages = Json::array();
  for (const ReportStage& stage : data.stages) {
    stages.push_back({{"name", stage.name}, {"stacked", stage.is_stacked}});
  }
  return {{"camera",
           {{"fx", camera.fx},
            {"fy", camera.fy},
            {"cx", camera.cx},
            {"cy", camera.cy},
            {"width", camera.width},
            {"height", camera.height}}},
          {"view", RotationToJson(view_from_world)},
          {"stages", stages}};
}

// One line. "<" is escaped, because "</script" and "<!--" would end or change a script element.
std::string Dump(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

}  // namespace

std::string FormatRunJson(const ReportData& data) {
  Json json = HeadToJson(data, ChooseTrajectoryView(data).view_from_world);
  if (data.frames.empty()) return Dump(json);
  const double start = data.frames.front().timestamp;
  json["start"] = start;
  json["frames"] = FramesToJson(data.frames, 0, start);
  std::vector<float> truth;
  for (const ReportGroundTruthPose& pose : data.ground_truth) {
    if (pose.position.allFinite()) Append(pose.position, &truth);
  }
  json["ground_truth"] = EncodeBase64(truth);
  json["truth_name"] = data.truth_name;
  json["loops"] = LoopsToJson(data.loops, static_cast<int>(data.frames.size()));
  if (!data.odometry.empty()) {
    std::vector<float> positions;
    for (const Eigen::Vector3d& position : data.odometry) Append(position, &positions);
    json["odometry"] = EncodeBase64(positions);
  }
  if (data.found_frame) json["found"] = *data.found_frame;
  if (data.place) json["place"] = PlaceToJson(*data.place);
  json["map"] = MapToJson(data.map);
  json["views"] = Json::array();
  for (const FrameView& view : data.views) json["views"].push_back(ViewToJson(view));
  return Dump(json);
}

std::string FormatLiveRunJson(const std::string& run, const ReportData& data) {
  // The first camera is taken to be upright; Manhattan axes correct that.
  Eigen::Matrix3d view_from_world;
  view_from_world.row(0) = Eigen::RowVector3d::UnitX();
  view_from_world.row(2) = data.up_in_cam.normalized().transpose();
  view_from_world.row(1) = view_from_world.row(2).cross(view_from_world.row(0));
  Json json = HeadToJson(data, view_from_world);
  json["live"] = true;
  json["run"] = run;
  return Dump(json);
}

std::string FormatRunUpdate(const RunUpdate& update) {
  Json json = {{"run", update.run},
               {"state", update.state},
               {"speed", update.speed},
               {"can_pause", update.can_pause},
               {"count", update.num_processed},
               {"total", update.num_total},
               {"more", update.has_more},
               {"map_version", update.map_version}};
  if (!update.frames.empty()) {
    json["frames"] = FramesToJson(update.frames, update.first_frame, update.start);
  }
  if (!update.moved_frames.empty()) json["moved"] = PosesToJson(update.moved_frames);
  if (update.map != nullptr) {
    json["map"] = MapToJson(*update.map);
    json["loops"] = LoopsToJson(update.loops, update.num_processed);
    if (update.found_frame) json["found"] = *update.found_frame;
    if (update.place) json["place"] = PlaceToJson(*update.place);
  }
  if (update.view != nullptr) json["views"] = Json::array({ViewToJson(*update.view)});
  return Dump(json);
}

}  // namespace msc_vo
