// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Texts that the library writes, and numbers that it reads, in a program that has set another
// locale.

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <sstream>

#include "tests/results/benchmark_runs.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/factors/direction_prior.h"
#include "msc_vo/factors/jacobian_check.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/recording/window_json.h"
#include "msc_vo/results/benchmark_index.h"
#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/results/error_json.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/results/run_report.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using Text = std::function<std::string()>;

class LocaleTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    setenv("LOCPATH", Folder().c_str(), 1);
  }
  void TearDown() override {
    std::locale::global(std::locale::classic());
    unsetenv("LOCPATH");
    TemporaryFolder::TearDown();
  }

  // Makes the locale `name`.UTF-8. Returns false where its sources are missing.
  bool Make(const std::string& name) const {
    const std::string path = Path(name + ".UTF-8");
    const std::string command =
        "localedef -i " + name + " -f UTF-8 '" + path + "' >'" + Path("localedef.log") + "' 2>&1";
    return std::system(command.c_str()) == 0 || fs::exists(path);
  }

  // Sets the locale for C and C++.
  static void Use(const std::string& name) {
    std::locale::global(std::locale((name + ".UTF-8").c_str()));
  }

  // Expects that each text is the same in the locale `name` as in the "C" locale.
  void ExpectSame(const std::string& name, const std::vector<Text>& texts) const {
    for (const Text& text : texts) {
      std::locale::global(std::locale::classic());
      const std::string expected = text();
      EXPECT_FALSE(expected.empty());
      Use(name);
      EXPECT_EQ(text(), expected);
    }
  }

  // Two thousand frames, so that counts have a thousands separator.
  static OdometryResult Result() {
    OdometryResult result;
    for (int i = 0; i < 2000; ++i) {
      FrameResult frame;
      frame.id = i;
      frame.timestamp = 1305031102.1753 + i / 30.0;
      frame.status = i % 1500 == 1234 ? TrackingStatus::kLost : TrackingStatus::kTracked;
      frame.cam_from_world.translation() = Eigen::Vector3d(-0.0015 * i, 0.25, 0.0);
      frame.num_points = 1000 + i;
      frame.times.tracking = 10.25 + i % 7;
      frame.covariance = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
      result.frames.push_back(frame);
    }
    result.frames[0].is_keyframe = true;
    result.frames[0].times.mapping = 40.5;
    result.keyframes = {{1305031102.1753, Rigid3()}};
    for (int i = 0; i < 1500; ++i) result.points.push_back({{0.125 * i, 2.5, 3.75}, 4});
    result.lines = {{{{0.5, 0.25, 1.5}, {1.5, 0.75, 1.25}}, 5, true, 0}};
    result.axes.state = AxesState::kRefined;
    result.axes.sigma = 0.0015;
    result.last_window.parallel = {1200, 3, 5.5, 4.25};
    result.readout_time = 0.0155;
    result.segments = {{0, 1999, 1999, 0, std::nullopt}};
    return result;
  }

  static RunContext Context() {
    RunContext context;
    context.error = EvaluateTrajectory(TrajectoryOf(Result()), TrajectoryOf(Result()));
    context.cost = {1234.5, 0.25, 1234.5};
    return context;
  }
};

