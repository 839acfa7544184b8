// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/ros_bag/frame_tree.h"
#include "msc_vo/ros_bag/realsense_camera.h"
#include "msc_vo/sensor/depth_camera.h"

namespace msc_vo {

namespace {

// The transform depth_from_color of the bag; none if it has none, for which `problem` then gives
// the reason.
std::optional<Rigid3> FindDepthFromColor(const BagFile& bag, const TopicPair& topics,
                                         std::string* problem) {
  const auto& [color, depth] = topics;
  try {
    const std::optional<Rigid3> given =
        RealSenseDepthFromColor(bag, color.name, depth.name, problem);
    if (given || !problem->empty()) return given;
    if (color.frame.empty() || depth.frame.empty()) {
      *problem = "the images have no coordinate frame";
      return std::nullopt;
    }
    const std::optional<Rigid3> fixed = FindFixedTransform(bag, depth.frame, color.frame);
    if (!fixed) *problem = "no fixed transforms (/tf_static) connect their coordinate frames";
    return fixed;
  } catch (const std::runtime_error& error) {  // a damaged message
    *problem = error.what();
    return std::nullopt;
  }
}

// Largest difference of the intrinsics of a camera, scaled to the size of `a`, pixels.
double IntrinsicsDifference(const PinholeCamera& a, const PinholeCamera& other) {
  const PinholeCamera b = ScaledCamera(other, {a.width, a.height});
  return std::max(
      {std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
}

// Tests whether depth images show the same pixels as colour images.
bool IsSameView(const PinholeCamera& color, const DepthCamera& depth) {
  constexpr double kPixels = 0.01, kMetres = 1e-6;  // of numbers that were written as text
  return color.width == depth.camera.width && color.height == depth.camera.height &&
         IntrinsicsDifference(color, depth.camera) < kPixels &&
         depth.depth_from_color.translation().norm() < kMetres &&
         depth.depth_from_color.rotation().angularDistance(Eigen::Quaterniond::Identity()) <
             kMetres;
}

DepthCamera DepthCameraAt(const Calibration& calibration, const Rigid3& depth_from_color) {
  DepthCamera camera{calibration.Recorded(), depth_from_color, 0.0, calibration.distortion};
  camera.distortion.recorded.reset();
  return camera;
}

bool HaveDifferentFrames(const TopicPair& topics) {
  const std::string &color = topics.color.frame, &depth = topics.depth.frame;
  return !color.empty() && !depth.empty() && color != depth;
}

// Tests whether the bag says that depth images, which are not registered, are of another camera.
bool AreOfOtherCamera(const TopicPair& topics, const PinholeCamera& color,
                      const std::optional<Calibration>& depth) {
  // Relative to the focal length: 3 pixels at the border of an image of 640.
  constexpr double kTolerance = 0.01;
  return IsRealSenseStream(topics.depth.name) || HaveDifferentFrames(topics) ||
         (depth &&
          IntrinsicsDifference(color, depth->Recorded()) > kTolerance * std::abs(color.fx));
}

// Says that it is not known where the depth camera is.
std::string DescribeUnregistered(const TopicPair& topics, bool has_camera,
                                 const std::string& problem) {
  const auto with_frame = [](const ImageTopic& topic) {
    return topic.name + (topic.frame.empty() ? "" : " (frame " + topic.frame + ")");
  };
  return "the depth images of " + with_frame(topics.depth) + " are taken for " +
         (has_camera ? "those of a camera at the same place as" : "registered to") +
         " the colour images of " + with_frame(topics.color) +
         ", although nothing says so: " + problem +
         "; record registered depth, or /tf_static and both CameraInfo, or give "
         "camera.depth_camera with --camera-file or --set";
}

// The camera of depth images; none if they are registered to the colour images, or are taken for
// it, which has a warning if the bag contradicts.
std::optional<DepthCamera> ReadDepthCamera(const BagFile& bag, const CameraInfos& infos,
                                           const TopicPair& topics, const PinholeCamera& color,
                                           std::string* warning) {
  if (AreRegistered(topics.depth, topics.color)) return std::nullopt;
  std::string problem;
  const std::optional<Calibration> own = infos.Find(topics.depth, &problem);
  std::optional<DepthCamera> camera;
  if (own) {
    const std::optional<Rigid3> place = FindDepthFromColor(bag, topics, &problem);
    camera = DepthCameraAt(*own, place.value_or(Rigid3()));
    if (!camera->IsValid(&problem)) camera = DepthCameraAt(*own, Rigid3());
    if (IsSameView(color, *camera)) camera.reset();
  }
  if (problem.empty()) return camera;
  if (!AreOfOtherCamera(topics, color, own)) return std::nullopt;
  *warning = DescribeUnregistered(topics, camera.has_value(), problem);
  return camera;
}

}  // namespace

std::optional<Calibration> ReadCalibration(const BagFile& bag, const CameraInfos& infos,
                                           const TopicPair& topics, CameraWarnings* warnings) {
  std::string problem, problem_of_depth;
  std::optional<Calibration> color = infos.Find(topics.color, &problem);
  if (color) {
    color->depth_camera = ReadDepthCamera(bag, infos, topics, color->Recorded(), &warnings->depth);
    return color;
  }
  const bool are_registered = AreRegistered(topics.depth, topics.color);
  std::optional<Calibration> depth = infos.Find(topics.depth, &problem_of_depth);
  if (depth && are_registered) return depth;
  if (depth) {
    problem += "; " + depth->origin +
               " of the depth images is used, which is wrong unless these are registered to "
               "colour; --camera-file gives the right camera";
  } else if (!are_registered && HaveDifferentFrames(topics)) {
    warnings->depth =
        DescribeUnregistered(topics, false, "the bag does not give the colour camera");
  }
  if (!infos.IsEmpty()) warnings->color = problem;
  return depth;
}

}  // namespace msc_vo
