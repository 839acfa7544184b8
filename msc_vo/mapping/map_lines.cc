// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_lines.h"

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/map/window_selection.h"

namespace msc_vo {

namespace {

// Steps of both rounds. A line that turns by ten degrees needs more than the small steps of a run.
constexpr int kIterations = 10;

}  // namespace

std::map<LandmarkId, RefinedLine> RefineMapLines(const MapperOptions& options, const SubMap& submap,
                                                 const StructuralPairs& pairs) {
  const Map& map = submap.map;
  const SceneAxes& axes = submap.axes;
  std::map<LandmarkId, RefinedLine> refined;
  if (axes.estimator().state() != AxesState::kRefined || map.keyframes().empty()) return refined;
  WindowData window = SelectLines(options.selection, map);
  submap.noise.Apply(&window);
  axes.AddAllAlignments(&window);
  pairs.Add(pairs.Find(window), &window);
  BundleAdjustmentOptions solver = options.window;
  solver.first_iterations = solver.second_iterations = kIterations;
  if (!LocalBundleAdjustment(solver, &window).usable) return refined;
  for (const WindowData::Line& line : window.lines) {
    if (line.fixed) continue;
    const LineSegment3 segment =
        TrimToObservations(map, *map.Find<LineLandmark>(line.id), line.segment);
    if (segment.Length() > 0.0) refined[line.id].segment = segment;
  }
  const Eigen::Matrix3d world_from_axes = axes.estimator().world_from_axes().toRotationMatrix();
  for (const WindowData::AxisAlignment& alignment : window.axis_alignments) {
    const auto line = refined.find(alignment.line);
    if (alignment.rejected || line == refined.end()) continue;
    int axis = 0;
    (world_from_axes.transpose() * alignment.axis).cwiseAbs().maxCoeff(&axis);
    line->second.axis = axis;
  }
  return refined;
}

}  // namespace msc_vo
