// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry.h"

#include <algorithm>
#include <limits>

#include "tests/support/message_matchers.h"
#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

namespace msc_vo {
namespace {

class OdometryTest : public RoomTest {
 protected:
  static std::vector<RgbdImage> Render(const SyntheticSequenceOptions& options) {
    return RenderImages(options, kNumFrames);
  }
  static std::vector<TimedPose> TruthOf(const SyntheticSequenceOptions& options) {
    return TruePoses(options, kNumFrames);
  }

  static OdometryResult Run(const OdometryOptions& options, const std::vector<RgbdImage>& images) {
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : images) odometry.Process(image);
    return odometry.Finish();
  }
  static int Count(const OdometryResult& result, TrackingStatus status) {
    return static_cast<int>(
        std::count_if(result.frames.begin(), result.frames.end(),
                      [&](const FrameResult& f) { return f.status == status; }));
  }
};

TEST_F(OdometryTest, TracksEveryFrameOfASequence) {
  const OdometryResult result = Run(OdometryOptions(), *images_);
  ASSERT_EQ(result.frames.size(), images_->size());
  EXPECT_EQ(Count(result, TrackingStatus::kTracked), kNumFrames);
  EXPECT_GE(result.keyframes.size(), 2u);
  EXPECT_GT(result.points.size(), 200u);
  EXPECT_GT(result.lines.size(), 20u);
  // The trajectory is half a metre long; wrong signs result in errors of decimetres.
  // Measured: 1.6 mm.
  EXPECT_LT(ApeRmse(result), 0.006);
}

TEST_F(OdometryTest, TracksInEveryModeAndWithEachKindOfFeatureAlone) {
  OdometryOptions naive;
  naive.mode = Mode::kPlVo;
  // Measured: 2.7 mm, 3.7 mm without lines, 1.6 mm without points.
  EXPECT_LT(ApeRmse(Run(naive, *images_)), 0.01);
  OdometryOptions points;
  points.use_lines = false;
  EXPECT_LT(ApeRmse(Run(points, *images_)), 0.01);
  OdometryOptions lines;
  lines.use_points = false;
  const OdometryResult result = Run(lines, *images_);
  EXPECT_LT(ApeRmse(result), 0.01);
  EXPECT_TRUE(result.points.empty());
}

TEST_F(OdometryTest, IsDeterministicAtAnyThreadCount) {
  OdometryOptions one_thread;
  one_thread.threads = 1;
  OdometryOptions two_threads;
  two_threads.threads = 2;
  for (const double latency : {0.0, 0.02, 0.12}) {
    one_thread.snapshots.latency = latency;
    two_threads.snapshots.latency = latency;
    ExpectSameBytes(Run(one_thread, *images_), Run(two_threads, *images_));
  }
}

TEST_F(OdometryTest, TimesStagesNotLongerThanTheFrame) {
  OdometryOptions options;
  options.threads = 2;  // points and lines in parallel
  for (const FrameResult& frame : Run(options, *images_).frames) {
    const StageTimes& ms = frame.times;
    EXPECT_GT(ms.features, 0.0);
    EXPECT_LE(ms.features + ms.waiting + ms.matching + ms.pose, ms.tracking) << frame.id;
  }
}

TEST_F(OdometryTest, HasTheSamePosesWithALatencyShorterThanAFrame) {
  OdometryOptions none;
  none.snapshots.latency = 0.0;
  OdometryOptions shorter;
  shorter.snapshots.latency = 0.02;
  ExpectSameBytes(Run(none, *images_), Run(shorter, *images_));
}

TEST_F(OdometryTest, HasTheSamePosesInRealTimeIfNoMapIsLate) {
  OdometryOptions options;
  options.threads = 1;  // the mapper is ready at once
  const OdometryResult expected = Run(options, *images_);
  options.snapshots.realtime = true;
  const OdometryResult result = Run(options, *images_);
  EXPECT_EQ(result.num_late_maps, 0);
  ExpectSameBytes(expected, result);
}

TEST_F(OdometryTest, TracksEveryFrameInRealTime) {
  OdometryOptions options;
  options.snapshots.realtime = true;
  options.snapshots.latency = 0.0;
  const OdometryResult result = Run(options, *images_);
  EXPECT_EQ(Count(result, TrackingStatus::kTracked), kNumFrames);
  EXPECT_LT(ApeRmse(result), 0.006);  // as without real time
}

TEST_F(OdometryTest, ThrowsAnErrorOfTheMapperAndContinues) {
  for (const int threads : {1, 2}) {
    OdometryOptions options;
    options.threads = threads;
    Odometry odometry(options, camera_, LensDistortion());
    odometry.SetWindowObserver(
        [](KeyframeId keyframe, const BundleAdjustmentOptions&, const WindowData&) {
          if (keyframe == 1) throw std::runtime_error("disk full");
        });
    int num_errors = 0;
    for (const RgbdImage& image : *images_) {
      try {
        odometry.Process(image);
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "disk full");
        ++num_errors;
      }
    }
    EXPECT_EQ(num_errors, 1);
    const OdometryResult result = odometry.Finish();
    EXPECT_EQ(result.frames.size(), images_->size());
    EXPECT_LT(ApeRmse(result), 0.01);
  }
}

