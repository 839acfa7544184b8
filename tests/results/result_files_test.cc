// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/result_files.h"

#include <algorithm>
#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/run_report.h"
#include "msc_vo/results/summary_json.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

class ResultFilesTest : public TemporaryFolder {
 protected:
  // Five frames, the third and fourth without a pose; the first is a keyframe.
  static OdometryResult Result() {
    OdometryResult result;
    for (int i = 0; i < 5; ++i) {
      FrameResult frame;
      frame.id = i;
      frame.timestamp = 10.0 + 0.1 * i;
      frame.status = TrackingStatus::kTracked;
      frame.cam_from_world.translation() = Eigen::Vector3d(-i, 0.0, 0.0);
      frame.num_points = 100 + i;
      frame.num_inlier_points = 50;
      frame.num_inlier_lines = 7;
      frame.times.tracking = 10.0 * (i + 1);
      result.frames.push_back(frame);
    }
    result.frames[0].is_keyframe = true;
    result.frames[0].times.mapping = 40.0;
    result.frames[1].covariance = PoseCovariance::Zero();
    (*result.frames[1].covariance)(1, 1) = std::pow(DegreesToRadians(0.5), 2);
    (*result.frames[1].covariance)(3, 3) = 0.04;
    result.frames[1].world_covariance = IsotropicCovariance(DegreesToRadians(0.25), 0.5);
    (*result.frames[1].world_covariance)(3, 5) = (*result.frames[1].world_covariance)(5, 3) = 0.125;
    result.frames[1].odometry_covariance = IsotropicCovariance(DegreesToRadians(0.75), 2.0);
    result.frames[4].num_dynamic = 80;
    result.frames[2].status = TrackingStatus::kPredicted;
    result.frames[2].cause = LossCause::kNoDepth;
    result.frames[3].status = TrackingStatus::kLost;
    result.frames[3].cause = LossCause::kUniformImage;
    result.frames[4].status = TrackingStatus::kWeak;
    result.keyframes = {{10.0, Rigid3()}};
    result.points = {{{1.0, 2.0, 3.0}, 4}};
    result.lines = {{{{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}}, 5, true, 0},
                    {{{0.0, 2.0, 1.0}, {1.0, 2.0, 1.0}}, 7, true, std::nullopt},
                    {{{0.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, 6, false, 1}};
    result.axes.state = AxesState::kRefined;
    result.axes.sigma = DegreesToRadians(0.1);
    result.last_window.parallel = {12, 3, 5.0, 4.0};
    return result;
  }
};

TEST_F(ResultFilesTest, SummarizesStatusesSpansAndStages) {
  const RunSummary summary = Summarize(Result());
  EXPECT_THAT(summary.status_counts, testing::ElementsAre(2, 1, 1, 1, 0, 0));
  EXPECT_DOUBLE_EQ(summary.tracked_ratio, 0.6);
  EXPECT_EQ(summary.num_frames_with_dynamic_objects, 1);
  ASSERT_EQ(summary.not_tracked.size(), 1u);
  EXPECT_EQ(summary.not_tracked[0].first_frame, 2);
  EXPECT_EQ(summary.not_tracked[0].last_frame, 3);
  EXPECT_DOUBLE_EQ(summary.not_tracked[0].end, 10.3);
  const StageTimeStatistics tracking = FindStage(summary, "tracking");
  EXPECT_EQ(tracking.mean, 30.0);
  EXPECT_EQ(tracking.median, 30.0);
  EXPECT_EQ(tracking.p95, 50.0);
  const StageTimeStatistics mapping = FindStage(summary, "mapping");
  EXPECT_EQ(mapping.count, 1);  // only frames with a keyframe step
  EXPECT_EQ(mapping.mean, 40.0);
}

TEST_F(ResultFilesTest, CountsCausesOfMissingPoses) {
  const RunSummary summary = Summarize(Result());
  EXPECT_EQ(summary.num_estimated, 3);
  EXPECT_FALSE(TrackingFailed(summary));
  EXPECT_EQ(DescribeLosses(summary), "1 black or uniform, 1 without depth");
  const nlohmann::json json = nlohmann::json::parse(FormatSummaryJson(summary, {}));
  EXPECT_EQ(json["frames"]["loss_causes"]["uniform_image"], 1);
  EXPECT_EQ(json["frames"]["loss_causes"]["no_depth"], 1);
  EXPECT_EQ(json["frames"]["loss_causes"]["no_match"], 0);
}

TEST_F(ResultFilesTest, FailsARunWithLessThanHalfOfItsImagesTracked) {
  OdometryResult result = Result();
  result.frames[4].status = TrackingStatus::kLost;  // two of five are left
  result.frames[4].cause = LossCause::kUniformImage;
  EXPECT_TRUE(TrackingFailed(Summarize(result)));
  EXPECT_THAT(DescribeFailure(Summarize(result)), Names("2", "5", "50 %", "2 black", "1 without"));
  result.frames[3].status = TrackingStatus::kDropped;  // not processed: two of four
  EXPECT_FALSE(TrackingFailed(Summarize(result)));
  for (FrameResult& frame : result.frames) frame.status = TrackingStatus::kDropped;
  EXPECT_TRUE(TrackingFailed(Summarize(result)));
}

TEST_F(ResultFilesTest, SummarizesAnEmptyRun) {
  const RunSummary summary = Summarize({});
  EXPECT_EQ(summary.num_frames, 0);
  EXPECT_EQ(summary.tracked_ratio, 0.0);
  EXPECT_TRUE(nlohmann::json::accept(FormatSummaryJson(summary, {})));
}

TEST_F(ResultFilesTest, WritesOneRowPerFrame) {
  const std::string csv = FormatFramesCsv(Result().frames);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
  EXPECT_THAT(csv, testing::StartsWith(
                       "time,status,keyframe,points,lines,inlier_points,inlier_lines,points_ms,"
                       "lines_ms,depth_ms,waiting_ms,matching_ms,pose_ms,tracking_ms,mapping_ms,"
                       "sigma_rx_deg,sigma_ry_deg,sigma_rz_deg,sigma_tx,sigma_ty,sigma_tz,"
                       "dynamic,segment,rho_rx_ry,"));
  EXPECT_THAT(csv, HasSubstr(",odom_x,odom_y,odom_z,odom_qx,odom_qy,odom_qz,odom_qw,"
                             "world_sigma_rx_deg,"));
  EXPECT_THAT(csv, HasSubstr(",world_rho_ty_tz,odom_sigma_rx_deg,"));
  EXPECT_THAT(csv, HasSubstr(",odom_rho_ty_tz\n"));
  EXPECT_THAT(csv, HasSubstr("\n10.000000,tracked,1,100,0,50,7,0.000,"));
  EXPECT_THAT(csv, HasSubstr(",0,0.5,0,0.2,0,0,0,0,0,"));  // degrees, metres
  EXPECT_THAT(csv, HasSubstr(",0.25,0.25,0.25,0.5,0.5,0.5,0,0,0,0,0,0,0,0,0,0,0,0,0,0.5,0,"
                             "0.75,0.75,0.75,2,2,2,"));
  EXPECT_THAT(csv, HasSubstr(",80,0,0,0,"));
  const auto commas = [](const std::string& row) {
    return std::count(row.begin(), row.end(), ',');
  };
  EXPECT_EQ(commas(csv), 6 * commas(csv.substr(0, csv.find('\n'))));
}

TEST_F(ResultFilesTest, WritesAllFilesAndNothingElse) {
  RunContext context;
  context.command_line = "msc_vo replay \xff";  // not UTF-8
  context.outcome = "interrupted";
  context.cost.seconds = 2.0;
  context.cost.processor_seconds = 3.0;
  context.sequence.ground_truth = {{10.0, Rigid3()}};
  const std::string out = Path("deep/down/out");
  EXPECT_EQ(WriteResultFiles(out, Result(), context), "");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("trajectory.txt", "keyframes.txt", "frames.csv",
                                                   "map.ply", "lines.ply", "summary.json",
                                                   "report.html", "groundtruth.txt"));
  const std::vector<TimedPose> trajectory = ReadTrajectory(out + "/trajectory.txt");
  ASSERT_EQ(trajectory.size(), 5u);  // a pose for every frame
  EXPECT_EQ(trajectory[4].world_from_cam.translation().x(), 4.0);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(trajectory[i].is_estimated, i < 2 || i > 3) << i;
  EXPECT_THAT(ReadFile(out + "/keyframes.txt"), testing::Not(HasSubstr("not estimated")));
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(out + "/summary.json"));
  EXPECT_EQ(summary["outcome"], "interrupted");
  EXPECT_EQ(summary["frames"]["lost"], 1);
  EXPECT_EQ(summary["frames"]["tracked_ratio"], 0.6);
  EXPECT_EQ(summary["frames"]["with_dynamic_objects"], 1);
  EXPECT_EQ(summary["frames_per_second"], 2.5);
  EXPECT_EQ(summary["processor_seconds"], 3.0);
  EXPECT_EQ(summary["frames"]["not_tracked_spans"][0]["last_frame"], 3);
  EXPECT_TRUE(summary["error"].is_null());
  EXPECT_EQ(summary["manhattan_axes"]["state"], "refined");
  EXPECT_NEAR(summary["manhattan_axes"]["sigma_deg"], 0.1, 1e-9);
  EXPECT_EQ(summary["manhattan_axes"]["lines"], nlohmann::json({1, 1, 0}));
  EXPECT_EQ(summary["last_local_ba"]["parallel"]["residual_blocks"], 12);
  EXPECT_EQ(summary["last_local_ba"]["parallel"]["rejected"], 3);
  EXPECT_EQ(summary["options"]["mode"], "msc-vo");
  EXPECT_EQ(summary["options"]["tracking.wide_radius"], 60.0);
}

