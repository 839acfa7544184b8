// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/recording/window_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/config/option_list.h"
#include "msc_vo/synthetic/window/synthetic_window.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// One item of every kind. All numbers differ; some are hard to represent as text. Not a valid
// window.
WindowData AwkwardWindow() {
  using Limits = std::numeric_limits<double>;
  WindowData data;
  data.camera = {481.2, -480.0, 319.5, 1.0 / 3.0, 641, 479};
  data.keyframes.resize(2);
  data.keyframes[0].id = std::numeric_limits<int64_t>::min();
  data.keyframes[0].fixed = true;
  data.keyframes[0].cam_from_world.params << 0.1, 0.2, 0.3, -0.4, 0.1 + 0.2, 1e-17, -1e22;
  data.keyframes[1].id = std::numeric_limits<int64_t>::max();
  data.points = {{3, {Limits::denorm_min(), Limits::max(), -Limits::min()}, true},
                 {4, {0.6, -0.5, 0.25}, false, 1.0 / 9.0}};
  LineSegment3 segment;
  segment.start = {1.0 / 7.0, 2.0 / 7.0, 3.0 / 7.0};
  segment.end = {4.0 / 7.0, 5.0 / 7.0, 6.0 / 7.0};
  data.lines = {{5, segment, true}, {6, segment, false, 0.37, -1.0 / 13.0}};
  data.point_observations = {{7, 8, {0.7, 0.8}, 0.9, 1.1, 1.2, true},
                             {9, 10, {1.3, 1.4}},
                             {9, 11, {1.3, 1.5}, 0.9, 1.1, 1.2, false, true}};
  WindowData::LineObservation observation;
  observation.keyframe = 11;
  observation.line = 12;
  observation.sigma = 1.5;
  observation.segment.start = {1.6, 1.7};
  observation.segment.end = {1.8, 1.9};
  observation.rejected = true;
  data.line_observations.push_back(observation);
  observation.has_depth = true;
  observation.rejected = false;
  observation.depth.start = 2.1;
  observation.depth.end = 2.2;
  observation.depth.covariance << 2.3, 2.4, 2.5, 2.6;
  observation.depth.num_inliers = 13;
  observation.depth.inlier_ratio = 2.7;
  observation.depth_rejected = true;
  data.line_observations.push_back(observation);
  data.parallel_pairs = {{14, 15, 2.8, 16, true}, {17, 18, 2.9, 19, false}};
  data.perpendicular_pairs = {{20, 21, 3.1, 22, false}};
  data.axis_alignments = {{23, {3.2, 3.3, 3.4}, 3.5, true}, {24, {-0.0, 3.6, 3.7}, 3.8, false}};
  data.pose_priors.resize(2);
  data.pose_priors[0].keyframe = 25;
  data.pose_priors[0].cam_from_world.params << 3.9, 4.1, 4.2, 4.3, 4.4, 4.5, 4.6;
  for (int i = 0; i < 36; ++i) data.pose_priors[0].covariance.data()[i] = 1.0 / (3.0 + i);
  return data;
}

void ExpectSame(const std::vector<WindowData::LinePair>& a,
                const std::vector<WindowData::LinePair>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::tie(a[i].a, a[i].b, a[i].sigma, a[i].count, a[i].rejected),
              std::tie(b[i].a, b[i].b, b[i].sigma, b[i].count, b[i].rejected));
  }
}

