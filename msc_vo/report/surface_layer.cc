// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/surface_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

#include "msc_vo/report/base64.h"
#include "msc_vo/report/viewer_page.h"

namespace msc_vo {

namespace {

// Positions are stored in steps from the corner of the bounding box, so that 16 bits suffice: 0.3
// mm for 20 m.
constexpr float kMaxSteps = std::numeric_limits<uint16_t>::max();

struct Bounds {
  Eigen::Vector3f corner;
  float step;  // metres
};

Bounds BoundsOf(const std::vector<Eigen::Vector3f>& positions) {
  Eigen::Vector3f low = positions.front(), high = positions.front();
  for (const Eigen::Vector3f& x : positions) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return {low, std::max((high - low).maxCoeff() / kMaxSteps, 1e-6F)};
}

// Read by RunModel in web/run_model.js.
std::string FormatSurface(const ColoredMesh& mesh, const TimedPose& pose) {
  const Bounds bounds = BoundsOf(mesh.positions);
  std::vector<uint16_t> steps;
  std::vector<uint8_t> colors;
  std::vector<uint32_t> corners;
  for (const Eigen::Vector3f& x : mesh.positions) {
    for (const float offset : (x - bounds.corner).eval()) {
      steps.push_back(
          static_cast<uint16_t>(std::clamp(std::round(offset / bounds.step), 0.0F, kMaxSteps)));
    }
  }
  for (const std::array<uint8_t, 3>& color : mesh.colors) {
    colors.insert(colors.end(), color.begin(), color.end());
  }
  for (const std::array<int32_t, 3>& triangle : mesh.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  const Eigen::Vector3d& t = pose.world_from_cam.translation();
  const Eigen::Quaterniond& q = pose.world_from_cam.rotation();
  const nlohmann::ordered_json json = {
      {"time", pose.timestamp},
      {"pose", {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}},
      {"corner", {bounds.corner.x(), bounds.corner.y(), bounds.corner.z()}},
      {"step", bounds.step},
      {"positions", EncodeBase64(steps)},
      {"colors", EncodeBase64(colors)},
      {"triangles", EncodeBase64(corners)}};
  return json.dump();  // numbers and base64: nothing that ends a script element
}

}  // namespace

bool IsInteractiveReport(const std::string& page) {
  return page.find(kRunDataElement) != std::string::npos;
}

std::string AddSurfaceLayer(const std::string& page, const ColoredMesh& mesh,
                            const TimedPose& pose) {
  if (mesh.triangles.empty() || mesh.colors.size() != mesh.positions.size()) {
    throw std::invalid_argument("surface: expected triangles and one colour per vertex");
  }
  if (!IsInteractiveReport(page)) {
    throw std::invalid_argument("surface: expected the page of an interactive report");
  }
  const size_t run = page.find(kRunDataElement);
  // An earlier surface stands before the data of the run.
  const size_t begin = std::min(page.find(kSurfaceDataElement), run);
  return page.substr(0, begin) + kSurfaceDataElement + FormatSurface(mesh, pose) + "</script>\n" +
         page.substr(run);
}

}  // namespace msc_vo
