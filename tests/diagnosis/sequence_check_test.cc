// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/sequence_check.h"

#include <map>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "msc_vo/diagnosis/calibration_views.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::Not;

testing::Matcher<const Finding&> Is(Severity severity, const std::string& check,
                                    const NamesMatcher& names) {
  return AllOf(Field(&Finding::severity, severity), Field(&Finding::check, check),
               testing::ResultOf([](const Finding& finding) { return Describe(finding); }, names));
}

class SequenceCheckTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    calibration_.camera = {10.0, 10.0, 3.5, 2.5, 8, 6};
    calibration_.depth_scale = 5000.0;
    calibration_.origin = "camera.txt";
    index_.format = "tum";
    for (int i = 0; i < 6; ++i) {
      const std::string name = std::to_string(i);
      WriteColor(name + ".png");
      WriteStripes(name + ".png", i);
      WriteDepth(name + "d.png", 10000 + i);
      index_.entries.push_back({0.1 * i, Path(name + ".png"), Path(name + "d.png"), ""});
      index_.ground_truth.push_back({0.1 * i, Rigid3()});
    }
  }
  // Bright and dark columns, different for each image.
  void WriteStripes(const std::string& name, int i) {
    cv::Mat image(6, 8, CV_8UC1, cv::Scalar(50));
    image.colRange(2, 4).setTo(150 + i);
    ASSERT_TRUE(cv::imwrite(Path(name), image));
  }
  std::vector<Finding> Check() { return CheckSequence(RgbdDecoder(index_, calibration_)); }

  SequenceIndex index_;
  Calibration calibration_;
};

TEST_F(SequenceCheckTest, ReportsNoProblemOfValidSequence) {
  const std::vector<Finding> findings = Check();
  // Images of this size have no features.
  EXPECT_THAT(findings, Each(testing::AnyOf(Field(&Finding::severity, Severity::kGood),
                                            Field(&Finding::check, "images.texture"))));
  EXPECT_THAT(findings, Contains(Is(Severity::kGood, "depth.scale", Names("2.00 m"))));
  EXPECT_THAT(findings, Contains(Is(Severity::kGood, "ground_truth.overlap", Names("6"))));
  EXPECT_THAT(findings, Contains(Is(Severity::kGood, "registration.shift",
                                    Names("not tested", "0 depth edge pixels", "2000"))));
}

TEST_F(SequenceCheckTest, CalibrationViewsAreOfOneWorld) {
  OdometryResult result;
  for (int i = 0; i < 6; ++i) {
    FrameResult frame;
    frame.id = i;
    frame.timestamp = 0.1 * i;
    frame.status = TrackingStatus::kTracked;
    frame.world = i < 2 ? 0 : 1;
    result.frames.push_back(frame);
  }
  result.map_world = 1;
  const RgbdDecoder decoder(index_, calibration_);
  std::vector<int64_t> ids;
  for (const CalibrationView& view : MakeCalibrationViews(decoder, FrameBuilderOptions(), result)) {
    ids.push_back(view.frame->id);
  }
  EXPECT_THAT(ids, testing::ElementsAre(2, 3, 4));
}

TEST_F(SequenceCheckTest, CalibrationViewsHaveNoVelocityFromWeakPoses) {
  OdometryResult result;
  result.readout_time = 0.02;
  for (int i = 0; i < 6; ++i) {
    FrameResult frame;
    frame.id = i;
    frame.timestamp = 0.1 * i;
    frame.status = i == 4 ? TrackingStatus::kWeak : TrackingStatus::kTracked;
    result.frames.push_back(frame);
  }
  const RgbdDecoder decoder(index_, calibration_);
  std::map<int64_t, bool> has_velocity;
  for (const CalibrationView& view : MakeCalibrationViews(decoder, FrameBuilderOptions(), result)) {
    has_velocity[view.frame->id] = view.frame->velocity.has_value();
  }
  EXPECT_THAT(has_velocity, testing::ElementsAre(testing::Pair(1, true), testing::Pair(2, true),
                                                 testing::Pair(3, false)));
}

TEST_F(SequenceCheckTest, RefusesInvalidOptions) {
  SequenceCheckOptions options;
  options.odometry.features.max_depth = options.odometry.features.min_depth;
  EXPECT_THROW(CheckSequence(RgbdDecoder(index_, calibration_), options), std::invalid_argument);
}

TEST_F(SequenceCheckTest, ReportsDepthDelays) {
  EXPECT_THAT(Check(), Not(Contains(Field(&Finding::check, "stamps.depth_delay"))));
  index_.entries[1].depth_delay = 0.004;
  index_.entries[2].depth_delay = -0.001;
  EXPECT_THAT(Check(), Contains(Is(Severity::kGood, "stamps.depth_delay",
                                   Names("-1.0", "4.0 ms", "later"))));
}

