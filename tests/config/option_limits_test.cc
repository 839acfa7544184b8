// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Every option at its limits and beyond: refused with a message that names the valid values, or the
// odometry works with it.

#include <cmath>
#include <random>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/sequence_calibration.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

// What a user may type, valid for some options only.
const std::vector<std::string>& Texts() {
  static const std::vector<std::string> texts = {
      "-1",         "0",           "-0",
      "1",          "nan",         "inf",
      "-inf",       "1e400",       "-1e308",
      "1e308",      "5e-324",      "2147483647",
      "2147483648", "-2147483649", "99999999999999999999",
      "",           " ",           "0x10",
      "1,5",        "1 2",         "text",
      "true",       "[0, 0, 0]",   "[nan, 0, 0, 1]"};
  return texts;
}

bool IsText(const Option& option) { return std::holds_alternative<std::string*>(option.value); }

TEST(OptionLimits, EveryTextIsRefusedWithTheValidValuesOrTaken) {
  Configuration configuration;
  int num_refused = 0, num_taken = 0;
  for (const Option& option : ListOptions(&configuration)) {
    if (IsText(option)) continue;  // every text is a name
    for (const std::string& text : Texts()) {
      const std::string before = FormatOption(option);
      std::string expected;
      if (SetOption(option, text, &expected)) {
        ++num_taken;
        const std::optional<double> number = NumberOf(option);
        EXPECT_TRUE(!number || (std::isfinite(*number) && option.range->Contains(*number)))
            << option.path << " = " << text;
        continue;
      }
      ++num_refused;
      EXPECT_EQ(FormatOption(option), before) << option.path << " = " << text;
      EXPECT_FALSE(expected.empty()) << option.path << " = " << text;
      if (option.range && option.range->IsBounded()) {
        EXPECT_THAT(expected, HasSubstr(ToString(*option.range))) << option.path << " = " << text;
      }
    }
  }
  EXPECT_GT(num_refused, 2000);
  EXPECT_GT(num_taken, 300);
}

// A complete calibration with a depth camera.
CameraSettings CompleteCamera() {
  CameraSettings camera;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  camera.width = 640;
  camera.height = 480;
  camera.depth_scale = 5000.0;
  camera.origin = "--set";
  DepthCameraSettings& depth = camera.depth_camera;
  depth.fx = depth.fy = 525.0;
  depth.cx = 319.5;
  depth.cy = 239.5;
  depth.width = 640;
  depth.height = 480;
  return camera;
}

TEST(OptionLimits, EveryNumberOfTheCameraIsRefusedOrValid) {
  Configuration configuration;
  int num_refused = 0, num_valid = 0;
  for (const Option& option : ListOptions(&configuration)) {
    if (option.path.rfind("camera.", 0) != 0) continue;
    for (const std::string& text : Texts()) {
      configuration.camera = CompleteCamera();
      std::string expected, error;
      if (IsText(option) || !SetOption(option, text, &expected)) continue;
      SequenceIndex index;
      try {
        const Calibration calibration = ResolveCalibration(configuration.camera, "", &index);
        EXPECT_TRUE(calibration.IsValid(&error)) << option.path << " = " << text << ": " << error;
        ++num_valid;
      } catch (const std::runtime_error& refused) {
        EXPECT_THAT(refused.what(), HasSubstr("--set: ")) << option.path << " = " << text;
        ++num_refused;
      }
    }
  }
  EXPECT_GT(num_refused, 50);
  EXPECT_GT(num_valid, 20);
}

// A short run over small images with a keyframe at every second one. The sixth image is black, so
// that the last ones need a prediction or a relocalisation.
class OptionLimitsRun : public testing::Test {
 protected:
  static constexpr int kNumImages = 8;

  static void SetUpTestSuite() {
    SyntheticSequenceOptions options = RoomOptions();
    options.width = 160;
    options.height = 120;
    camera_ = SyntheticSequence(options).camera();
    images_ = new std::vector<RgbdImage>(RenderImages(options, kNumImages));
    Cover(&images_->at(5));
    truth_ = new std::vector<TimedPose>(TruePoses(options, kNumImages));
  }
  static void TearDownTestSuite() {
    delete images_;
    delete truth_;
  }

  static OdometryOptions BaseOptions() {
    OdometryOptions options;
    options.threads = 1;
    options.features.points.num_points = 300;
    options.tracking.keyframes.max_interval = 0.06;  // seconds: every second frame
    return options;
  }