TEST_F(OdometryTest, ThrowsAPendingErrorOnFinishOnce) {
  OdometryOptions options;
  options.snapshots.insertion_latency = options.snapshots.latency = 2.0;
  Odometry odometry(options, camera_, LensDistortion());
  odometry.SetWindowObserver([](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) {
    throw std::runtime_error("disk full");
  });
  for (const RgbdImage& image : *images_) odometry.Process(image);
  EXPECT_THROW(odometry.Finish(), std::runtime_error);
  EXPECT_EQ(odometry.Finish().frames.size(), images_->size());
}

// Depth 12 ms late, at 2 radians per second: 6 px.
TEST_F(OdometryTest, AlignsDepthToTheTimeOfTheColourImage) {
  SyntheticSequenceOptions scene = RoomOptions();
  scene.kinect_depth = false;
  scene.path.speed = 1.0;
  scene.path.turn_rate = 2.0;
  scene.depth_delay = 0.012;
  std::vector<RgbdImage> images = Render(scene);
  const std::vector<TimedPose> truth = TruthOf(scene);
  OdometryOptions options;
  options.threads = 1;
  const double ignored = ApeRmse(Run(options, images), truth);
  for (RgbdImage& image : images) image.depth_delay = scene.depth_delay;
  const OdometryResult aligned = Run(options, images);
  EXPECT_EQ(Count(aligned, TrackingStatus::kTracked), kNumFrames);
  EXPECT_LT(ApeRmse(aligned, truth), 0.7 * ignored);  // measured: 0.46
  options.align_depth = false;
  EXPECT_EQ(ApeRmse(Run(options, images), truth), ignored);
}

// Rows over 30 ms, at 2 radians per second: 16 px from the first to the last.
TEST_F(OdometryTest, CompensatesForAKnownRollingShutter) {
  SyntheticSequenceOptions scene = RoomOptions();
  scene.path.speed = 1.0;
  scene.path.turn_rate = 2.5;
  const std::vector<TimedPose> truth = TruthOf(scene);
  OdometryOptions options;
  options.features.points.num_points = 1000;  // as the ratios below
  const double global = ApeRmse(Run(options, Render(scene)), truth);
  scene.readout_time = 0.03;
  const std::vector<RgbdImage> images = Render(scene);
  options.mapping.readout_time = 0.0;
  EXPECT_GT(ApeRmse(Run(options, images), truth), 1.4 * global);  // measured: 2.46
  options.mapping.readout_time = scene.readout_time;
  const OdometryResult known = Run(options, images);
  EXPECT_EQ(Count(known, TrackingStatus::kTracked), kNumFrames);
  EXPECT_EQ(known.readout_time, scene.readout_time);
  EXPECT_LT(ApeRmse(known, truth), 1.2 * global);  // measured: 0.87
}

TEST_F(OdometryTest, BridgesBlackFramesByPrediction) {
  std::vector<RgbdImage> images = *images_;
  for (const int i : {0, 1, 25, 26, 27, 28}) Cover(&images[i]);
  const OdometryResult result = Run(OdometryOptions(), images);
  EXPECT_EQ(result.frames[0].status, TrackingStatus::kLost);
  EXPECT_EQ(result.frames[1].status, TrackingStatus::kLost);
  for (const int i : {25, 26, 27, 28}) {
    EXPECT_EQ(result.frames[i].status, TrackingStatus::kPredicted) << i;
  }
  EXPECT_EQ(Count(result, TrackingStatus::kTracked), kNumFrames - 6);
  EXPECT_LT(ApeRmse(result), 0.012);  // measured: 3.6 mm
}

TEST_F(OdometryTest, InterpolatesThePosesOfDroppedFrames) {
  Odometry odometry(OdometryOptions(), camera_, LensDistortion());
  for (const RgbdImage& image : *images_) {
    if (image.id % 10 == 5) {
      odometry.Drop(image.id, image.timestamp);
    } else {
      odometry.Process(image);
    }
  }
  const OdometryResult result = odometry.Finish();
  ASSERT_EQ(result.frames.size(), images_->size());
  EXPECT_EQ(Count(result, TrackingStatus::kDropped), kNumFrames / 10);
  EXPECT_EQ(result.frames[15].status, TrackingStatus::kDropped);
  EXPECT_EQ(result.frames[15].id, 15);
  EXPECT_EQ(result.frames[15].timestamp, (*images_)[15].timestamp);
  EXPECT_LT(ApeRmse(result), 0.006);
  EXPECT_THROW(odometry.Drop(3, (*images_)[3].timestamp), std::invalid_argument);
}

