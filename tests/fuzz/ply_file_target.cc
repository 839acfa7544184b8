// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// PLY files with lines, with edges and with points.

#include "tests/fuzz/input_folder.h"

#include "msc_vo/results/ply_file.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  const std::string path = folder.Write("lines.ply", AsText(data, size));
  if (size % 4 == 1) {
    std::vector<MapPoint> points;
    if (!Accepts(path, [&] { points = ReadPointsPly(path); })) return 0;
    for (const MapPoint& point : points) Require(point.position.allFinite(), "finite points");
    return 0;
  }
  if (size % 4 == 3) {
    Accepts(path, [&] { ReadColoredEdgesPly(path); });
  }
  if (size % 2 == 0) {
    std::vector<LineSegment3> edges;
    if (!Accepts(path, [&] { edges = ReadEdgesPly(path); })) return 0;
    for (const LineSegment3& edge : edges) {
      Require(edge.start.allFinite() && edge.end.allFinite(), "finite edges");
    }
    return 0;
  }
  std::vector<EstimatedLine> lines;
  if (!Accepts(path, [&] { lines = ReadLinesPly(path); })) return 0;
  for (const EstimatedLine& line : lines) {
    Require(line.segment.start.allFinite() && line.segment.end.allFinite(), "finite lines");
  }
  return 0;
}
