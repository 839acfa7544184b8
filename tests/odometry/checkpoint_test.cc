// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A run that is saved and restored gives the same results as one that is not, bit by bit.

#include <functional>
#include <memory>

#include "tests/support/rendered_images.h"
#include <gtest/gtest.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

// All results but the times, as bytes.
std::string Bytes(const OdometryResult& result) {
  ObjectJournal journal;
  BinaryWriter writer(&journal);
  for (FrameResult frame : result.frames) {
    frame.times = {};
    writer(frame);
  }
  for (const Segment& segment : result.segments) {
    writer(segment.first_frame, segment.last_frame, segment.num_estimated, segment.world,
           segment.join.has_value());
    if (segment.join) writer(segment.join->frame, segment.join->translation_sigma);
  }
  for (const TimedPose& pose : result.keyframes) writer(pose.timestamp, pose.world_from_cam);
  for (const MapPoint& point : result.points) writer(point.position, point.num_observations);
  for (const MapLine& line : result.lines) {
    writer(line.segment, line.num_observations, line.in_last_window, line.axis,
           line.viewing_direction);
  }
  writer(result.axes.state, result.axes.num_refinements, result.axes.world_from_axes,
         result.axes.sigma, result.noise_scale, result.depth_sensor, result.readout_time,
         result.calibration, result.last_window);
  return writer.bytes();
}

// Short searches, so that the segments of the sequence are found and joined, and poses that are
// estimated again soon.
OdometryOptions Options(int threads) {
  OdometryOptions options;
  options.threads = threads;
  options.pose_refinement_delay = 0.3;
  options.tracking.max_prediction = 0.2;
  options.tracking.segments.min_search = 0.3;
  options.tracking.segments.search_interval = 0.1;
  return options;
}

using MakeOdometry = std::function<std::unique_ptr<Odometry>(int threads)>;

void Process(const RgbdImage& image, Odometry* odometry) {
  if (image.id % 17 == 5) {
    odometry->Drop(image.id, image.timestamp, TrackingStatus::kUnreadable);
  } else {
    odometry->Process(image);
  }
}

// Runs the sequence. After each image for which `is_saved` holds, the run is saved, and another
// object continues it.
OdometryResult RunImages(const MakeOdometry& make, const std::vector<int>& threads,
                         const std::function<bool(int)>& is_saved,
                         const std::vector<RgbdImage>& sequence) {
  std::unique_ptr<Odometry> odometry = make(threads.front());
  size_t num_saved = 0;
  for (const RgbdImage& image : sequence) {
    Process(image, odometry.get());
    if (!is_saved(static_cast<int>(image.id))) continue;
    ObjectJournal journal;
    BinaryWriter writer(&journal);
    EXPECT_TRUE(odometry->Save(&writer));
    odometry = make(threads[++num_saved % threads.size()]);
    ObjectJournal loaded(journal.pending());
    BinaryReader reader(writer.bytes(), &loaded);
    odometry->Restore(&reader);
    reader.Finish();
  }
  return odometry->Finish();
}

class CheckpointTest : public RoomTest {
 protected:
  static void SetUpTestSuite() {
    RoomTest::SetUpTestSuite();
    SyntheticSequenceOptions other = RoomOptions();
    other.seed = 7;
    const std::vector<RgbdImage> other_room = RenderImages(other, 25);
    sequence_ = new std::vector<RgbdImage>;
    Append(*images_, 0, 29);
    Append(other_room, 0, 24);
    Append(*images_, 10, 45);
  }
  static void TearDownTestSuite() {
    delete sequence_;
    RoomTest::TearDownTestSuite();
  }
  static void Append(const std::vector<RgbdImage>& room, int first, int last) {
    for (int i = first; i <= last; ++i) {
      RgbdImage image = room[i];
      image.id = static_cast<int64_t>(sequence_->size());
      image.timestamp = static_cast<double>(image.id) / 30.0;
      sequence_->push_back(image);
    }
  }

  static std::unique_ptr<Odometry> MakeDefault(int threads) {
    return std::make_unique<Odometry>(Options(threads), camera_, LensDistortion());
  }