TEST_F(OdometryTest, AcceptsOnlyStatusesOfFramesWithoutImageInDrop) {
  Odometry odometry(OdometryOptions(), camera_, LensDistortion());
  EXPECT_EQ(odometry.Drop(0, 0.0, TrackingStatus::kUnreadable).status, TrackingStatus::kUnreadable);
  EXPECT_EQ(odometry.Drop(1, 1.0).status, TrackingStatus::kDropped);
  EXPECT_THROW(odometry.Drop(2, 2.0, TrackingStatus::kLost), std::invalid_argument);
  EXPECT_EQ(odometry.Finish().frames.size(), 2u);
}

// Paints a board with a coarse random pattern over 28 % of the image, 1 m away, that moves from
// left to right in front of the room.
void PaintBoard(int step, int num_steps, RgbdImage* image) {
  const int width = image->gray.cols, height = image->gray.rows;
  const int half = static_cast<int>(0.14 * width);
  const int center = step * width / num_steps;
  const cv::Rect area(std::max(0, center - half), height / 10,
                      std::min(width, center + half) - std::max(0, center - half),
                      height - height / 10);
  cv::Mat cells(40, 16, CV_8UC1), pattern;
  cv::RNG(1).fill(cells, cv::RNG::UNIFORM, 0, 256);
  cv::resize(cells, pattern, cv::Size(2 * half, area.height), 0.0, 0.0, cv::INTER_LINEAR);
  pattern(cv::Rect(0, 0, area.width, area.height)).copyTo(image->gray(area));
  image->depth(area) = 1.0f;
}

std::vector<RgbdImage> WithBoard(std::vector<RgbdImage> images, int first, int num_steps) {
  for (RgbdImage& image : images) {
    const int step = static_cast<int>(image.id) - first;
    if (step < 0 || step >= num_steps) continue;
    image.gray = image.gray.clone();
    image.depth = image.depth.clone();
    PaintBoard(step, num_steps, &image);
  }
  return images;
}

TEST_F(OdometryTest, RejectsADynamicObject) {
  constexpr int kNumSteps = 30;
  OdometryOptions options;
  for (const int first : {9, 15}) {
    SCOPED_TRACE(first);
    const OdometryResult result = Run(options, WithBoard(*images_, first, kNumSteps));
    EXPECT_EQ(Count(result, TrackingStatus::kTracked), kNumFrames);
    EXPECT_LT(ApeRmse(result), 0.006);  // as without the board
    EXPECT_EQ(result.frames[first - 5].num_dynamic, 0);
    EXPECT_GT(result.frames[first + kNumSteps / 2].num_dynamic, 50);
  }
  options.tracking.pose.consensus.enabled = false;
  EXPECT_GT(ApeRmse(Run(options, WithBoard(*images_, 15, kNumSteps))), 0.03);
}

TEST_F(OdometryTest, ReturnsAResultAtAnyTime) {
  Odometry odometry(OdometryOptions(), camera_, LensDistortion());
  EXPECT_TRUE(odometry.Finish().frames.empty());
  odometry.Process((*images_)[0]);
  EXPECT_EQ(odometry.Finish().frames.size(), 1u);
  odometry.Process((*images_)[1]);
  EXPECT_EQ(odometry.Finish().frames.size(), 2u);
}

// The undistortion of such a lens results in features with NaN pixels.
TEST_F(OdometryTest, RefusesADistortionThatIsNotInvertible) {
  const LensDistortion swapped{{0.262383, -0.953104, 1.163314, -0.005358, 0.002628}};
  EXPECT_THROW(Odometry(OdometryOptions(), camera_, swapped), std::invalid_argument);
  PinholeCamera mirrored = camera_;
  mirrored.fx = -mirrored.fx;
  EXPECT_THROW(Odometry(OdometryOptions(), mirrored, LensDistortion()), std::invalid_argument);
}

TEST_F(OdometryTest, RefusesInvalidTimeStamps) {
  Odometry odometry(OdometryOptions(), camera_, LensDistortion());
  const auto error_of = [&](double timestamp, double depth_delay) {
    RgbdImage image = (*images_)[0];
    image.timestamp = timestamp;
    image.depth_delay = depth_delay;
    try {
      odometry.Process(image);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double time : {nan, inf, -inf}) {
    EXPECT_THAT(error_of(time, 0.0), Names("image 0", "time stamp", "finite"));
    EXPECT_THROW(odometry.Drop(0, time), std::invalid_argument);
  }
  for (const double delay : {nan, inf, -1.5, 1e9}) {
    EXPECT_THAT(error_of(0.0, delay), Names("image 0", "depth_delay"));
  }
  EXPECT_EQ(error_of(0.0, 0.02), "");
}

TEST_F(OdometryTest, RefusesInvalidOptionsAndDescendingTimeStamps) {
  OdometryOptions bad;
  bad.use_points = false;
  bad.use_lines = false;
  EXPECT_THROW(Odometry(bad, camera_, LensDistortion()), std::invalid_argument);
  Odometry odometry(OdometryOptions(), camera_, LensDistortion());
  odometry.Process((*images_)[3]);
  try {
    odometry.Process((*images_)[2]);
    FAIL() << "a descending time stamp was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), Names("image 2", "time stamp"));
  }
}

}  // namespace
}  // namespace msc_vo