TEST_F(ResultFilesTest, WritesSegmentsAndMarksPosesBeforeThem) {
  OdometryResult result = Result();
  result.frames[0].segment = kNoSegment;
  result.frames[0].status = TrackingStatus::kLost;
  result.frames[4].segment = 1;
  result.segments = {{1, 3, 1, 0, std::nullopt}, {4, 4, 1, 1, std::nullopt}};
  EXPECT_EQ(WriteResultFiles(Path("out"), result, {}), "");
  const std::vector<TimedPose> trajectory = ReadTrajectory(Path("out/trajectory.txt"));
  ASSERT_EQ(trajectory.size(), 5u);
  EXPECT_FALSE(trajectory[0].is_estimated);
  EXPECT_EQ(trajectory[0].segment, 0);
  EXPECT_EQ(trajectory[1].timestamp, 10.1);
  EXPECT_EQ(trajectory[3].world, 0);
  EXPECT_EQ(trajectory[4].segment, 1);
  EXPECT_EQ(trajectory[4].world, 1);
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("out/summary.json")));
  ASSERT_EQ(summary["segments"].size(), 2u);
  EXPECT_EQ(summary["segments"][1]["first_frame"], 4);
  EXPECT_EQ(summary["segments"][1]["in_map"], false);
  EXPECT_TRUE(summary["segments"][1]["joined"].is_null());
  EXPECT_THAT(ReadFile(Path("out/frames.csv")), HasSubstr(",0,-1,0,"));
  const std::string table = FormatRunTable(Summarize(result), {}, "out");
  EXPECT_THAT(LineNaming("segments", table), Names("2", "0", "1"));

  result.segments[1].world = 0;
  result.segments[1].join = SegmentJoin{4, 3, 0.01, 0.02};
  const nlohmann::json joined =
      nlohmann::json::parse(FormatSummaryJson(Summarize(result), {}))["segments"][1];
  EXPECT_EQ(joined["in_map"], true);
  EXPECT_EQ(joined["joined"]["frame"], 4);
  EXPECT_EQ(joined["joined"]["sigma_translation"], 0.02);
}

