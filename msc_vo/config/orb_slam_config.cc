// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/orb_slam_config.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <sstream>
#include <stdexcept>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

struct Value {
  std::string text;
  int line = 0;
};

using Values = std::map<std::string, Value>;

// The values by name; the first one of a name. Adds the lines that repeat a name to `repeated`.
Values ReadValues(const std::string& content, Values* repeated = nullptr) {
  Values values;
  std::istringstream lines(content);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line.resize(std::min(line.size(), line.find('#')));
    const size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string name = Trimmed(line.substr(0, colon));
    const Value value{Trimmed(line.substr(colon + 1)), number};
    if (!values.emplace(name, value).second && repeated != nullptr) repeated->emplace(name, value);
  }
  return values;
}

// Throws std::runtime_error "FILE:LINE: NAME PROBLEM".
[[noreturn]] void Fail(const std::string& path, const Values::value_type& entry,
                       const std::string& problem) {
  throw std::runtime_error(path + ":" + std::to_string(entry.second.line) + ": " + entry.first +
                           problem);
}

enum class CameraType { kPinhole, kRectified, kFisheye };

// Throws unless the file describes a fisheye camera or a pinhole camera with no other coefficients
// than k1 k2 p1 p2 k3.
CameraType TypeOf(const Values& values, const std::string& path) {
  const auto found = values.find("Camera.type");
  std::string type = found == values.end() ? "pinhole" : Lowercase(found->second.text);
  type.erase(std::remove(type.begin(), type.end(), '"'), type.end());
  if (type == "kannalabrandt8") return CameraType::kFisheye;
  if (type == "rectified") return CameraType::kRectified;
  if (type != "pinhole") {
    Fail(path, *found,
         " " + found->second.text +
             " is not supported, only PinHole, Rectified and KannalaBrandt8; undistort the images "
             "to a pinhole camera");
  }
  for (const char* prefix : {"Camera.k", "Camera1.k"}) {
    for (const char digit : {'4', '5', '6'}) {
      const auto further = values.find(prefix + std::string(1, digit));
      if (further == values.end() || ParseNumber(further->second.text) == 0.0) continue;
      Fail(path, *further,
           ": only the distortion coefficients k1 k2 p1 p2 k3 are supported; calibrate with these, "
           "or undistort the images");
    }
  }
  return CameraType::kPinhole;
}

// The lens of a camera. `find` and `require` look up numbers by the names that they may have.
template <typename Find, typename Require>
LensSettings ReadLens(CameraType type, const Find& find, const Require& require) {
  LensSettings lens;
  if (type == CameraType::kFisheye) {
    lens.model = LensModelName(LensModel::kFisheye);
    lens.coefficients[0] = require({"Camera.k1", "Camera1.k1"});
    lens.coefficients[1] = require({"Camera.k2", "Camera1.k2"});
    lens.coefficients[4] = require({"Camera.k3", "Camera1.k3"});
    lens.coefficients[5] = require({"Camera.k4", "Camera1.k4"});
  } else if (type == CameraType::kPinhole) {
    lens.coefficients = {find({"Camera.k1", "Camera1.k1"}), find({"Camera.k2", "Camera1.k2"}),
                         find({"Camera.p1", "Camera1.p1"}), find({"Camera.p2", "Camera1.p2"}),
                         find({"Camera.k3", "Camera1.k3"})};
  }
  return lens;
}

}  // namespace

bool IsOrbSlamConfig(const std::string& content) {
  for (const auto& [name, value] : ReadValues(content)) {
    if (name.rfind("Camera.", 0) == 0 || name.rfind("Camera1.", 0) == 0) return true;
  }
  return false;
}

CameraSettings ReadOrbSlamConfig(const std::string& path) {
  Values repeated;
  const Values values = ReadValues(ReadText(path, kMaxOptionsBytes), &repeated);
  // The first of the names that the file contains, with its value; null if it contains none.
  const auto find_entry =
      [&](std::initializer_list<const char*> names) -> const Values::value_type* {
    for (const char* name : names) {
      const auto found = values.find(name);
      if (found == values.end()) continue;
      const auto again = repeated.find(name);
      if (again != repeated.end() && again->second.text != found->second.text) {
        Fail(path, *again, " is given twice; remove one line");
      }
      return &*found;
    }
    return nullptr;
  };
  const auto find = [&](std::initializer_list<const char*> names) -> std::optional<double> {
    const Values::value_type* entry = find_entry(names);
    if (!entry) return std::nullopt;
    const std::optional<double> number = ParseNumber(entry->second.text);
    if (!number || !std::isfinite(*number)) {
      Fail(path, *entry, " must be a finite number, not '" + entry->second.text + "'");
    }
    return number;
  };
  const auto require = [&](std::initializer_list<const char*> names) {
    const std::optional<double> value = find(names);
    if (!value) {
      throw std::runtime_error(path + ": " + *names.begin() + " is missing; add the line '" +
                               *names.begin() + ": <number>'");
    }
    return *value;
  };
  const auto find_int = [&](std::initializer_list<const char*> names) -> std::optional<int> {
    const std::optional<double> value = find(names);
    if (!value) return std::nullopt;
    const std::optional<int> whole = WholeNumber(*value);
    if (!whole) {
      Fail(path, *find_entry(names), " must be a whole number, not " + FormatNumber(*value));
    }
    return whole;
  };
  CameraSettings camera;
  camera.fx = require({"Camera.fx", "Camera1.fx"});
  camera.fy = require({"Camera.fy", "Camera1.fy"});
  camera.cx = require({"Camera.cx", "Camera1.cx"});
  camera.cy = require({"Camera.cy", "Camera1.cy"});
  const auto factor_names = {"DepthMapFactor", "RGBD.DepthMapFactor", "depthmap_factor"};
  camera.depth_scale = require(factor_names);
  std::string error;
  if (!IsValidDepthScale(*camera.depth_scale, &error)) {
    Fail(path, *find_entry(factor_names), " is the depth_scale: " + error);
  }
  camera.width = find_int({"Camera.width", "Camera.cols"});
  camera.height = find_int({"Camera.height", "Camera.rows"});
  camera.lens = ReadLens(TypeOf(values, path), find, require);
  camera.origin = path;
  return camera;
}

}  // namespace msc_vo