  // Runs the odometry unless the options are refused, with a message, and checks every frame.
  static void Check(const OdometryOptions& options, const std::string& name) {
    SCOPED_TRACE(name);
    std::string error;
    if (!options.IsValid(&error)) {
      EXPECT_NE(error, "");
      EXPECT_THROW(Odometry(options, camera_, LensDistortion()), std::invalid_argument);
      ++num_refused_;
      return;
    }
    ++num_runs_;
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : *images_) odometry.Process(image);
    const OdometryResult result = odometry.Finish();
    ASSERT_EQ(result.frames.size(), images_->size());
    for (const FrameResult& frame : result.frames) {
      CheckFrame(frame);
      // These images were not taken with a rolling shutter: a readout time misleads.
      if (!options.mapping.readout_time) CheckPosition(frame);
    }
  }

  static void CheckFrame(const FrameResult& frame) {
    EXPECT_TRUE(frame.cam_from_world.params.allFinite()) << frame.id;
    EXPECT_NEAR(frame.cam_from_world.rotation().norm(), 1.0, 1e-6) << frame.id;
    if (!frame.covariance) return;
    EXPECT_TRUE(frame.covariance->allFinite()) << frame.id;
    EXPECT_GE(frame.covariance->diagonal().minCoeff(), 0.0) << frame.id;
  }

  // The camera moves by 8 cm in all; a tracked frame must not be off by 10 cm.
  static void CheckPosition(const FrameResult& frame) {
    if (frame.status != TrackingStatus::kTracked) return;
    const Rigid3 cam_from_first =
        truth_->at(frame.id).world_from_cam.Inverse() * truth_->at(0).world_from_cam;
    const Rigid3 error = cam_from_first * frame.cam_from_world.Inverse();
    EXPECT_LT(error.translation().norm(), 0.1) << frame.id;
  }

  // Every option of a section, but for a part of it, at both limits, switched, or at each choice.
  static void CheckSection(const std::string& section, const std::string& except = "none") {
    OdometryOptions defaults = BaseOptions();
    const std::vector<Option> names = ListOptions(&defaults);
    for (size_t i = 0; i < names.size(); ++i) {
      const std::string& path = names[i].path;
      if (path.rfind(section, 0) != 0 || path.rfind(except, 0) == 0) continue;
      for (size_t choice = 0; choice < NumChoices(names[i]); ++choice) {
        OdometryOptions options = BaseOptions();
        const Option option = ListOptions(&options)[i];
        Choose(choice, option);
        Check(options, option.path + " = " + FormatOption(option));
      }
    }
  }

  static size_t NumChoices(const Option& option) {
    const Choice* choice = std::get_if<Choice>(&option.value);
    return choice ? choice->names.size() : 2;
  }

  static void Choose(size_t choice, const Option& option) {
    if (bool* const* flag = std::get_if<bool*>(&option.value)) {
      **flag = choice == 1;
    } else if (const Choice* names = std::get_if<Choice>(&option.value)) {
      names->set(static_cast<int>(choice));
    } else {
      const double limit = choice == 0 ? option.range->min : option.range->max;
      if (int* const* count = std::get_if<int*>(&option.value)) **count = static_cast<int>(limit);
      if (double* const* number = std::get_if<double*>(&option.value)) **number = limit;
      if (auto* const* number = std::get_if<std::optional<double>*>(&option.value))
        **number = limit;
    }
  }

  static inline PinholeCamera camera_;
  static inline std::vector<RgbdImage>* images_ = nullptr;
  static inline std::vector<TimedPose>* truth_ = nullptr;
  static inline int num_runs_ = 0;
  static inline int num_refused_ = 0;
};

TEST_F(OptionLimitsRun, WorksWithTheDefaults) {
  Odometry odometry(BaseOptions(), camera_, LensDistortion());
  for (const RgbdImage& image : *images_) odometry.Process(image);
  const OdometryResult result = odometry.Finish();
  EXPECT_GE(result.keyframes.size(), 3u);
  for (const int i : {1, 4, 6, 7})
    EXPECT_EQ(result.frames[i].status, TrackingStatus::kTracked) << i;
  for (const FrameResult& frame : result.frames) CheckPosition(frame);
}

TEST_F(OptionLimitsRun, WorksWithFeatureOptionsAtTheirLimits) {
  CheckSection("features.");
  EXPECT_GT(num_runs_, 20);
}

TEST_F(OptionLimitsRun, WorksWithTrackingOptionsAtTheirLimits) {
  CheckSection("tracking.");
  EXPECT_GT(num_runs_, 35);
}

TEST_F(OptionLimitsRun, WorksWithMappingOptionsAtTheirLimits) {
  CheckSection("mapping.", "mapping.window.");
  EXPECT_GT(num_runs_, 25);
}

TEST_F(OptionLimitsRun, WorksWithWindowOptionsAtTheirLimits) {
  CheckSection("mapping.window.");
  EXPECT_GT(num_runs_, 20);
}

TEST_F(OptionLimitsRun, WorksWithGeneralOptionsAtTheirLimits) {
  for (const char* name : {"mode", "use_points", "use_lines", "align_depth", "threads",
                           "external_mapping", "realtime"}) {
    CheckSection(name);
  }
  EXPECT_GT(num_runs_, 10);
}

}  // namespace
}  // namespace msc_vo