TEST_F(SequenceCheckTest, SuggestsDepthScale) {
  calibration_.depth_scale = 1000.0;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "depth.scale",
                                   Names("depth_scale", "5000.0", "2.00 m"))));
  calibration_.depth_scale = 100000.0;
  EXPECT_THAT(Check(),
              Contains(Is(Severity::kWarning, "depth.scale", Names("0.100 m", "depth_scale"))));
}

// The depth scale of the camera has no effect on them.
TEST_F(SequenceCheckTest, SuggestsTheUnitsOfFloatingPointDepth) {
  for (int i = 0; i < 6; ++i) {
    WriteImage(std::to_string(i) + "d.tiff", CV_32FC1, 0.3);
    index_.entries[i].depth_path = Path(std::to_string(i) + "d.tiff");
  }
  const auto warning = Is(Severity::kWarning, "depth.scale",
                          Names("0.300 m", "camera.float_depth_scale", "0.1", "3.00 m"));
  EXPECT_THAT(Check(), Contains(AllOf(warning, Field(&Finding::fix, Not(Names("1000.0"))))));
  index_.float_depth_scale = 0.1;
  EXPECT_THAT(Check(), Contains(Is(Severity::kGood, "depth.scale", Names("3.00 m"))));
}

TEST_F(SequenceCheckTest, ReportsMissingAndUnusableImages) {
  std::filesystem::remove(Path("3.png"));
  WriteImage("4d.png", CV_8UC1, 9);
  const std::vector<Finding> findings = Check();
  EXPECT_THAT(findings, Contains(Is(Severity::kError, "files.readable", Names("3.png", "exist"))));
  EXPECT_THAT(findings, Contains(Is(Severity::kError, "images.decoding", Names("4d.png"))));
}

TEST_F(SequenceCheckTest, ReportsAMissingFileOnce) {
  std::filesystem::remove(Path("3.png"));
  const std::vector<Finding> findings = Check();
  EXPECT_THAT(findings, testing::Contains(Field(&Finding::text, Names("3.png"))).Times(1));
  EXPECT_THAT(findings, Contains(Is(Severity::kGood, "images.decoding", Names("5 images"))));
}

TEST_F(SequenceCheckTest, ReportsPipesInsteadOfWaitingForThem) {
  std::filesystem::remove(Path("2d.png"));
  ASSERT_EQ(mkfifo(Path("2d.png").c_str(), 0600), 0);
  EXPECT_THAT(Check(), Contains(Is(Severity::kError, "files.readable", Names("2d.png", "pipe"))));
}

TEST_F(SequenceCheckTest, QuickCheckReportsProblemsOnly) {
  EXPECT_THAT(CheckSequenceQuickly(RgbdDecoder(index_, calibration_)), testing::IsEmpty());
  calibration_.depth_scale = 90000.0;
  for (int i = 0; i < 6; ++i) WriteDepth(std::to_string(i) + "d.png", 400);
  EXPECT_THAT(CheckSequenceQuickly(RgbdDecoder(index_, calibration_)),
              Contains(Is(Severity::kError, "depth.scale", Names("0.004 m", "depth_scale"))));
}

TEST_F(SequenceCheckTest, HasRegisteredEdgesUnlessDepthIsShiftedOrHasFewEdges) {
  calibration_.camera = {300.0, 300.0, 159.5, 119.5, 320, 240};
  const auto has_registered_edges = [&](int shift, int num_boxes) {
    cv::Mat color(240, 320, CV_8UC1, cv::Scalar(60)), depth(240, 320, CV_16UC1, cv::Scalar(15000));
    for (int i = 0; i < num_boxes; ++i) {
      const cv::Rect box(30 + 40 * (i % 7), 20 + 40 * (i / 7), 20, 20);
      color(box).setTo(200);
      depth(box + cv::Point(shift, 0)).setTo(7500);
    }
    for (int i = 0; i < 6; ++i) {
      cv::imwrite(Path(std::to_string(i) + ".png"), color);
      cv::imwrite(Path(std::to_string(i) + "d.png"), depth);
    }
    return HasRegisteredEdges(RgbdDecoder(index_, calibration_));
  };
  EXPECT_TRUE(has_registered_edges(0, 35));
  EXPECT_FALSE(has_registered_edges(10, 35));
  EXPECT_FALSE(has_registered_edges(0, 1));
}

TEST_F(SequenceCheckTest, ReportsGaps) {
  index_.entries.erase(index_.entries.begin() + 1, index_.entries.begin() + 4);
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "stamps.gaps", Names("1", "0.150 s"))));
}

