// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What exports read of the results of a run.

#include "msc_vo/exports/recorded_run.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/results/calibration_json.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/results/summary_json.h"

namespace msc_vo {
namespace {

class RecordedRunTest : public TemporaryFolder {
 protected:
  // Returns the message of the exception of reading a text as frames.csv.
  std::string ErrorOf(const std::string& text) const {
    WriteText("frames.csv", text);
    try {
      ReadFramesCsv(Path("frames.csv"));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
};

FrameResult WrittenFrame() {
  FrameResult frame;
  frame.timestamp = 1305031102.175304;
  frame.status = TrackingStatus::kTracked;
  frame.cam_from_odometry = Rigid3(ExpSO3({0.1, -0.2, 0.3}), {1.0, 2.0, 3.0});
  PoseCovariance root = PoseCovariance::Zero();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) root(i, j) = 1e-3 * (1.0 + i - 0.7 * j);
  }
  frame.world_covariance = root * root.transpose();
  frame.odometry_covariance = 4.0 * *frame.world_covariance;
  return frame;
}

TEST_F(RecordedRunTest, HasPoseAndCovarianceOfEachFrame) {
  FrameResult lost;
  lost.timestamp = 1305031103.0;
  WriteText("frames.csv", FormatFramesCsv({WrittenFrame(), lost}));
  const auto frames = ReadFramesCsv(Path("frames.csv"));
  ASSERT_EQ(frames.size(), 2u);
  const RecordedFrame& frame = frames.at(1305031102175304);
  ASSERT_TRUE(frame.world_covariance && frame.odometry_covariance);
  EXPECT_TRUE(frame.world_covariance->isApprox(*WrittenFrame().world_covariance, 1e-8));
  EXPECT_TRUE(frame.odometry_covariance->isApprox(*WrittenFrame().odometry_covariance, 1e-8));
  EXPECT_LT((frame.odom_from_cam.params - WrittenFrame().cam_from_odometry.Inverse().params).norm(),
            1e-8);
  EXPECT_FALSE(frames.at(1305031103000000).world_covariance);
  EXPECT_FALSE(frames.at(1305031103000000).odometry_covariance);
}

TEST_F(RecordedRunTest, NamesFileLineAndFix) {
  EXPECT_THAT(ErrorOf(""), Names("frames.csv:1"));
  EXPECT_THAT(ErrorOf("time,status\n1,tracked\n"), Names("frames.csv:1", "odom_qx", "again"));
  std::string text = FormatFramesCsv({WrittenFrame()});
  EXPECT_THAT(ErrorOf(text.substr(0, text.size() - 40) + "\n"), Names("frames.csv:2", "columns"));
  text.replace(text.find("1305031102"), 10, "1305O31102");
  EXPECT_THAT(ErrorOf(text), Names("frames.csv:2", "1305O31102.175304", "time"));
}

TEST_F(RecordedRunTest, HasTheCameraAtTheEnd) {
  RunSummary summary;
  RunContext context;
  context.calibration.depth_scale = 1000.0;
  context.calibration.depth_camera = DepthCamera{{350.0, 351.0, 310.0, 200.0, 600, 400},
                                                 {ExpSO3({0.01, 0.02, 0.03}), {0.1, 0.2, 0.3}},
                                                 0.01,
                                                 {{0.2}, LensModel::kRadialTangential, {}}};
  summary.intrinsics.camera = {1501.0 / 3.0, 502.0, 320.1, 240.2, 640, 480};
  summary.intrinsics.distortion.k = {0.1, -0.2, 0.001, 0.002, 0.05};
  summary.map_world = 2;
  summary.segments.resize(2);
  summary.segments[1].world = 2;
  WriteText("summary.json", FormatSummaryJson(summary, context));
  const RecordedRun run = ReadRecordedRun(Folder());
  ASSERT_TRUE(run.calibration);
  EXPECT_EQ(run.calibration->camera.fx, 1501.0 / 3.0);  // every digit
  EXPECT_EQ(run.calibration->camera.cy, 240.2);
  EXPECT_EQ(run.calibration->distortion.k, summary.intrinsics.distortion.k);
  EXPECT_EQ(run.calibration->depth_scale, 1000.0);
  ASSERT_TRUE(run.calibration->depth_camera);
  EXPECT_EQ(run.calibration->depth_camera->camera.fy, 351.0);
  EXPECT_EQ(run.calibration->depth_camera->depth_from_color.params,
            context.calibration.depth_camera->depth_from_color.params);
  EXPECT_EQ(run.calibration->depth_camera->distortion.k[0], 0.2);
  EXPECT_EQ(run.map_world, 2);
  WriteText("summary.json", R"({"final_camera": {"fx": 1}})");
  EXPECT_THROW(ReadRecordedRun(Folder()), std::runtime_error);
  EXPECT_FALSE(ReadRecordedRun(Path("none")).calibration);
}

TEST_F(RecordedRunTest, HasTheDepthCameraThatTheRunHasFound) {
  RunContext context;
  context.calibration.camera = {500.0, 500.0, 319.5, 239.5, 640, 480};
  SensorCorrection::Vector correction = SensorCorrection::Vector::Zero();
  correction(SensorCorrection::kFocalLength) = 0.02;
  correction(SensorCorrection::kDepthFocalLength) = 0.1;
  correction(SensorCorrection::kDepthParallaxX) = 0.05;
  RunSummary summary;
  summary.intrinsics = Corrected(CameraIntrinsics{context.calibration.camera, {}}, correction);
  WriteText("summary.json", FormatSummaryJson(summary, context));
  const RecordedRun run = ReadRecordedRun(Folder());
  ASSERT_TRUE(run.calibration && run.calibration->depth_camera);
  const Calibration expected = Corrected(context.calibration, correction);
  EXPECT_EQ(FormatCalibrationJson(*run.calibration), FormatCalibrationJson(expected));
}

TEST(CalibrationJson, KeepsLensesWithAnotherRecordedCamera) {
  Calibration calibration;
  calibration.camera = {300.0, 300.0, 399.5, 299.5, 800, 600};
  calibration.distortion.model = LensModel::kFisheye;
  calibration.distortion.k = {0.02, -0.01, 0.003, -0.001};
  calibration.distortion.recorded = PinholeCamera{310.0, 311.0, 400.0, 300.0, 810, 610};
  const std::string text = FormatCalibrationJson(calibration);
  const Calibration read = ParseCalibrationJson(text);
  EXPECT_EQ(read.distortion.model, LensModel::kFisheye);
  EXPECT_EQ(read.Recorded().width, 810);
  EXPECT_EQ(FormatCalibrationJson(read), text);
  auto json = nlohmann::json::parse(text);
  json["lens"] = "mirror";
  EXPECT_THROW(ParseCalibrationJson(json.dump()), std::runtime_error);
  json = nlohmann::json::parse(text);
  json["distortion"] = {0.1};
  EXPECT_THROW(ParseCalibrationJson(json.dump()), std::runtime_error);
  json = nlohmann::json::parse(text);
  json["fx"] = -300.0;
  json.erase("recorded");
  EXPECT_THROW(ParseCalibrationJson(json.dump()), std::runtime_error);
}

}  // namespace
}  // namespace msc_vo
