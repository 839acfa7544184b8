// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/streamed_pose.h"

#include <cmath>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Json = nlohmann::ordered_json;
using Sigmas = Eigen::Matrix<double, 6, 1>;  // position, rotation

bool HasPose(const FrameResult& frame) {
  return frame.world != kNoSegment &&
         (IsEstimated(frame.status) || frame.status == TrackingStatus::kPredicted);
}

// Of the camera itself, in its own frame.
Sigmas SigmasOf(const Rigid3& pose, const PoseCovariance& covariance) {
  const Sigmas sigmas = CameraCovariance(pose, covariance).diagonal().cwiseSqrt();
  return (Sigmas() << sigmas.tail<3>(), sigmas.head<3>()).finished();
}

// Adding zero makes -0 to 0.
Eigen::Vector3d Position(const Rigid3& pose) { return pose.translation().array() + 0.0; }

// Quaternion with w >= 0, as in trajectories.
Eigen::Vector4d Orientation(const Rigid3& pose) {
  const Eigen::Vector4d xyzw = pose.params.head<4>();
  return (xyzw.w() < 0.0 ? Eigen::Vector4d(-xyzw) : xyzw).array() + 0.0;
}

template <typename Values>
Json ToJson(const Values& values) {
  Json json = Json::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) json.push_back(values[i]);
  return json;
}

Json ToJson(const WorldChange& change) {
  Json json;
  json["old_world"] = change.old_world;
  if (change.new_from_old) {
    json["position"] = ToJson(Position(*change.new_from_old));
    json["orientation"] = ToJson(Orientation(*change.new_from_old));
  }
  return json;
}

void AddSigmas(const std::string& prefix, const Rigid3& pose,
               const std::optional<PoseCovariance>& covariance, Json* json) {
  if (!covariance) return;
  const Sigmas sigmas = SigmasOf(pose, *covariance);
  (*json)[prefix + "sigma_position"] = ToJson(sigmas.head<3>());
  (*json)[prefix + "sigma_rotation"] = ToJson(sigmas.tail<3>());
}

// The camera in a frame, given the inverse pose and its covariances.
Json PoseToJson(const Rigid3& cam_from_frame, const std::optional<PoseCovariance>& covariance) {
  const Rigid3 pose = cam_from_frame.Inverse();
  Json json;
  json["position"] = ToJson(Position(pose));
  json["orientation"] = ToJson(Orientation(pose));
  AddSigmas("", cam_from_frame, covariance, &json);
  return json;
}

std::string FormatJson(const FrameResult& frame) {
  Json json;
  json["frame"] = frame.id;
  json["time"] = frame.timestamp;
  json["status"] = ToString(frame.status);
  json["keyframe"] = frame.is_keyframe;
  if (HasPose(frame)) {
    json["world"] = frame.world;
    json.update(PoseToJson(frame.cam_from_world, frame.covariance));
    AddSigmas("world_", frame.cam_from_world, frame.world_covariance, &json);
    json["odometry"] = PoseToJson(frame.cam_from_odometry, frame.odometry_covariance);
  }
  if (frame.world_changed) json["world_changed"] = ToJson(*frame.world_changed);
  return json.dump() + "\n";
}

}  // namespace

std::string FormatStreamedPose(const FrameResult& frame, StreamedPoseForm form) {
  if (form == StreamedPoseForm::kJson) return FormatJson(frame);
  std::string line = FormatText("%.6f", frame.timestamp);
  Eigen::Matrix<double, 7, 1> pose;
  pose.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (HasPose(frame)) {
    const Rigid3 world_from_cam = frame.cam_from_world.Inverse();
    pose << Position(world_from_cam), Orientation(world_from_cam);
  }
  for (const double value : pose) line += FormatText(" %.9g", value);
  const Sigmas sigmas = HasPose(frame) && frame.covariance
                            ? SigmasOf(frame.cam_from_world, *frame.covariance)
                            : Sigmas::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const double sigma : sigmas) line += FormatText(" %.3g", sigma);
  return line + " " + ToString(frame.status) + FormatText(" %d\n", frame.world);
}

}  // namespace msc_vo
