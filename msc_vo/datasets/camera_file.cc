// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Reads the line of the intrinsics.
Calibration ParseIntrinsicsLine(const TextLine& line) {
  const std::vector<double> v = ParseNumbers(line);
  if (v.size() != 7 && v.size() != 12) {
    line.Fail(std::string("expected 7 or 12 numbers ") + kCameraFileFormat + ", found " +
              std::to_string(v.size()));
  }
  const std::optional<int> width = WholeNumber(v[4]);
  const std::optional<int> height = WholeNumber(v[5]);
  if (!width || !height) {
    line.Fail(std::string("width and height must be whole numbers; expected ") + kCameraFileFormat);
  }
  Calibration calibration;
  calibration.camera = {v[0], v[1], v[2], v[3], *width, *height};
  calibration.depth_scale = v[6];
  for (size_t i = 7; i < v.size(); ++i) calibration.distortion.k[i - 7] = v[i];
  calibration.origin = line.file;
  std::string error;
  if (!calibration.IsValid(&error)) line.Fail(error + "; expected " + kCameraFileFormat);
  return calibration;
}

// Reads a lens line 'NAME MODEL COEFFICIENTS', with the coefficients in OpenCV's order.
LensDistortion ParseLensLine(TextLine line) {
  const std::string name = line.fields[0];
  const std::string example = "'" + name + " fisheye k1 k2 k3 k4'";
  if (line.fields.size() < 2) line.Fail("expected a lens, such as " + example);
  const std::optional<LensModel> model = LensModelFromName(line.fields[1]);
  if (!model) {
    line.Fail("unknown lens model '" + line.fields[1] + "'; known: " + LensModelNames());
  }
  line.fields.erase(line.fields.begin(), line.fields.begin() + 2);
  const std::vector<double> k = ParseNumbers(line);
  const size_t expected = LensCoefficientNames(*model).size();
  if (k.size() != expected) {
    line.Fail("expected the " + std::to_string(expected) + " coefficients " +
              LensCoefficientList(*model) + " of the lens model " + LensModelName(*model) +
              ", found " + std::to_string(k.size()));
  }
  LensDistortion lens;
  lens.model = *model;
  std::copy(k.begin(), k.end(), lens.k.begin());
  return lens;
}

// Reads a line 'NAME VALUE'; `unit` names the value in the message.
double ParseValueLine(const TextLine& line, const std::string& unit) {
  const std::optional<double> value =
      line.fields.size() == 2 ? ParseNumber(line.fields[1]) : std::nullopt;
  if (!value || !std::isfinite(*value)) {
    line.Fail("expected '" + line.fields[0] + " " + unit + "'");
  }
  return *value;
}

// Reads the lines of the lens and of the field of view, which may come in any order.
void ParseLens(const std::vector<TextLine>& lines, Calibration* calibration) {
  const TextLine *lens_line = nullptr, *view_line = nullptr;
  for (size_t i = 1; i < lines.size(); ++i) {
    const std::string& name = lines[i].fields[0];
    if (name != "lens" && name != "field_of_view") continue;
    (name == "lens" ? lens_line : view_line) = &lines[i];
  }
  if (lens_line != nullptr) {
    if (lines[0].fields.size() > 7) {
      lens_line->Fail("the first line gives a lens, too; remove its coefficients k1 k2 p1 p2 k3");
    }
    calibration->distortion = ParseLensLine(*lens_line);
  }
  if (view_line != nullptr) calibration->field_of_view = ParseValueLine(*view_line, "DEGREES");
  if (lens_line == nullptr && view_line == nullptr) return;
  std::string error;
  if (calibration->field_of_view && !IsValidFieldOfView(*calibration->field_of_view, &error)) {
    view_line->Fail(error);
  }
  calibration->SetUndistorted();
  if (!calibration->IsValid(&error)) (lens_line != nullptr ? lens_line : view_line)->Fail(error);
}

// Reads the line of the depth sensor.
DepthSensor ParseDepthSensorLine(const TextLine& line) {
  std::string names;
  for (const DepthSensor sensor : {DepthSensor::kStructuredLight, DepthSensor::kTimeOfFlight,
                                   DepthSensor::kStereo, DepthSensor::kLidar}) {
    if (line.fields.size() == 2 && line.fields[1] == ToString(sensor)) return sensor;
    names += std::string(names.empty() ? "" : "|") + ToString(sensor);
  }
  line.Fail("expected 'depth_sensor " + names + "'");
}

// Reads the line of the depth camera.
void ParseDepthCameraLine(TextLine line, Calibration* calibration) {
  line.fields.erase(line.fields.begin());
  const std::vector<double> v = ParseNumbers(line);
  if (v.size() != 9 && v.size() != 13) {
    line.Fail(std::string("expected 9 or 13 numbers in ") + kDepthCameraFormat + ", found " +
              std::to_string(v.size()));
  }
  const std::optional<int> width = WholeNumber(v[4]);
  const std::optional<int> height = WholeNumber(v[5]);
  if (!width || !height) {
    line.Fail(std::string("width and height must be whole numbers; expected ") +
              kDepthCameraFormat);
  }
  DepthCamera depth_camera;
  depth_camera.camera = {v[0], v[1], v[2], v[3], *width, *height};
  depth_camera.depth_from_color.translation() = Eigen::Vector3d(v[6], v[7], v[8]);
  if (v.size() == 13) {
    const std::optional<Eigen::Quaterniond> rotation =
        NormalizedQuaternion({v.begin() + 9, v.end()});
    if (!rotation) line.Fail("the quaternion qx qy qz qw must have length 1");
    depth_camera.depth_from_color.rotation() = *rotation;
  }
  calibration->depth_camera = depth_camera;
}

