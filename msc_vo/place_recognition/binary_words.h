// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// A fixed subset of the bits of a descriptor, and which subset of which kind of feature it is.
using BinaryWord = uint32_t;

/// All words are less than this.
constexpr BinaryWord kNumBinaryWords = 7 << 14;

/// The different words of a frame, ascending: several of each point and of each line. Descriptors
/// of one place differ in some bits, and share those words whose bits do not differ. There is
/// nothing to train.
std::vector<BinaryWord> WordsOf(const Frame& frame);

}  // namespace msc_vo