// Every file of a run.
TEST_F(LocaleTest, ResultsAreTheSameBytes) {
  if (!Make("de_DE")) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8: " << Path("");
  ASSERT_EQ(WriteResultFiles(Path("expected"), Result(), Context()), "");
  Use("de_DE");
  char number[8];
  std::snprintf(number, sizeof(number), "%.1f", 0.5);
  ASSERT_STREQ(number, "0,5") << "the locale has no effect";
  ASSERT_EQ(WriteResultFiles(Path("found"), Result(), Context()), "");
  int num_files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(Path("expected"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(ReadFile(entry.path().string()) == ReadFile(Path("found/" + name))) << name;
    ++num_files;
  }
  EXPECT_GE(num_files, 7);
}

TEST_F(LocaleTest, TextsOfResultsAreTheSame) {
  if (!Make("de_DE")) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8";
  Benchmark benchmark;
  benchmark.modes = {"pl-vo"};
  benchmark.max_frames = 12345;
  benchmark.runs = {GoodRun("rooms", "pl-vo", 0.0125)};
  benchmark.runs[0].summary.num_frames = 12345;
  const auto solved = [](BundleAdjustmentSolver solver) {
    RecordedWindow window = ReadWindow(MSC_VO_WINDOWS_FOLDER "/room.txt");
    window.options.solver = solver;
    const BundleAdjustmentSummary summary = LocalBundleAdjustment(window.options, &window.data);
    return summary.BriefReport() + FormatWindowJson(summary, 12.5) +
           FormatWindow(window.options, window.data);
  };
  ExpectSame("de_DE", {[&] { return FormatBenchmarkMarkdown(benchmark); },
                       [&] { return FormatBenchmarkJson(benchmark); },
                       [&] { return FormatBenchmarkIndex(benchmark, "."); },
                       [] { return FormatRunTable(Summarize(Result()), Context(), "out"); },
                       [&] { return solved(BundleAdjustmentSolver::kCeres); },
                       [&] { return solved(BundleAdjustmentSolver::kBlockSchur); },
                       [] { return FormatConfiguration(Configuration(), OptionSelection::kAll); },
                       [] { return FormatOptionsMarkdown(OptionSelection::kAll); },
                       [] {
                         Calibration calibration;
                         calibration.camera = {500.25, 500.5, 319.5, 239.5, 640, 480};
                         return FormatCameraFile(calibration, "made at 1.5");
                       },
                       [] {
                         const auto cost =
                             DirectionPrior::CreateShared(Eigen::Vector3d::UnitX(), 0.01);
                         return CheckJacobians(*cost, {{0.8, 0.6, 0.0}}, {nullptr}).report;
                       }});
}

// Messages of errors with numbers.
TEST_F(LocaleTest, ErrorsAreTheSame) {
  if (!Make("de_DE")) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8";
  const PinholeCamera camera = {500.5, 500.5, 319.5, 239.5, 640, 480};
  const auto invalid = [](const auto& value) {
    std::string error;
    EXPECT_FALSE(value.IsValid(&error));
    return error;
  };
  const auto process = [&](double delay) {
    return MessageOf([&] {
      Odometry odometry({}, camera, {});
      RgbdImage image;
      image.depth_delay = delay;
      odometry.Process(image);
    });
  };
  const auto option = [this](const std::string& line) {
    WriteFile(Path("options.yaml"), line);
    Configuration configuration;
    return MessageOf([&] { ReadConfiguration(Path("options.yaml"), &configuration); });
  };
  ExpectSame("de_DE", {[&] {
                         return invalid(PinholeCamera{2.5e6, 2.5e6, 319.5, 239.5, 6400, 4800});
                       },
                       [&] {
                         Calibration calibration;
                         calibration.camera = camera;
                         calibration.depth_scale = 0.00125;
                         return invalid(calibration);
                       },
                       [&] {
                         Calibration calibration;
                         calibration.camera = camera;
                         calibration.field_of_view = 1234.5;
                         return invalid(calibration);
                       },
                       [&] {
                         Calibration calibration;
                         calibration.camera = camera;
                         calibration.distortion.k = {-2.5, 0.0, 0.0, 0.0, 0.0};
                         return invalid(calibration);
                       },
                       [&] {
                         DepthCamera depth_camera;
                         depth_camera.camera = camera;
                         depth_camera.depth_from_color.translation().x() = 1234.5;
                         return invalid(depth_camera);
                       },
                       [&] {
                         SurfaceNormalOptions options;
                         options.max_depth = 1e6;
                         return invalid(options);
                       },
                       [&] { return process(1234.5); },
                       [&] { return option("tracking:\n  pose_refinement_delay: 1234.5\n"); },
                       [] {
                         return EvaluateTrajectory({{0.5, Rigid3()}}, {{0.5, Rigid3()}}).message;
                       }});
}

TEST_F(LocaleTest, TheSystemsErrorsAreTheSame) {
  if (!Make("de_DE")) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8";
  WriteText("file", "");
  const auto message = [this] {
    return MessageOf([this] { WriteFile(Path("file/below"), "1"); }) +
           MessageOf([this] { MakeFolder(Path("file/below/1")); });
  };
  ExpectSame("de_DE", {message, [] {
                         return ErrorText(std::make_error_code(std::errc::no_space_on_device));
                       }});
}

TEST_F(LocaleTest, LogsAreTheSame) {
  if (!Make("de_DE")) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8";
  const std::vector<spdlog::sink_ptr> silent = Log().sinks();
  const auto log = [] {
    std::ostringstream text;
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(text);
    sink->set_pattern("%l: %v");
    Log().sinks() = {sink};
    Log().set_level(spdlog::level::debug);
    const PinholeCamera camera = {1500.5, 1500.5, 1319.5, 239.5, 2640, 480};
    Odometry odometry({}, camera, {});
    RgbdImage image;
    image.timestamp = 1234.5;
    image.gray = cv::Mat::zeros(480, 2640, CV_8UC1);
    image.depth = cv::Mat::zeros(480, 2640, CV_32FC1);
    odometry.Process(image);
    odometry.Finish();
    return text.str();
  };
  ExpectSame("de_DE", {log});
  Log().set_level(spdlog::level::off);
  Log().sinks() = silent;
}

TEST_F(LocaleTest, ReadsWhatItHasWritten) {
  if (!Make("de_DE")) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8";
  WriteTrajectory(Path("t.txt"), TrajectoryOf(Result()));
  WriteFile(Path("o.yaml"), "tracking:\n  pose_refinement_delay: 1.25\ncamera:\n  fx: 512.5\n");
  Use("de_DE");
  EXPECT_EQ(FormatTrajectory(ReadTrajectory(Path("t.txt"))), ReadFile(Path("t.txt")));
  Configuration configuration;
  ReadConfiguration(Path("o.yaml"), &configuration);
  EXPECT_EQ(configuration.odometry.pose_refinement_delay, 1.25);
  EXPECT_EQ(configuration.camera.fx, 512.5);
}

// In Turkish, the small letter of I is another one.
TEST_F(LocaleTest, LowercaseDoesNotFollowIt) {
  if (!Make("tr_TR")) GTEST_SKIP() << "localedef cannot make tr_TR.UTF-8";
  Use("tr_TR");
  EXPECT_EQ(Lowercase("IMAGE \xC4\xB0"), "image \xC4\xB0");
  EXPECT_EQ(FormatText("%.2f", 1234.5), "1234.50");
}

}  // namespace
}  // namespace msc_vo
