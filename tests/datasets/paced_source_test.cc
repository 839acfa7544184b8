// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/paced_source.h"

#include <map>

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInterval = 1.0 / 32.0;  // seconds, between images; exact in binary

// Ten images from 100 s on, and a clock that advances only by tests and sleeps.
class PacedSourceTest : public TemporaryFolder {
 protected:
  // `pause` is added to the interval before image 5, seconds.
  RgbdDecoder Decoder(double pause = 0.0, double interval = kInterval) {
    SequenceIndex index;
    for (int i = 0; i < 10; ++i) {
      const std::string name = std::to_string(i);
      cv::imwrite(Path(name + ".png"), cv::Mat(6, 8, CV_8UC1, cv::Scalar(i)));
      cv::imwrite(Path(name + "d.png"), cv::Mat(6, 8, CV_16UC1, cv::Scalar(1000)));
      index.entries.push_back({100.0 + i * interval + (i >= 5 ? pause : 0.0), Path(name + ".png"),
                               Path(name + "d.png"), ""});
    }
    Calibration calibration;
    calibration.camera = {10.0, 10.0, 3.5, 2.5, 8, 6};
    calibration.depth_scale = 1000.0;
    return {index, calibration};
  }
  PacingClock Clock() {
    return {[this] { return now_; }, [this](double time) { now_ = std::max(now_, time); }};
  }
  // Returns the id of the next image; -1 at the end.
  int64_t Next(PacedSource* source) {
    dropped_.clear();
    RgbdImage image;
    return source->Next(&image, &dropped_) ? image.id : -1;
  }

  double now_ = 5.0;
  std::vector<int> dropped_;
};

TEST_F(PacedSourceTest, FastReaderWaitsForEachImage) {
  const RgbdDecoder decoder = Decoder();
  PacedSource source(decoder, 0, 10, Clock());
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(Next(&source), i);
    EXPECT_THAT(dropped_, IsEmpty());
    EXPECT_DOUBLE_EQ(now_, 5.0 + i * kInterval);
    EXPECT_DOUBLE_EQ(source.Age(), 0.0);
    now_ += 0.4 * kInterval;  // processing time
    EXPECT_NEAR(source.Age(), 0.4 * kInterval, 1e-9);
    now_ -= i % 2 == 0 ? 0.0 : 0.2 * kInterval;
  }
  EXPECT_EQ(Next(&source), -1);
}

TEST_F(PacedSourceTest, QueuesThreeImagesForSlowReader) {
  const RgbdDecoder decoder = Decoder();
  PacedSource source(decoder, 2, 10, Clock());
  EXPECT_EQ(Next(&source), 2);
  now_ += 1.5 * kInterval;  // image 4 does not exist yet
  EXPECT_EQ(Next(&source), 3);
  EXPECT_THAT(dropped_, IsEmpty());
  EXPECT_DOUBLE_EQ(source.Age(), 0.5 * kInterval);
  now_ += 2.6 * kInterval;  // images 4 to 6 are queued
  EXPECT_EQ(Next(&source), 4);
  EXPECT_THAT(dropped_, IsEmpty());
  EXPECT_NEAR(source.Age(), 2.1 * kInterval, 1e-9);
  now_ += 2.0 * kInterval;  // and 7 and 8
  EXPECT_EQ(Next(&source), 6);
  EXPECT_THAT(dropped_, ElementsAre(5));
  EXPECT_NEAR(source.Age(), 2.1 * kInterval, 1e-9);
  for (int i = 7; i < 10; ++i) {  // without processing time
    EXPECT_EQ(Next(&source), i);
    EXPECT_THAT(dropped_, IsEmpty());
  }
  EXPECT_EQ(Next(&source), -1);
}

TEST_F(PacedSourceTest, DropsOldestImagesWhenQueueIsFull) {
  const RgbdDecoder decoder = Decoder();
  PacedSource source(decoder, 0, 10, Clock());
  EXPECT_EQ(Next(&source), 0);
  now_ += 100.0;
  EXPECT_EQ(Next(&source), 7);
  EXPECT_THAT(dropped_, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(PacedSourceTest, QueuesATenthOfASecondAtAnyRate) {
  const std::map<double, int> num_waiting = {{5.0, 1}, {10.0, 1}, {15.0, 2}, {30.0, 3}, {60.0, 6}};
  for (const auto& [rate, count] : num_waiting) {
    const RgbdDecoder decoder = Decoder(0.0, 1.0 / rate);
    PacedSource source(decoder, 0, 10, Clock());
    EXPECT_EQ(Next(&source), 0);
    now_ += 100.0;
    EXPECT_EQ(Next(&source), 10 - count) << rate;
    EXPECT_EQ(dropped_.size(), 9u - count) << rate;
  }
}

TEST_F(PacedSourceTest, CutsLongPauses) {
  for (const double pause : {86400.0, 1e300}) {
    const RgbdDecoder decoder = Decoder(pause);
    PacedSource source(decoder, 0, 10, Clock());
    now_ = 5.0;
    for (int i = 0; i < 6; ++i) EXPECT_EQ(Next(&source), i);
    EXPECT_DOUBLE_EQ(now_, 5.0 + 4.0 * kInterval + PacedSource::kMaxPause);
  }
}

TEST_F(PacedSourceTest, NamesBadImageAndKeepsOtherTimes) {
  const RgbdDecoder decoder = Decoder();
  for (const int bad : {0, 4}) std::filesystem::remove(Path(std::to_string(bad) + "d.png"));
  PacedSource source(decoder, 0, 10, Clock());
  EXPECT_THAT(MessageOf([&] { Next(&source); }), HasSubstr("0d.png"));
  for (int i = 1; i < 4; ++i) {
    EXPECT_EQ(Next(&source), i);
    EXPECT_DOUBLE_EQ(now_, 5.0 + (i - 1) * kInterval);
  }
  EXPECT_THAT(MessageOf([&] { Next(&source); }), HasSubstr("4d.png"));
  EXPECT_EQ(Next(&source), 5);
  EXPECT_DOUBLE_EQ(now_, 5.0 + 4.0 * kInterval);
}

TEST_F(PacedSourceTest, IgnoresErrorsInDroppedImages) {
  const RgbdDecoder decoder = Decoder();
  for (const int bad : {1, 2}) std::filesystem::remove(Path(std::to_string(bad) + "d.png"));
  PacedSource source(decoder, 0, 10, Clock());
  EXPECT_EQ(Next(&source), 0);
  now_ += 5.0 * kInterval;
  EXPECT_EQ(Next(&source), 3);
  EXPECT_THAT(dropped_, ElementsAre(1, 2));
}

TEST(PacingClock, SteadyClockSleeps) {
  const PacingClock clock = PacingClock::Steady();
  const double start = clock.now();
  clock.sleep_until(start + 0.02);
  EXPECT_GE(clock.now(), start + 0.02);
}

}  // namespace
}  // namespace msc_vo