// The run was found in world 0 of an earlier session, in its second segment.
TEST_F(ResultFilesTest, FramesBeforeTheFirstSegmentHaveItsFirstPose) {
  OdometryResult result = Result();
  result.segments = {{0, -1, 0, 0, {}, true}, {0, -1, 0, 1, {}, false}, {2, 4, 3, 0, {}, false}};
  for (int i = 0; i < 5; ++i) result.frames[i].segment = i < 2 ? kNoSegment : 2;
  const std::vector<TimedPose> poses = TrajectoryOf(result);
  ASSERT_EQ(poses.size(), 5u);
  for (const TimedPose& pose : poses) {
    EXPECT_EQ(pose.segment, 2);
    EXPECT_EQ(pose.world, 0);
  }
  EXPECT_EQ(poses[0].timestamp, result.frames[0].timestamp);
  EXPECT_EQ(poses[1].world_from_cam.params, poses[2].world_from_cam.params);
}

TEST_F(ResultFilesTest, SaysByHowMuchLoopsHaveCorrected) {
  OdometryResult result = Result();
  const auto table = [&] { return FormatRunTable(Summarize(result), {}, "out"); };
  EXPECT_THAT(table(), Not(HasSubstr("loops")));
  result.loops = {{4, 1, 3, DegreesToRadians(0.5), 0.012}};
  EXPECT_THAT(LineNaming("loops", table()), Names("1", "12.0 mm", "0.50 degrees"));
  EXPECT_THAT(FormatReport(result, Summarize(result), {}),
              HasSubstr("frame 4 shows the place of frame 1"));
  result.loops.push_back({4, -1, 3, DegreesToRadians(2.0), 0.003});
  EXPECT_THAT(LineNaming("loops", table()), Names("2", "up to 12.0 mm", "2.00 degrees"));
  result.loops.resize(5, result.loops[0]);
  EXPECT_EQ(DescribeLoopFrames(Summarize(result)),
            "frame 4 shows the place of frame 1, frame 4 shows the place of an earlier session, "
            "frame 4 shows the place of frame 1, and 2 more");
}