void ExpectSameStates(const WindowData& a, const WindowData& b) {
  const PinholeCamera &c = a.camera, &d = b.camera;
  EXPECT_EQ(std::tie(c.fx, c.fy, c.cx, c.cy, c.width, c.height),
            std::tie(d.fx, d.fy, d.cx, d.cy, d.width, d.height));
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (size_t i = 0; i < a.keyframes.size(); ++i) {
    const WindowData::Keyframe &k = a.keyframes[i], &l = b.keyframes[i];
    EXPECT_EQ(std::tie(k.id, k.fixed), std::tie(l.id, l.fixed));
    EXPECT_EQ(k.cam_from_world.params, l.cam_from_world.params);
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    const WindowData::Point &p = a.points[i], &q = b.points[i];
    EXPECT_EQ(std::tie(p.id, p.fixed, p.position), std::tie(q.id, q.fixed, q.position));
  }
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (size_t i = 0; i < a.lines.size(); ++i) {
    const WindowData::Line &l = a.lines[i], &m = b.lines[i];
    EXPECT_EQ(std::tie(l.id, l.fixed, l.segment.start, l.segment.end),
              std::tie(m.id, m.fixed, m.segment.start, m.segment.end));
  }
}

void ExpectSameObservations(const WindowData& a, const WindowData& b) {
  ASSERT_EQ(a.point_observations.size(), b.point_observations.size());
  for (size_t i = 0; i < a.point_observations.size(); ++i) {
    const WindowData::PointObservation &o = a.point_observations[i], &p = b.point_observations[i];
    EXPECT_EQ(std::tie(o.keyframe, o.point, o.pixel, o.sigma, o.inverse_depth,
                       o.inverse_depth_sigma, o.rejected, o.depth_rejected),
              std::tie(p.keyframe, p.point, p.pixel, p.sigma, p.inverse_depth,
                       p.inverse_depth_sigma, p.rejected, p.depth_rejected));
  }
  ASSERT_EQ(a.line_observations.size(), b.line_observations.size());
  for (size_t i = 0; i < a.line_observations.size(); ++i) {
    const WindowData::LineObservation &o = a.line_observations[i], &p = b.line_observations[i];
    EXPECT_EQ(std::tie(o.keyframe, o.line, o.segment.start, o.segment.end, o.sigma, o.has_depth,
                       o.rejected, o.depth_rejected),
              std::tie(p.keyframe, p.line, p.segment.start, p.segment.end, p.sigma, p.has_depth,
                       p.rejected, p.depth_rejected));
    const LineDepth &d = o.depth, &e = p.depth;
    EXPECT_EQ(std::tie(d.start, d.end, d.covariance, d.num_inliers, d.inlier_ratio),
              std::tie(e.start, e.end, e.covariance, e.num_inliers, e.inlier_ratio));
  }
  ExpectSame(a.parallel_pairs, b.parallel_pairs);
  ExpectSame(a.perpendicular_pairs, b.perpendicular_pairs);
  ASSERT_EQ(a.pose_priors.size(), b.pose_priors.size());
  for (size_t i = 0; i < a.pose_priors.size(); ++i) {
    const WindowData::PosePrior &m = a.pose_priors[i], &n = b.pose_priors[i];
    EXPECT_EQ(std::tie(m.keyframe, m.cam_from_world.params, m.covariance),
              std::tie(n.keyframe, n.cam_from_world.params, n.covariance));
  }
  ASSERT_EQ(a.axis_alignments.size(), b.axis_alignments.size());
  for (size_t i = 0; i < a.axis_alignments.size(); ++i) {
    const WindowData::AxisAlignment &m = a.axis_alignments[i], &n = b.axis_alignments[i];
    EXPECT_EQ(std::tie(m.line, m.axis, m.sigma, m.rejected),
              std::tie(n.line, n.axis, n.sigma, n.rejected));
  }
}

class WindowFileTest : public TemporaryFolder {
 protected:
  // Returns the error message of reading `text`, without the folder.
  std::string ErrorOf(const std::string& text) {
    WriteText("window.txt", text);
    const std::string message = MessageOf([&] { ReadWindow(Path("window.txt")); });
    const std::string folder = Path("");
    return message.rfind(folder, 0) == 0 ? message.substr(folder.size()) : message;
  }
  // Replaces the first occurrence of `from` in `text`.
  static std::string Replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t begin = text.find(from);
    EXPECT_NE(begin, std::string::npos) << from;
    return text.replace(begin, from.size(), to);
  }
  static int LineOf(const std::string& text, const std::string& part) {
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + text.find(part), '\n'));
  }
};

