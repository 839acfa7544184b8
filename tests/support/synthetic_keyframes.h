// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <random>

#include "tests/support/synthetic_frames.h"

#include "msc_vo/mapping/mapper.h"

namespace msc_vo {

// A keyframe without matches, whose pose has errors of 4 mm and 0.2 degrees (one sigma).
inline KeyframePacket Packet(SyntheticFrames* world, int index, std::mt19937* random) {
  const auto normal = [&] { return std::normal_distribution<double>(0.0, 1.0)(*random); };
  KeyframePacket packet;
  packet.frame = world->MakeFrame(index);
  const Rigid3 truth =
      SyntheticFrames::CamFromWorld(index) * SyntheticFrames::CamFromWorld(0).Inverse();
  packet.cam_from_reference = truth;
  if (index > 0) {
    const Eigen::AngleAxisd turn(0.003 * normal(), Eigen::Vector3d::UnitY());
    packet.cam_from_reference =
        Rigid3(Eigen::Quaterniond(turn), 0.004 * Eigen::Vector3d{normal(), normal(), normal()}) *
        truth;
  }
  return packet;
}

// Matches by descriptor alone; the descriptors are unique.
inline void MatchWithMap(const Map& map, KeyframePacket* packet) {
  for (size_t i = 0; i < packet->frame->points.size(); ++i) {
    for (const auto& [id, point] : map.points()) {
      if (HammingDistance(point.descriptor, packet->frame->points[i].descriptor) > 40) continue;
      packet->matches.points.push_back({static_cast<int>(i), id, point.position, true});
      break;
    }
  }
}

// Inserts frame `index` as a keyframe and refines the map with it.
inline MappingSummary ProcessKeyframe(SyntheticFrames* world, int index, std::mt19937* random,
                                      Mapper* mapper) {
  KeyframePacket packet = Packet(world, index, random);
  MatchWithMap(mapper->map(), &packet);
  return mapper->Process(packet);
}

}  // namespace msc_vo