TEST_F(ResultFilesTest, SaysWhereTheRunWasFoundInTheMap) {
  OdometryResult result = Result();
  const auto table = [&] { return FormatRunTable(Summarize(result), {}, "out"); };
  result.segments = {{0, 4, 3, 0, std::nullopt}};
  EXPECT_THAT(table(), Not(HasSubstr("found")));
  result.segments = {{0, -1, 0, 0, std::nullopt}, {0, 4, 3, 1, std::nullopt}};
  result.segments[0].is_earlier_session = true;
  EXPECT_THAT(LineNaming("found", table()), Names("not"));
  result.segments[1].world = 0;
  result.segments[1].join = SegmentJoin{3, 3, 0.01, 0.02};
  for (int i = 0; i < 5; ++i) {
    result.frames[i].cam_from_odometry.translation() = Eigen::Vector3d(0.0, 0.5 * i, 0.0);
  }
  EXPECT_THAT(LineNaming("found", table()), Names("frame 3 of 5", "0.30 s", "1.50 m", "60 %"));
  EXPECT_THAT(FormatReport(result, Summarize(result), {}), HasSubstr("found in the map: frame 3,"));
}

TEST_F(ResultFilesTest, TheTableNamesWhatSelfCalibrationHasCorrected) {
  OdometryResult result = Result();
  RunContext context;
  context.sequence.directory = "room";
  EXPECT_THAT(FormatRunTable(Summarize(result), context, "out"), Not(HasSubstr("corrected")));
  result.intrinsics.camera = {509.4, 509.4, 319.5, 239.5, 640, 480};
  result.calibration.sigma.setConstant(0.001);
  result.calibration.is_corrected[static_cast<size_t>(CorrectionGroup::kFocalLength)] = true;
  EXPECT_THAT(FormatRunTable(Summarize(result), context, "out"),
              Names("corrected", "fx", "509.40", "0.51", "fy", "calibrate room", "--output"));
}

