// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

#include "msc_vo/synthetic/scene/scene.h"

namespace msc_vo {

/// One function per SceneKind, called by MakeScene(). `walk` matters to places that look alike
/// only.
Scene MakeRoom(uint64_t seed, const WalkOptions& walk);
Scene MakeCorridor(uint64_t seed, const WalkOptions& walk);
Scene MakeBare(uint64_t seed, const WalkOptions& walk);
Scene MakeSlanted(uint64_t seed, const WalkOptions& walk);
Scene MakeHouse(uint64_t seed, const WalkOptions& walk);
Scene MakeBox(uint64_t seed, const WalkOptions& walk);
Scene MakeBlank(uint64_t seed, const WalkOptions& walk);
Scene MakeZigZag(uint64_t seed, const WalkOptions& walk);
Scene MakeDeadEnd(uint64_t seed, const WalkOptions& walk);
Scene MakePoster(uint64_t seed, const WalkOptions& walk);
Scene MakeRooms(uint64_t seed, const WalkOptions& walk);
Scene MakeMirrored(uint64_t seed, const WalkOptions& walk);
Scene MakeFloors(uint64_t seed, const WalkOptions& walk);
Scene MakeDesks(uint64_t seed, const WalkOptions& walk);
Scene MakeGallery(uint64_t seed, const WalkOptions& walk);

}  // namespace msc_vo
