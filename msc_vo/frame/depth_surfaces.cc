// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/depth_surfaces.h"

namespace msc_vo {

namespace {

bool AreConnected(const DepthRanges::Cell& a, const DepthRanges::Cell& b) {
  constexpr double kMaxRatio = 1.0 + DepthRanges::kTolerance;
  return a.HasDepth() && b.HasDepth() && a.max_inverse_depth <= kMaxRatio * b.max_inverse_depth &&
         b.max_inverse_depth <= kMaxRatio * a.max_inverse_depth;
}

// Labels the surface that contains a cell.
void FloodFill(const DepthRanges& ranges, int first, int label, std::vector<int>* labels) {
  constexpr int kColumns = DepthRanges::kColumns;
  const int num_cells = static_cast<int>(labels->size());
  std::vector<int> open = {first};
  (*labels)[first] = label;
  while (!open.empty()) {
    const int cell = open.back();
    open.pop_back();
    const auto visit = [&](int neighbor) {
      if ((*labels)[neighbor] == label ||
          !AreConnected(ranges.cells[cell], ranges.cells[neighbor])) {
        return;
      }
      (*labels)[neighbor] = label;
      open.push_back(neighbor);
    };
    if (cell % kColumns > 0) visit(cell - 1);
    if (cell % kColumns < kColumns - 1) visit(cell + 1);
    if (cell >= kColumns) visit(cell - kColumns);
    if (cell + kColumns < num_cells) visit(cell + kColumns);
  }
}

}  // namespace

DepthSurfaces::DepthSurfaces(const DepthRanges& ranges) : labels(ranges.cells.size(), kNone) {
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] != kNone || !ranges.cells[cell].HasDepth()) continue;
    FloodFill(ranges, static_cast<int>(cell), count, &labels);
    ++count;
  }
}

}  // namespace msc_vo
