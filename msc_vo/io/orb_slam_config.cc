// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/io/orb_slam_config.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <sstream>
#include <stdexcept>

#include "msc_vo/io/files.h"
#include "msc_vo/io/text_file.h"

namespace msc_vo {

namespace {

struct Value {
  std::string text;
  int line = 0;
};

std::string Trimmed(const std::string& text) {
  constexpr char kBlanks[] = " \t\r";
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::map<std::string, Value> ReadValues(const std::string& content) {
  std::map<std::string, Value> values;
  std::istringstream lines(content);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line.resize(std::min(line.size(), line.find('#')));
    const size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    values[Trimmed(line.substr(0, colon))] = {Trimmed(line.substr(colon + 1)), number};
  }
  return values;
}

}  // namespace

bool IsOrbSlamConfig(const std::string& content) {
  for (const auto& [name, value] : ReadValues(content)) {
    if (name.rfind("Camera.", 0) == 0 || name.rfind("Camera1.", 0) == 0) return true;
  }
  return false;
}

CameraSettings ReadOrbSlamConfig(const std::string& path) {
  const std::map<std::string, Value> values = ReadValues(ReadFile(path, kMaxOptionsBytes));
  // The first of the names that the file has.
  const auto find = [&](std::initializer_list<const char*> names) -> std::optional<double> {
    for (const char* name : names) {
      const auto found = values.find(name);
      if (found == values.end()) continue;
      const std::optional<double> number = ParseNumber(found->second.text);
      if (number) return number;
      throw std::runtime_error(path + ":" + std::to_string(found->second.line) + ": " + name +
                               " must be a number, not '" + found->second.text + "'");
    }
    return std::nullopt;
  };
  const auto require = [&](std::initializer_list<const char*> names) {
    const std::optional<double> value = find(names);
    if (!value) {
      throw std::runtime_error(path + ": " + *names.begin() + " is missing; add the line '" +
                               *names.begin() + ": <number>'");
    }
    return *value;
  };
  const auto to_int = [](const std::optional<double>& value) {
    return value ? std::optional<int>(static_cast<int>(*value)) : std::nullopt;
  };

  CameraSettings camera;
  camera.fx = require({"Camera.fx", "Camera1.fx"});
  camera.fy = require({"Camera.fy", "Camera1.fy"});
  camera.cx = require({"Camera.cx", "Camera1.cx"});
  camera.cy = require({"Camera.cy", "Camera1.cy"});
  camera.depth_scale = require({"DepthMapFactor", "RGBD.DepthMapFactor", "depthmap_factor"});
  camera.width = to_int(find({"Camera.width", "Camera.cols"}));
  camera.height = to_int(find({"Camera.height", "Camera.rows"}));
  camera.distortion = {find({"Camera.k1", "Camera1.k1"}), find({"Camera.k2", "Camera1.k2"}),
                       find({"Camera.p1", "Camera1.p1"}), find({"Camera.p2", "Camera1.p2"}),
                       find({"Camera.k3", "Camera1.k3"})};
  camera.origin = path;
  return camera;
}

}  // namespace msc_vo
