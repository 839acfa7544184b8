// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/scene_builder.h"

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// The face of the box [low, high] with outward normal sign * axis; if `inward`, the opposite face,
// whose inward normal that is. Side faces have u horizontal and v up.
Quad BoxFace(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int axis, double sign,
             bool inward) {
  const Eigen::Vector3d normal = sign * Eigen::Vector3d::Unit(axis);
  const Eigen::Vector3d up = axis == 2 ? Eigen::Vector3d(normal.cross(Eigen::Vector3d::UnitX()))
                                       : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = up.cross(normal);
  Quad face;
  for (int k = 0; k < 3; ++k) {
    if (k == axis) {
      face.origin[k] = (sign > 0.0) != inward ? high[k] : low[k];
    } else {
      face.origin[k] = right[k] + up[k] > 0.0 ? low[k] : high[k];
    }
  }
  face.edge_u = right.cwiseProduct(high - low);
  face.edge_v = up.cwiseProduct(high - low);
  return face;
}

}  // namespace

Texture SceneBuilder::NewTexture(TextureKind kind, const Eigen::Vector3f& color,
                                 const Eigen::Vector3f& accent, float scale) {
  return {kind, color, accent, scale, static_cast<uint32_t>(random_.Next())};
}

void SceneBuilder::AddQuad(const Quad& quad) {
  scene_.quads.push_back(quad);
  const Eigen::Vector3d corners[] = {quad.At(0, 0), quad.At(1, 0), quad.At(1, 1), quad.At(0, 1)};
  for (int i = 0; i < 4; ++i) {
    const LineSegment3 edge{corners[i], corners[(i + 1) % 4]};
    if (edge.Length() >= kMinEdge) scene_.edges.push_back(edge);
  }
}

void SceneBuilder::AddBox(const Rigid3& world_from_frame, const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high, const Texture& texture,
                          const Texture* front) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Quad face = BoxFace(low, high, axis, sign, false);
      const bool is_front = front != nullptr && axis == 1 && sign > 0.0;
      scene_.quads.push_back(
          {world_from_frame * face.origin, world_from_frame.rotation() * face.edge_u,
           world_from_frame.rotation() * face.edge_v, is_front ? *front : texture});
    }
  }
  AddBoxEdges(world_from_frame, low, high);
}

void SceneBuilder::AddHall(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                           const Texture& floor, const Texture& ceiling, const Texture& walls) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Quad face = BoxFace(low, high, axis, sign, true);
      face.texture = axis < 2 ? walls : (sign > 0.0 ? floor : ceiling);
      scene_.quads.push_back(face);
    }
  }
  AddBoxEdges(Rigid3(), low, high);
}

void SceneBuilder::AddBoxEdges(const Rigid3& world_from_frame, const Eigen::Vector3d& low,
                               const Eigen::Vector3d& high) {
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] - low[axis] < kMinEdge) continue;
    for (int corner = 0; corner < 4; ++corner) {
      Eigen::Vector3d start = low;
      if (corner & 1) start[(axis + 1) % 3] = high[(axis + 1) % 3];
      if (corner & 2) start[(axis + 2) % 3] = high[(axis + 2) % 3];
      Eigen::Vector3d end = start;
      end[axis] = high[axis];
      scene_.edges.push_back({world_from_frame * start, world_from_frame * end});
    }
  }
}

Rigid3 UprightFrame(const Eigen::Vector3d& origin, double facing) {
  return {ExpSO3(facing * Eigen::Vector3d::UnitZ()), origin};
}

}  // namespace msc_vo