  static OdometryResult Run(const MakeOdometry& make, const std::vector<int>& threads,
                            const std::function<bool(int)>& is_saved) {
    return RunImages(make, threads, is_saved, *sequence_);
  }

  static inline std::vector<RgbdImage>* sequence_ = nullptr;
};

TEST_F(CheckpointTest, ContinuesWithTheSameResultsFromEveryImageAtAnyNumberOfThreads) {
  const OdometryResult expected = Run(MakeDefault, {1}, [](int) { return false; });
  ASSERT_EQ(expected.segments.size(), 3u);
  ASSERT_TRUE(expected.segments[2].join.has_value());
  const std::string bytes = Bytes(expected);
  EXPECT_EQ(Bytes(Run(MakeDefault, {1, 3, 2}, [](int) { return true; })), bytes);
  EXPECT_EQ(Bytes(Run(MakeDefault, {2}, [](int i) { return i % 7 == 3; })), bytes);
}

TEST_F(CheckpointTest, SavingDoesNotChangeARun) {
  std::unique_ptr<Odometry> saved = MakeDefault(2);
  std::unique_ptr<Odometry> plain = MakeDefault(1);
  ObjectJournal journal;
  for (const RgbdImage& image : *sequence_) {
    Process(image, saved.get());
    Process(image, plain.get());
    BinaryWriter writer(&journal);
    ASSERT_TRUE(saved->Save(&writer));
    journal.Keep(writer.objects());
  }
  EXPECT_EQ(Bytes(saved->Finish()), Bytes(plain->Finish()));
}

// The reach of a sensor whose near surfaces bleed is estimated from the images.
TEST_F(CheckpointTest, SavesWhatTheImagesTellAboutTheSensor) {
  const auto make = [](int threads) {
    OdometryOptions options = Options(threads);
    options.features.depth_sensor = DepthSensor::kStereo;
    return std::make_unique<Odometry>(options, camera_, LensDistortion());
  };
  const OdometryResult expected = Run(make, {1}, [](int) { return false; });
  EXPECT_NE(expected.noise_scale.point_depth, 1.0);
  EXPECT_EQ(Bytes(Run(make, {1}, [](int i) { return i % 3 == 0; })), Bytes(expected));
}

TEST_F(CheckpointTest, SavesNothingWhileAnExceptionOfTheMapperIsPending) {
  OdometryOptions options;
  options.snapshots.insertion_latency = 0.085;
  options.snapshots.latency = 0.085;
  options.mapping.min_window_interval = 0.0;
  Odometry odometry(options, camera_, LensDistortion());
  odometry.SetWindowObserver([](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) {
    throw std::runtime_error("the disk is full");
  });
  ObjectJournal journal;
  bool was_refused = false;
  bool has_thrown = false;
  for (const RgbdImage& image : *images_) {
    try {
      odometry.Process(image);
    } catch (const std::runtime_error&) {
      has_thrown = true;
    }
    BinaryWriter writer(&journal);
    const bool saved = odometry.Save(&writer);
    EXPECT_EQ(writer.bytes().empty(), !saved);
    if (!has_thrown && !saved) was_refused = true;
    if (has_thrown) break;
  }
  EXPECT_TRUE(was_refused);
  EXPECT_TRUE(has_thrown);
}

// A run with a focal length that is not that of its camera.
TEST(CheckpointOfSelfCalibration, ContinuesWithACorrectedCalibration) {
  SyntheticSequenceOptions room = RoomOptions();
  room.fps = 5.0;
  PinholeCamera given = SyntheticSequence(room).camera();
  given.fx *= 1.1;
  given.fy *= 1.1;
  const std::vector<RgbdImage> images = RenderImages(room, 46);
  const auto make = [&](int threads) {
    return std::make_unique<Odometry>(Options(threads), given, LensDistortion());
  };
  const auto never = [](int) { return false; };
  const auto often = [](int i) { return i % 4 == 3; };
  const OdometryResult expected = RunImages(make, {1}, never, images);
  EXPECT_TRUE(expected.calibration.is_corrected[0]);
  EXPECT_EQ(Bytes(RunImages(make, {2, 1}, often, images)), Bytes(expected));
}

}  // namespace
}  // namespace msc_vo
