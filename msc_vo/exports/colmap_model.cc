// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/colmap_model.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "msc_vo/exports/little_endian_bytes.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

CameraIntrinsics IntrinsicsOf(const Frame& frame) {
  return frame.intrinsics ? *frame.intrinsics : CameraIntrinsics{frame.camera, {}};
}

// The index of the camera of a frame, which is added if it is new.
int CameraOf(const Frame& frame, std::vector<ExportedCamera>* cameras) {
  const ExportedCamera camera = ExportCamera(IntrinsicsOf(frame));
  const auto found =
      std::find_if(cameras->begin(), cameras->end(), [&](const ExportedCamera& other) {
        return other.model == camera.model && other.width == camera.width &&
               other.height == camera.height && other.parameters == camera.parameters;
      });
  if (found != cameras->end()) return static_cast<int>(found - cameras->begin());
  cameras->push_back(camera);
  return static_cast<int>(cameras->size()) - 1;
}

// Fields of a binary file of COLMAP.
class Bytes {
 public:
  template <typename Number>
  Bytes& Add(Number value) {
    bytes_.Add(value);
    return *this;
  }
  Bytes& AddCount(size_t count) { return Add(static_cast<uint64_t>(count)); }
  Bytes& AddId(int index) { return Add(static_cast<uint32_t>(index + 1)); }
  Bytes& AddText(const std::string& text) {
    bytes_.Append(text).Add(uint8_t{0});
    return *this;
  }
  const std::string& bytes() const { return bytes_.bytes(); }

 private:
  LittleEndianBytes bytes_;
};

constexpr uint8_t kGray = 128;  // of all points: the map has no colours

std::string FormatCameras(const ColmapModel& model) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (size_t i = 0; i < model.cameras.size(); ++i) {
    const ExportedCamera& camera = model.cameras[i];
    text += FormatText("%zu %s %d %d", i + 1, camera.model.c_str(), camera.width, camera.height);
    for (const double parameter : camera.parameters) text += FormatText(" %.12g", parameter);
    text += "\n";
  }
  return text;
}

std::string FormatImages(const ColmapModel& model) {
  std::string text =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, "
      "POINT3D_ID)\n";
  for (size_t i = 0; i < model.images.size(); ++i) {
    const ColmapModel::Image& image = model.images[i];
    RequireColmapTextName(image.name);
    const Eigen::Vector4d q = image.cam_from_world.rotation().coeffs().array() + 0.0;  // no -0
    const Eigen::Vector3d t = image.cam_from_world.translation().array() + 0.0;
    text += FormatText("%zu %.12g %.12g %.12g %.12g %.12g %.12g %.12g %d %s\n", i + 1, q.w(), q.x(),
                       q.y(), q.z(), t.x(), t.y(), t.z(), image.camera + 1, image.name.c_str());
    for (size_t k = 0; k < image.features.size(); ++k) {
      const ColmapModel::Feature& feature = image.features[k];
      text += FormatText("%s%.6f %.6f %d", k > 0 ? " " : "", feature.pixel.x(), feature.pixel.y(),
                         feature.point + 1);
    }
    text += "\n";
  }
  return text;
}

std::string FormatPoints(const ColmapModel& model) {
  std::string text = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (size_t i = 0; i < model.points.size(); ++i) {
    const ColmapModel::Point& point = model.points[i];
    text += FormatText("%zu %.12g %.12g %.12g %d %d %d %.6g", i + 1, point.position.x(),
                       point.position.y(), point.position.z(), kGray, kGray, kGray, point.error);
    for (const ColmapModel::Track& track : point.track) {
      text += FormatText(" %d %d", track.image + 1, track.feature);
    }
    text += "\n";
  }
  return text;
}

std::string FormatBinaryCameras(const ColmapModel& model) {
  Bytes bytes;
  bytes.AddCount(model.cameras.size());
  for (size_t i = 0; i < model.cameras.size(); ++i) {
    const ExportedCamera& camera = model.cameras[i];
    bytes.AddId(static_cast<int>(i)).Add(static_cast<int32_t>(camera.model_id));
    bytes.AddCount(static_cast<size_t>(camera.width)).AddCount(static_cast<size_t>(camera.height));
    for (const double parameter : camera.parameters) bytes.Add(parameter);
  }
  return bytes.bytes();
}