TEST_F(WindowFileTest, RestoresEveryNumber) {
  const WindowData data = AwkwardWindow();
  WriteWindow(Path("window.txt"), BundleAdjustmentOptions(), data);
  const RecordedWindow read = ReadWindow(Path("window.txt"));
  ExpectSameStates(read.data, data);
  ExpectSameObservations(read.data, data);
  EXPECT_TRUE(std::signbit(read.data.axis_alignments[1].axis.x()));
  EXPECT_EQ(FormatWindow(read.options, read.data), ReadFile(Path("window.txt")));
}

TEST_F(WindowFileTest, RestoresEveryOption) {
  Configuration configuration;
  int num_changed = 0;
  for (const Option& option : ListOptions(&configuration)) {
    if (option.path.rfind("mapping.window.", 0) != 0) continue;
    if (bool* const* flag = std::get_if<bool*>(&option.value)) **flag = !**flag;
    if (int* const* count = std::get_if<int*>(&option.value)) **count += 3;
    if (double* const* number = std::get_if<double*>(&option.value)) **number /= 3.0;
    if (const Choice* choice = std::get_if<Choice>(&option.value)) choice->set(1);
    ++num_changed;
  }
  WriteWindow(Path("window.txt"), configuration.odometry.mapping.window, WindowData());
  Configuration read;
  read.odometry.mapping.window = ReadWindow(Path("window.txt")).options;
  const std::vector<OptionText> wanted = ChangedOptions(configuration);
  const std::vector<OptionText> found = ChangedOptions(read);
  ASSERT_EQ(wanted.size(), num_changed);
  ASSERT_EQ(found.size(), wanted.size());
  for (size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(found[i].path, wanted[i].path);
    EXPECT_EQ(found[i].value, wanted[i].value);
  }
}

TEST_F(WindowFileTest, RestoredWindowHasIdenticalSolution) {
  SyntheticWindowOptions options;
  options.num_points = 60;
  options.num_lines = 15;
  options.outlier_ratio = 0.05;
  WindowData data = MakeSyntheticWindow(options).data;
  data.parallel_pairs = {{data.lines[0].id, data.lines[1].id, 0.03, 2}};
  WriteWindow(Path("window.txt"), BundleAdjustmentOptions(), data);
  RecordedWindow read = ReadWindow(Path("window.txt"));
  const BundleAdjustmentSummary wanted = LocalBundleAdjustment(BundleAdjustmentOptions(), &data);
  const BundleAdjustmentSummary found = LocalBundleAdjustment(read.options, &read.data);
  ASSERT_TRUE(wanted.usable);
  EXPECT_EQ(found.final_cost, wanted.final_cost);
  ExpectSameStates(read.data, data);
  ExpectSameObservations(read.data, data);
}

TEST_F(WindowFileTest, AcceptsHandEditedFile) {
  WriteText("window.txt",
            "# mine\r\n\r\nmsc_vo_window 1\r\n"
            "camera 500, 500, 320, 240, 640, 480\n"
            "  keyframe 1 fixed 0 0 0 1   +0.5 0 1e0 \n"
            "option mapping.window.parallel.huber 3\n"
            "end 3");
  const RecordedWindow window = ReadWindow(Path("window.txt"));
  EXPECT_EQ(window.options.parallel.huber, 3.0);
  EXPECT_EQ(window.options.manhattan.huber, BundleAdjustmentOptions().manhattan.huber);
  ASSERT_EQ(window.data.keyframes.size(), 1u);
  EXPECT_EQ(window.data.keyframes[0].cam_from_world.translation(), Eigen::Vector3d(0.5, 0, 1));
}