// Reads the lines that describe the depth camera further.
void ParseDepthCameraDetails(const std::vector<TextLine>& lines, Calibration* calibration) {
  for (const TextLine& line : lines) {
    const std::string& name = line.fields[0];
    if (name != "depth_lens" && name != "inverse_depth_offset") continue;
    if (!calibration->depth_camera) {
      line.Fail(name + " needs the line " + kDepthCameraFormat);
    }
    if (name == "depth_lens") {
      calibration->depth_camera->distortion = ParseLensLine(line);
    } else {
      calibration->depth_camera->inverse_depth_offset = ParseValueLine(line, "1/METRES");
    }
    std::string error;
    if (!calibration->IsValid(&error)) line.Fail(error);
  }
}

// Reads a line after that of the intrinsics.
void ParseOptionalLine(const TextLine& line, Calibration* calibration) {
  const std::string& name = line.fields[0];
  if (name == "readout_time") {
    calibration->readout_time = ParseValueLine(line, "SECONDS");
    calibration->readout_origin = line.file;
  } else if (name == "depth_camera") {
    ParseDepthCameraLine(line, calibration);
  } else if (name == "depth_sensor") {
    calibration->depth_sensor = ParseDepthSensorLine(line);
  } else if (name != "lens" && name != "field_of_view" && name != "depth_lens" &&
             name != "inverse_depth_offset") {
    line.Fail(std::string("expected 'readout_time SECONDS', ") + kDepthCameraFormat +
              ", 'lens MODEL COEFFICIENTS', 'field_of_view DEGREES', 'depth_lens MODEL "
              "COEFFICIENTS', 'inverse_depth_offset 1/METRES', 'depth_sensor NAME' or nothing "
              "after the line " +
              kCameraFileFormat);
  }
  std::string error;
  if (!calibration->IsValid(&error)) line.Fail(error);
}

// Throws std::runtime_error if two lines after the first one begin with the same word.
void RefuseRepeatedLines(const std::vector<TextLine>& lines) {
  std::set<std::string> names;
  for (size_t i = 1; i < lines.size(); ++i) {
    const std::string& name = lines[i].fields[0];
    if (!names.insert(name).second) lines[i].Fail("a second line " + name + "; remove it");
  }
}

// The numbers, a blank before each.
std::string FormatNumbers(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += " " + FormatNumber(number);
  return text;
}

std::string FormatIntrinsics(const PinholeCamera& camera) {
  return FormatNumber(camera.fx) + FormatNumbers({camera.fy, camera.cx, camera.cy}) +
         FormatText(" %d %d", camera.width, camera.height);
}

// The model and its coefficients.
std::string FormatLens(const LensDistortion& lens) {
  return LensModelName(lens.model) + FormatNumbers(lens.Coefficients());
}

}  // namespace

Calibration ReadCameraFile(const std::string& path) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": is empty; expected one line " + kCameraFileFormat);
  }
  Calibration calibration = ParseIntrinsicsLine(lines[0]);
  RefuseRepeatedLines(lines);
  ParseLens(lines, &calibration);
  for (size_t i = 1; i < lines.size(); ++i) ParseOptionalLine(lines[i], &calibration);
  ParseDepthCameraDetails(lines, &calibration);
  return calibration;
}

std::string FormatCameraFile(const Calibration& calibration, const std::string& comment) {
  const LensDistortion& lens = calibration.distortion;
  const bool has_lens_line = lens.model != LensModel::kRadialTangential;
  std::string text =
      FormatIntrinsics(calibration.Recorded()) + FormatNumbers({calibration.depth_scale});
  if (!lens.IsZero() && !has_lens_line) text += FormatNumbers(lens.Coefficients());
  text += "\n";
  if (has_lens_line) text += "lens " + FormatLens(lens) + "\n";
  if (calibration.field_of_view) {
    text += "field_of_view" + FormatNumbers({*calibration.field_of_view}) + "\n";
  }
  if (calibration.readout_time) {
    text += "readout_time" + FormatNumbers({*calibration.readout_time}) + "\n";
  }
  if (calibration.depth_camera) {
    const Rigid3& transform = calibration.depth_camera->depth_from_color;
    const Eigen::Vector3d t = transform.translation();
    const Eigen::Quaterniond q(transform.rotation());
    text += "depth_camera " + FormatIntrinsics(calibration.depth_camera->camera) +
            FormatNumbers({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) + "\n";
    const LensDistortion& depth_lens = calibration.depth_camera->distortion;
    if (!depth_lens.IsZero()) text += "depth_lens " + FormatLens(depth_lens) + "\n";
    const double offset = calibration.depth_camera->inverse_depth_offset;
    if (offset != 0.0) text += "inverse_depth_offset" + FormatNumbers({offset}) + "\n";
  }
  if (calibration.depth_sensor != DepthSensor::kAuto) {
    text += std::string("depth_sensor ") + ToString(calibration.depth_sensor) + "\n";
  }
  // Numbers come first, for readers that do not skip comments.
  return text + "# fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]\n# " + comment + "\n";
}

}  // namespace msc_vo