TEST_F(SequenceCheckTest, CountsGapsByTheirTime) {
  // Images missing in a row that are just no gap.
  const std::map<double, int> num_missing = {{5.0, 0}, {10.0, 0}, {15.0, 0}, {30.0, 2}, {60.0, 6}};
  for (const auto& [rate, count] : num_missing) {
    for (const bool is_gap : {false, true}) {
      for (int i = 0; i < 6; ++i) {
        const int missing = i < 4 ? 0 : count + is_gap;
        index_.entries[i].timestamp = (i + missing) / rate;
      }
      const auto gap = Field(&Finding::check, "stamps.gaps");
      if (is_gap) {
        EXPECT_THAT(Check(), Contains(gap)) << rate;
      } else {
        EXPECT_THAT(Check(), Not(Contains(gap))) << rate;
      }
    }
  }
}

TEST_F(SequenceCheckTest, WarnsOfStampsInOtherUnits) {
  for (SequenceEntry& entry : index_.entries) entry.timestamp *= 333333333.0;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "stamps.rate", Names("seconds"))));
}

TEST_F(SequenceCheckTest, WarnsOfUnusualCamera) {
  calibration_.camera.fy = -10.0;
  EXPECT_THAT(Check(),
              Contains(AllOf(Is(Severity::kWarning, "camera.sign", Names("fy", "negative")),
                             Field(&Finding::fix, Names("positive")))));
  calibration_.camera.fy = 14.0;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "camera.aspect", Names("fx", "fy"))));
  calibration_.camera.cx = 7.5;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "camera.principal_point",
                                   Names("cx", "cy", "image size"))));
  index_.format = "icl-nuim";
  EXPECT_THAT(Check(),
              Contains(Is(Severity::kWarning, "camera.sign", Names("fy", "ICL-NUIM", "-480"))));
}

TEST_F(SequenceCheckTest, WarnsOfADepthCameraWithAnotherSign) {
  const auto of_sign = Field(&Finding::check, "camera.sign");
  calibration_.depth_camera = DepthCamera{calibration_.camera, Rigid3()};
  EXPECT_THAT(Check(), Not(Contains(of_sign)));
  calibration_.depth_camera->camera.fy = -10.0;
  EXPECT_THAT(Check(),
              Contains(AllOf(of_sign, Field(&Finding::fix, Names("depth camera", "positive")))));
  calibration_.camera.fy = -10.0;
  index_.format = "icl-nuim";
  EXPECT_THAT(Check(), Not(Contains(of_sign)));
  calibration_.depth_camera->camera.fy = 10.0;
  EXPECT_THAT(Check(),
              Contains(AllOf(of_sign, Field(&Finding::fix, Names("depth camera", "negative")))));
}

TEST_F(SequenceCheckTest, AcceptsWideViewsThatAreMeant) {
  const auto of_view = Field(&Finding::check, "camera.field_of_view");
  calibration_.camera.fx = calibration_.camera.fy = 2.4;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "camera.field_of_view", Names("111"))));
  calibration_.distortion.model = LensModel::kFisheye;
  calibration_.SetUndistorted();
  EXPECT_THAT(Check(), Not(Contains(of_view)));
  EXPECT_THAT(Check(), Contains(Is(Severity::kGood, "camera.source", Names("fx", "2.400", "fy"))));
  EXPECT_THAT(Check(), Contains(Is(Severity::kGood, "camera.source",
                                   Names("fisheye", "k1", "k2", "k3", "k4"))));
  calibration_ = Calibration();
  calibration_.camera = {10.0, 10.0, 3.5, 2.5, 8, 6};
  calibration_.field_of_view = 20.0;
  calibration_.SetUndistorted();
  EXPECT_THAT(Check(), Not(Contains(of_view)));
}

TEST_F(SequenceCheckTest, SaysThatTheCalibrationIsNotTested) {
  EXPECT_THAT(Check().back(), Is(Severity::kGood, "calibration", Names("check --deep")));
}

TEST_F(SequenceCheckTest, WarnsOfGroundTruthAtOtherTimes) {
  for (TimedPose& pose : index_.ground_truth) pose.timestamp += 1000.0;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "ground_truth.overlap",
                                   Names("1000.000 s", "after"))));
  for (TimedPose& pose : index_.ground_truth) pose.timestamp -= 2000.0;
  EXPECT_THAT(Check(), Contains(Is(Severity::kWarning, "ground_truth.overlap",
                                   Names("begin 1000.000 s before"))));
}

TEST_F(SequenceCheckTest, ReportsEmptyDepth) {
  for (int i = 0; i < 6; ++i) WriteDepth(std::to_string(i) + "d.png", 0);
  EXPECT_THAT(Check(), Contains(Is(Severity::kError, "depth.valid", Names("measurement"))));
}

}  // namespace
}  // namespace msc_vo