TEST_F(ResultFilesTest, WritesTheOptionsInEffect) {
  RunContext context;
  context.configuration.odometry.mode = Mode::kPlVo;
  context.configuration.odometry.mapping.axes.enabled = true;
  EXPECT_EQ(WriteResultFiles(Path("out"), Result(), context), "");
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("out/summary.json")));
  EXPECT_EQ(summary["options"]["mapping.axes.enabled"], false);
  EXPECT_EQ(summary["options"]["mapping.frame_structure"], false);
  EXPECT_EQ(summary["options"]["features.line_depth"], "end-points");
  const std::string report = ReadFile(Path("out/report.html"));
  EXPECT_THAT(report, HasSubstr("line_depth: end-points"));
  EXPECT_THAT(report, HasSubstr("frame_structure: false"));
}

TEST_F(ResultFilesTest, WritesPlanesIfThereAreAny) {
  OdometryResult result = Result();
  MapPlane wall;
  wall.plane = Plane({0.0, 0.0, -1.0}, 2.0);
  wall.extent = {{0.0, 0.0, 2.0}, {0.0, 1.0, 2.0}, {1.0, 1.0, 2.0}};
  result.planes = {wall};
  const std::string out = Path("out");
  EXPECT_EQ(WriteResultFiles(out, result, {}), "");
  EXPECT_THAT(ReadFile(out + "/planes.ply"), HasSubstr("element face 1\n"));
  EXPECT_EQ(nlohmann::json::parse(ReadFile(out + "/summary.json"))["map"]["planes"], 1);
  EXPECT_THAT(ReadFile(out + "/report.html"), HasSubstr("\"planes\":{"));
  WriteIdentity(out, {"/data/room", "1", "2"});
  WriteText("out/groundtruth.txt", "earlier");
  WriteText("out/reference.txt", "earlier");
  RemoveResultFiles(out, {"/moved/room", "1", "2"});
  EXPECT_TRUE(std::filesystem::exists(out + "/groundtruth.txt"));
  EXPECT_TRUE(std::filesystem::exists(out + "/reference.txt"));
  RemoveResultFiles(out, {"/data/house", "3", "4"});
  EXPECT_FALSE(std::filesystem::exists(out + "/groundtruth.txt"));
  EXPECT_FALSE(std::filesystem::exists(out + "/reference.txt"));
  EXPECT_FALSE(std::filesystem::exists(out + "/planes.ply"));
}

TEST_F(ResultFilesTest, ReportsAFileInPlaceOfTheFolder) {
  WriteText("out", "");
  EXPECT_THAT(MessageOf([&] { static_cast<void>(WriteResultFiles(Path("out"), Result(), {})); }),
              Names("out", "created"));
}

// A folder of the name of a file keeps it from being written.
TEST_F(ResultFilesTest, AFileThatCannotBeWrittenKeepsNoOtherFromBeingWritten) {
  RunContext context;
  context.sequence.ground_truth = {{10.0, Rigid3()}};
  const std::vector<std::string> counts = {"trajectory.txt", "keyframes.txt", "frames.csv",
                                           "summary.json",   "map.ply",       "lines.ply"};
  std::vector<std::string> all = counts;
  all.insert(all.end(), {"groundtruth.txt", "report.html"});
  for (const std::string& blocked : all) {
    std::filesystem::remove_all(Path("out"));
    WriteText("out/" + blocked + "/entry", "");
    std::string missing;
    const std::string lost =
        MessageOf([&] { missing = WriteResultFiles(Path("out"), Result(), context); });
    const bool is_lost = std::find(counts.begin(), counts.end(), blocked) != counts.end();
    EXPECT_THAT(is_lost ? lost : missing, Names(blocked, "written"));
    EXPECT_EQ(is_lost ? missing : lost, "");
    for (const std::string& name : all) {
      EXPECT_EQ(FileProblem(Path("out/" + name)).empty(), name != blocked) << name << blocked;
    }
  }
}

}  // namespace
}  // namespace msc_vo
