// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/scene_view.h"

#include <regex>

#include "fake_run.h"
#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using ::testing::AllOf;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

// The segments of the map lines along an axis, in drawing units.
std::vector<LineSegment2> SegmentsIn(const std::string& svg, int axis) {
  const std::string opening = "<path class=\"scene-line axis-" + std::to_string(axis) + "\" d=\"";
  const size_t begin = svg.find(opening);
  if (begin == std::string::npos) return {};
  const std::string path = svg.substr(begin, svg.find("/>", begin) - begin);
  const std::regex segment("M([0-9.-]+),([0-9.-]+)L([0-9.-]+),([0-9.-]+)");
  std::vector<LineSegment2> segments;
  for (auto it = std::sregex_iterator(path.begin(), path.end(), segment);
       it != std::sregex_iterator(); ++it) {
    segments.push_back(
        {{std::stod((*it)[1]), std::stod((*it)[2])}, {std::stod((*it)[3]), std::stod((*it)[4])}});
  }
  return segments;
}

TEST(SceneView, ShowsAllLinesInsideOfTheDrawing) {
  const std::string svg = DrawScene(MakeFakeRun(300));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<LineSegment2> segments = SegmentsIn(svg, axis);
    EXPECT_THAT(segments, SizeIs(8)) << axis;  // four edges of the room, four of the box
    for (const LineSegment2& segment : segments) {
      for (const Eigen::Vector2d p : {segment.start, segment.end}) {
        EXPECT_THAT(p.x(), AllOf(Ge(0.0), Le(1200.0)));
        EXPECT_THAT(p.y(), AllOf(Ge(0.0), Le(720.0)));
      }
    }
  }
  EXPECT_THAT(
      svg, AllOf(HasSubstr("class=\"scene-path\" points="), HasSubstr("scene-keyframe"),
                 HasSubstr("lines along Manhattan axis 3"), Not(HasSubstr("lines without axis"))));
}

TEST(SceneView, LooksFromAbove) {
  // Vertical lines start at the floor: their start is lower in the drawing, whose y points down.
  for (const LineSegment2& segment : SegmentsIn(DrawScene(MakeFakeRun(300)), 2)) {
    EXPECT_GT(segment.start.y(), segment.end.y());
  }
  // Seen from above, the rear wall is higher in the drawing: the floor spans a range of y.
  double top = 1e9, bottom = -1e9;
  for (const LineSegment2& segment : SegmentsIn(DrawScene(MakeFakeRun(300)), 2)) {
    top = std::min(top, segment.start.y());
    bottom = std::max(bottom, segment.start.y());
  }
  EXPECT_GT(bottom - top, 100.0);
}

TEST(SceneView, IsIndependentOfTheWorldFrame) {
  ReportData data = MakeFakeRun(300);
  const std::vector<LineSegment2> before = SegmentsIn(DrawScene(data), 0);
  const Rigid3 other_from_world(ExpSO3({0.3, -1.0, 0.7}), {1.0, 2.0, 3.0});
  for (ReportFrame& frame : data.frames) {
    frame.world_from_cam = other_from_world * frame.world_from_cam;
  }
  for (ReportLine& line : data.map.lines) line.segment = other_from_world * line.segment;
  for (ReportGroundTruthPose& pose : data.ground_truth) {
    pose.position = other_from_world * pose.position;
  }
  const std::vector<LineSegment2> after = SegmentsIn(DrawScene(data), 0);
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < after.size(); ++i) {
    EXPECT_LT((after[i].start - before[i].start).norm(), 0.3);  // one decimal in the file
    EXPECT_LT((after[i].end - before[i].end).norm(), 0.3);
  }
}

TEST(SceneView, IgnoresOutliersInTheChoiceOfTheViewpoint) {
  ReportData data = MakeFakeRun(300);
  const std::vector<ReportLine> lines = data.map.lines;
  for (int i = 0; i < 8; ++i)
    data.map.lines.insert(data.map.lines.end(), lines.begin(), lines.end());
  const std::vector<LineSegment2> before = SegmentsIn(DrawScene(data), 0);
  data.map.lines.push_back({{Eigen::Vector3d(500, 0, 0), Eigen::Vector3d(501, 0, 0)}, -1});
  const std::vector<LineSegment2> after = SegmentsIn(DrawScene(data), 0);
  EXPECT_LT((after[0].start - before[0].start).norm(), 5.0);
}

TEST(SceneView, DrawsRunsWithoutLinesOrMotion) {
  ReportData data = MakeFakeRun(1);
  data.map.lines.clear();
  EXPECT_THAT(DrawScene(data), AllOf(HasSubstr("</svg>"), Not(HasSubstr("nan"))));
}

}  // namespace
}  // namespace msc_vo