TEST_F(WindowFileTest, ErrorsNameLineAndFix) {
  const std::string text = FormatWindow(BundleAdjustmentOptions(), AwkwardWindow());
  const auto expect = [&](const std::string& from, const std::string& to,
                          const NamesMatcher& names) {
    const std::string where = "window.txt:" + std::to_string(LineOf(text, from)) + ": ";
    EXPECT_THAT(ErrorOf(Replaced(text, from, to)), AllOf(StartsWith(where), names)) << to;
  };
  expect("msc_vo_window 1", "msc_vo_window 2", Names("version", "2", "1"));
  expect("msc_vo_window 1", "msc_vo_window 0", Names("version", "0", "1"));
  expect("msc_vo_window 1", "msc_vo_window x", Names("'x'", "VERSION", "whole number"));
  expect("msc_vo_window 1", "map 1", Names("first record", "msc_vo_window 1"));
  expect("point 3 ", "pint 3 ", Names("'pint'", "option", "camera", "keyframe", "point"));
  expect("point 3 fixed", "point 3 held",
         Names("'held'", "'free'", "'fixed'", "point ID free|fixed X Y Z [NOISE]"));
  expect("point 3 fixed", "point 3.5 fixed", Names("'3.5'", "ID", "whole number"));
  expect("point 3 fixed", "point 99999999999999999999 fixed",
         Names("99999999999999999999", "ID", "whole number"));
  expect("481.2", "nan", Names("'nan'", "FX", "finite", "camera FX FY CX CY WIDTH HEIGHT"));
  expect("481.2", "-inf", Names("'-inf'", "FX"));
  expect("481.2", "1e999", Names("'1e999'", "FX"));
  expect("481.2", "48l.2", Names("'48l.2'", "FX"));
  expect(" 641 ", " 99999999999 ", Names("99999999999", "WIDTH", "whole number", "2147483647"));
  expect(" 641 ", " ", Names("5", "camera FX FY CX CY WIDTH HEIGHT"));
  expect(" 641 ", " 641 1 ", Names("7", "camera FX FY CX CY WIDTH HEIGHT"));
  expect("parallel.huber", "paralel.huber",
         Names("mapping.window.paralel.huber", "mapping.window.parallel.huber"));
  expect("line_endpoint_prior ", "line_anchor ", Names("mapping.window.line_anchor", "remove"));
  expect("option mapping", "option x mapping", Names("option NAME VALUE"));
  expect("reject_chi2_2 ", "reject_chi2_2 x",
         Names("mapping.window.reject_chi2_2", "0.001", "10000", "'x9.21'"));
  const std::string end = text.substr(text.rfind("end "));
  expect(end, "end -3\n", Names("'end'", "-3"));
  expect(end, "end 1000\n", Names("'end'", "1000", end.substr(4, end.size() - 5)));
}

TEST_F(WindowFileTest, ReportsErrorsOfWholeFile) {
  const std::string text = FormatWindow(BundleAdjustmentOptions(), AwkwardWindow());
  const std::string camera = "camera 1 1 1 1 1 1\n";
  EXPECT_THAT(ErrorOf(""), Names("window.txt", "empty"));
  EXPECT_THAT(ErrorOf("msc_vo_window 1\nend 0\n"),
              Names("window.txt:2", "camera FX FY CX CY WIDTH HEIGHT"));
  EXPECT_THAT(ErrorOf("msc_vo_window 1\n" + camera + camera + "end 2\n"),
              Names("window.txt:3", "second", "camera"));
  EXPECT_THAT(ErrorOf("msc_vo_window 1\noption mapping.window.line_endpoint_prior true\n"
                      "option mapping.window.line_endpoint_prior true\n" +
                      camera + "end 3\n"),
              Names("window.txt:3", "mapping.window.line_endpoint_prior", "twice"));
  EXPECT_THAT(ErrorOf(text + camera),
              Names("window.txt:" + std::to_string(std::count(text.begin(), text.end(), '\n') + 1),
                    "'end'"));
  EXPECT_THAT(MessageOf([&] { ReadWindow(Path("none.txt")); }), Names("none.txt", "exist"));
  EXPECT_THAT(MessageOf([&] { ReadWindow(Folder()); }), Names(Folder(), "folder"));
}

