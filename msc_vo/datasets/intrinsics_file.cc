// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/intrinsics_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <stdexcept>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/json_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Shortest focal length of a camera, pixels. The elements of a rotation are at most 1.
constexpr double kMinFocalLength = 2.0;

// Tests whether rows of `columns` numbers are [fx 0 cx; 0 fy cy; 0 0 1], with zeros around it.
bool IsCameraMatrix(const std::vector<double>& v, size_t columns) {
  for (size_t i = 0; i < v.size(); ++i) {
    const size_t row = i / columns, column = i % columns;
    const bool is_intrinsic = row < 2 && (column == row || column == 2);
    const bool is_one = row == column && row >= 2;
    if (!is_intrinsic && v[i] != (is_one ? 1.0 : 0.0)) return false;
  }
  return true;
}

bool IsPlausible(const PinholeCamera& camera) {
  return camera.fx >= kMinFocalLength && std::abs(camera.fy) >= kMinFocalLength &&
         camera.cx > 0.0 && camera.cy > 0.0;
}

// The camera of "fx fy cx cy" or of a camera matrix, without a size.
std::optional<PinholeCamera> CameraOf(const std::vector<double>& v) {
  std::optional<PinholeCamera> camera;
  if (v.size() == 4) camera = {v[0], v[1], v[2], v[3], 0, 0};
  for (const auto& [rows, columns] : {std::pair(3, 3), std::pair(3, 4), std::pair(4, 4)}) {
    const auto stride = static_cast<size_t>(columns);
    if (v.size() != rows * stride || !IsCameraMatrix(v, stride)) continue;
    camera = {v[0], v[stride + 1], v[2], v[stride + 2], 0, 0};
  }
  return camera && IsPlausible(*camera) ? camera : std::nullopt;
}

std::optional<GivenIntrinsics> ReadNumbers(const std::string& path) {
  std::vector<double> values;
  for (const TextLine& line : ReadTextLines(path)) {
    constexpr size_t kMaxNumbers = 16;
    const std::vector<double> numbers = ParseNumbers(line);
    values.insert(values.end(), numbers.begin(), numbers.end());
    if (values.size() > kMaxNumbers) return std::nullopt;
  }
  const std::optional<PinholeCamera> camera = CameraOf(values);
  if (!camera) return std::nullopt;
  return GivenIntrinsics{path, *camera, std::nullopt};
}

std::optional<double> NumberOf(const JsonFile& json, const std::vector<const char*>& keys) {
  for (const char* key : keys) {
    if (json.Has(key)) return json.Number(key);
  }
  return std::nullopt;
}

std::optional<PinholeCamera> CameraOf(const JsonFile& json) {
  if (json.Has("intrinsic_matrix")) {  // column by column
    const std::vector<double> k = json.Numbers("intrinsic_matrix", 9);
    return CameraOf({k[0], k[3], k[6], k[1], k[4], k[7], k[2], k[5], k[8]});
  }
  const std::optional<double> fx = NumberOf(json, {"fx", "fl_x"}), cx = NumberOf(json, {"cx"});
  const std::optional<double> fy = NumberOf(json, {"fy", "fl_y"}), cy = NumberOf(json, {"cy"});
  if (!fx || !fy || !cx || !cy) return std::nullopt;
  const double first_pixel = json.Has("fl_x") ? 0.5 : 0.0;  // its centre, in files of nerfstudio
  return CameraOf({*fx, *fy, *cx - first_pixel, *cy - first_pixel});
}

// `scale_keys`: of the depth scale.
std::optional<GivenIntrinsics> ReadJson(const std::string& path, const JsonFile& json,
                                        const std::vector<const char*>& scale_keys) {
  for (const char* coefficient : {"k1", "k2", "k3", "k4", "p1", "p2"}) {
    if (json.Has(coefficient) && json.Number(coefficient) != 0.0) return std::nullopt;
  }
  std::optional<PinholeCamera> camera = CameraOf(json);
  if (!camera) return std::nullopt;
  camera->width = WholeNumber(NumberOf(json, {"w", "width"}).value_or(0.0)).value_or(0);
  camera->height = WholeNumber(NumberOf(json, {"h", "height"}).value_or(0.0)).value_or(0);
  std::optional<double> depth_scale = NumberOf(json, scale_keys);
  std::string ignored;
  if (depth_scale && !IsValidDepthScale(*depth_scale, &ignored)) depth_scale.reset();
  return GivenIntrinsics{path, *camera, depth_scale};
}

// Distance of the principal point from the centre of the image, in relation to its size.
double OffsetFromCentre(const PinholeCamera& camera, const ImageSize& size) {
  return std::max(std::abs((camera.cx + 0.5) / size.width - 0.5),
                  std::abs((camera.cy + 0.5) / size.height - 0.5));
}

}  // namespace

std::optional<GivenIntrinsics> ReadIntrinsicsFile(const std::string& path) {
  try {
    if (Lowercase(fs::path(path).extension().string()) != ".json") return ReadNumbers(path);
    const JsonFile json(path);
    if (const auto given = ReadJson(path, json, {"depth_scale"})) return given;
    for (const char* key : {"camera", "intrinsic"}) {
      const std::optional<JsonFile> object = json.Object(key);
      if (!object) continue;
      if (const auto given = ReadJson(path, *object, {"depth_scale", "scale"})) return given;
    }
  } catch (const std::runtime_error&) {  // another kind of file
  }
  return std::nullopt;
}

std::optional<ImageSize> FindSizeOf(const PinholeCamera& camera,
                                    const std::vector<ImageSize>& sizes) {
  constexpr double kMaxOffset = 0.1;
  constexpr double kClearRatio = 0.5;  // the centre of a camera is as likely off that of any size
  std::optional<ImageSize> found;
  for (const ImageSize& size : sizes) {
    const double offset = OffsetFromCentre(camera, size);
    const bool is_better = !found || offset < kClearRatio * OffsetFromCentre(camera, *found);
    if (offset <= kMaxOffset && is_better) found = size;
  }
  return found;
}

std::vector<std::string> FindCalibrationFiles(const std::string& folder) {
  static const std::regex kPattern(
      "(.*(calib|intrinsic|cam(era)?[_-]?(param|matrix|info)).*|cameras?|transforms|k)"
      "\\.(txt|json|ya?ml|csv|xml|toml|ini)");
  std::vector<std::string> files;
  for (const std::string& path : ListFolder(folder)) {
    const std::string name = Lowercase(fs::path(path).filename().string());
    if (std::regex_match(name, kPattern) && FileProblem(path).empty()) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace msc_vo