std::string FormatBinaryImages(const ColmapModel& model) {
  Bytes bytes;
  bytes.AddCount(model.images.size());
  for (size_t i = 0; i < model.images.size(); ++i) {
    const ColmapModel::Image& image = model.images[i];
    const Eigen::Quaterniond q = image.cam_from_world.rotation();
    bytes.AddId(static_cast<int>(i)).Add(q.w()).Add(q.x()).Add(q.y()).Add(q.z());
    for (const double t : image.cam_from_world.translation()) bytes.Add(t);
    bytes.AddId(image.camera).AddText(image.name).AddCount(image.features.size());
    for (const ColmapModel::Feature& feature : image.features) {
      bytes.Add(feature.pixel.x()).Add(feature.pixel.y());
      bytes.AddCount(static_cast<size_t>(feature.point) + 1);
    }
  }
  return bytes.bytes();
}

std::string FormatBinaryPoints(const ColmapModel& model) {
  Bytes bytes;
  bytes.AddCount(model.points.size());
  for (size_t i = 0; i < model.points.size(); ++i) {
    const ColmapModel::Point& point = model.points[i];
    bytes.AddCount(i + 1);
    for (const double x : point.position) bytes.Add(x);
    bytes.Add(kGray).Add(kGray).Add(kGray).Add(point.error).AddCount(point.track.size());
    for (const ColmapModel::Track& track : point.track) {
      bytes.AddId(track.image).Add(static_cast<uint32_t>(track.feature));
    }
  }
  return bytes.bytes();
}

}  // namespace

ColmapModel MakeColmapModel(const Map& map,
                            const std::function<std::string(const Keyframe&)>& name_of) {
  ColmapModel model;
  std::map<KeyframeId, int> images;
  for (const auto& [id, keyframe] : map.keyframes()) {
    images[id] = static_cast<int>(model.images.size());
    model.images.push_back({name_of(keyframe),
                            keyframe.cam_from_world,
                            CameraOf(*keyframe.frame, &model.cameras),
                            {}});
  }
  for (const auto& [id, landmark] : map.points()) {
    if (landmark.observations.size() < 2)
      continue;  // COLMAP knows no depth: tracks have two or more
    const int index = static_cast<int>(model.points.size());
    ColmapModel::Point point;
    point.position = landmark.position;
    for (const Observation& observation : landmark.observations) {
      const Keyframe& keyframe = *map.FindKeyframe(observation.keyframe);
      const Frame& frame = *keyframe.frame;
      const Eigen::Vector2d& pixel = frame.points[static_cast<size_t>(observation.feature)].pixel;
      const Eigen::Vector2d projection =
          frame.camera.Project(keyframe.cam_from_world * landmark.position);
      const Eigen::Vector2d recorded = ExportPixel(IntrinsicsOf(frame), pixel);
      point.error += (ExportPixel(IntrinsicsOf(frame), projection) - recorded).norm();
      const int image = images.at(observation.keyframe);
      std::vector<ColmapModel::Feature>& features =
          model.images[static_cast<size_t>(image)].features;
      point.track.push_back({image, static_cast<int>(features.size())});
      features.push_back({recorded, index});
    }
    point.error /= static_cast<double>(std::max<size_t>(1, point.track.size()));
    model.points.push_back(std::move(point));
  }
  return model;
}

void RequireColmapTextName(const std::string& name) {
  if (name.find_first_of(" \t\r\n") == std::string::npos) return;
  throw std::runtime_error("'" + name +
                           "': the text form of COLMAP has no names with blanks; rename the "
                           "images, or use msc_vo export with --binary");
}

std::vector<ModelFile> FormatColmapText(const ColmapModel& model) {
  return {{"cameras.txt", FormatCameras(model)},
          {"images.txt", FormatImages(model)},
          {"points3D.txt", FormatPoints(model)}};
}

std::vector<ModelFile> FormatColmapBinary(const ColmapModel& model) {
  return {{"cameras.bin", FormatBinaryCameras(model)},
          {"images.bin", FormatBinaryImages(model)},
          {"points3D.bin", FormatBinaryPoints(model)}};
}

}  // namespace msc_vo