TEST_F(WindowFileTest, OptionalFieldsHaveDefaults) {
  const std::string start = "msc_vo_window 1\ncamera 1 1 1 1 1 1\n";
  WriteText("window.txt", start +
                              "point 3 free 1 2 3\npoint 4 free 1 2 3 0.5\n"
                              "line 5 free 0 0 0 1 1 1\nline 6 free 0 0 0 1 1 1 0.7\n"
                              "line 7 free 0 0 0 1 1 1 0.7 -0.01\n"
                              "point_observation 1 3 5 6 1 0.5 0.1 kept\n"
                              "point_observation 1 4 5 6 1 0.5 0.1 kept depth_rejected\nend 8\n");
  const WindowData data = ReadWindow(Path("window.txt")).data;
  EXPECT_EQ(data.points[0].noise, 1.0);
  EXPECT_EQ(data.points[1].noise, 0.5);
  EXPECT_EQ(data.lines[0].noise, 1.0);
  EXPECT_EQ(data.lines[1].noise, 0.7);
  EXPECT_EQ(data.lines[1].depth_offset, 0.0);
  EXPECT_EQ(data.lines[2].depth_offset, -0.01);
  EXPECT_FALSE(data.point_observations[0].depth_rejected);
  EXPECT_TRUE(data.point_observations[1].depth_rejected);
  EXPECT_THAT(ErrorOf(start + "point_observation 1 3 5 6 1 0.5 0.1 kept x\nend 2\n"),
              Names("window.txt:3", "'x'", "depth_rejected"));
  EXPECT_THAT(ErrorOf(start + "point 3 free 1 2 3 4 5\nend 2\n"),
              Names("window.txt:3", "point ID free|fixed X Y Z [NOISE]", "7"));
  EXPECT_THAT(ErrorOf(start + "point 3 free 1 2 3 x\nend 2\n"),
              Names("window.txt:3", "'x'", "NOISE"));
}

TEST_F(WindowFileTest, WritesButRejectsNonFiniteNumbers) {
  WindowData data;
  data.points = {{7, {0.0, std::nan(""), 1.0}}};
  const std::string text = FormatWindow(BundleAdjustmentOptions(), data);
  EXPECT_THAT(text, HasSubstr("point 7 free 0 nan 1 1\n"));
  EXPECT_THAT(ErrorOf(text), Names("'nan'", "Y", "finite"));
}

TEST_F(WindowFileTest, RejectsFileTruncatedAnywhere) {
  const std::string text = FormatWindow(BundleAdjustmentOptions(), AwkwardWindow());
  const size_t whole = text.size() - 1;  // the last line break is optional
  for (size_t size = 0; size < whole; ++size) {
    EXPECT_THAT(ErrorOf(text.substr(0, size)), StartsWith("window.txt:")) << size;
  }
  EXPECT_EQ(ErrorOf(text.substr(0, whole)), "");
}

TEST_F(WindowFileTest, ReadsOrRejectsCorruptedBytes) {
  const std::string text = FormatWindow(BundleAdjustmentOptions(), AwkwardWindow());
  std::mt19937 random(1);
  int num_refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string wrong = text;
    for (int i = 0; i < 3; ++i) wrong[random() % wrong.size()] = static_cast<char>(random());
    const std::string error = ErrorOf(wrong);
    if (error.empty()) continue;
    ++num_refused;
    EXPECT_THAT(error, StartsWith("window.txt:"));
  }
  EXPECT_GT(num_refused, 1000);
}

}  // namespace
}  // namespace msc_vo
