// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_stamps.h"

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Seconds of image i.
using TimeOf = std::function<double(int)>;

constexpr int kNumImages = 60;

double Taken(int i) { return 1700000000.0 + i / 30.0; }

// The messages of images taken at 30 Hz.
std::vector<MessageTimes> Stream(const TimeOf& clock_offset, const TimeOf& delay) {
  std::vector<MessageTimes> times;
  for (int i = 0; i < kNumImages; ++i) {
    times.push_back({Taken(i) + clock_offset(i), Taken(i) + delay(i)});
  }
  return times;
}

TimeOf Always(double seconds) {
  return [seconds](int) { return seconds; };
}

// A delay that is uniformly distributed.
TimeOf Between(double least, double most) {
  std::mt19937 random(7);
  return [=](int) mutable { return least + (most - least) * (random() / 4294967296.0); };
}

struct Stamped {
  std::vector<double> color, depth;
  std::vector<std::string> warnings;
};

Stamped Stamp(const TopicTimes& times) {
  const auto list = [](const char* topic, size_t count) {
    std::vector<ListedImage> images;
    for (size_t i = 0; i < count; ++i) {
      images.push_back({0.0, topic + std::string(", message ") + std::to_string(i), "", -1});
    }
    return images;
  };
  ImageLists images{list("/color", times.color.size()), list("/depth", times.depth.size())};
  Stamped stamped;
  StampImages(times, &images, &stamped.warnings);
  stamped.color = TimestampsOf(images.color, &ListedImage::stamp);
  stamped.depth = TimestampsOf(images.depth, &ListedImage::stamp);
  return stamped;
}

std::vector<double> Sorted(const std::vector<MessageTimes>& times, double MessageTimes::*clock) {
  std::vector<double> stamps = TimestampsOf(times, clock);
  std::sort(stamps.begin(), stamps.end());
  return stamps;
}

void ExpectClock(const TopicTimes& times, const Stamped& stamped, double MessageTimes::*clock) {
  EXPECT_EQ(stamped.color, Sorted(times.color, clock));
  EXPECT_EQ(stamped.depth, Sorted(times.depth, clock));
}

TEST(BagStamps, AreTimesOfRecordingIfClocksDifferByLessThanTheRecordingLasts) {
  for (const auto& [offset, text, direction] :
       {std::tuple(0.42, "0.400", "later"), std::tuple(-0.38, "0.400", "earlier"),
        std::tuple(1.02, "1.000", "later")}) {
    SCOPED_TRACE(offset);
    const TopicTimes times = {Stream(Always(0.0), Always(0.01)),
                              Stream(Always(offset), Always(0.03))};
    const Stamped stamped = Stamp(times);
    ExpectClock(times, stamped, &MessageTimes::receive);
    EXPECT_THAT(stamped.warnings, ElementsAre(Names("depth", text, direction, "clocks")));
  }
}

// An offset that transport would explain if images could be recorded before they are taken.
TEST(BagStamps, AreTimesOfRecordingIfImagesWouldBeRecordedBeforeTheyAreTaken) {
  TopicTimes times = {Stream(Always(0.0), Always(0.01)), Stream(Always(0.2), Always(0.01))};
  Stamped stamped = Stamp(times);
  ExpectClock(times, stamped, &MessageTimes::receive);
  EXPECT_THAT(stamped.warnings, ElementsAre(Names("depth", "0.200", "later", "clocks")));
  // Both topics have another clock than the recorder.
  times = {Stream(Always(0.3), Always(0.21)), Stream(Always(0.3), Always(0.01))};
  stamped = Stamp(times);
  ExpectClock(times, stamped, &MessageTimes::header);
  EXPECT_THAT(stamped.warnings, ElementsAre(Names("0.200", "transport")));
}

TEST(BagStamps, AreThoseOfHeadersInSpiteOfTransportDelays) {
  for (const TimeOf& delay : {Between(0.0, 0.0), Between(0.02, 0.09)}) {
    const TopicTimes times = {Stream(Always(0.0), Always(0.0)), Stream(Always(0.0), delay)};
    const Stamped stamped = Stamp(times);
    ExpectClock(times, stamped, &MessageTimes::header);
    EXPECT_THAT(stamped.warnings, IsEmpty());
  }
  // Software registration on a slow computer, and a radio link.
  for (const TimeOf& delay : {Between(0.15, 0.25), Between(0.1, 1.2)}) {
    const TopicTimes times = {Stream(Always(0.0), Always(0.0)), Stream(Always(0.0), delay)};
    const Stamped stamped = Stamp(times);
    ExpectClock(times, stamped, &MessageTimes::header);
    EXPECT_THAT(stamped.warnings, ElementsAre(Names("earlier", "transport", "clocks")));
  }
}

TEST(BagStamps, AreThoseOfHeadersIfBothTopicsHaveAnotherClockThanTheRecorder) {
  const TopicTimes times = {Stream(Always(-900.0), Always(0.0)),
                            Stream(Always(-900.0), Always(0.02))};
  const Stamped stamped = Stamp(times);
  ExpectClock(times, stamped, &MessageTimes::header);
  EXPECT_THAT(stamped.warnings, IsEmpty());
}

TEST(BagStamps, AreTimesOfRecordingIfOneClockIsSetInTheMiddle) {
  for (const double step : {1.0, -0.5}) {
    const TopicTimes times = {
        Stream(Always(0.0), Always(0.01)),
        Stream([step](int i) { return i < kNumImages / 2 ? 0.0 : step; }, Always(0.01))};
    const Stamped stamped = Stamp(times);
    ExpectClock(times, stamped, &MessageTimes::receive);
    EXPECT_THAT(stamped.warnings, ElementsAre(Names("depth", "recorded")));
  }
}

// Sorting would interleave the images before and after the step.
TEST(BagStamps, AreTimesOfRecordingIfTheClockOfTheCameraIsSetBack) {
  const TimeOf set_back = [](int i) { return i < kNumImages / 2 ? 0.0 : -0.5; };
  const TopicTimes times = {Stream(set_back, Always(0.01)), Stream(set_back, Always(0.02))};
  const Stamped stamped = Stamp(times);
  ExpectClock(times, stamped, &MessageTimes::receive);
  EXPECT_THAT(stamped.warnings, ElementsAre(Names("colour", "go back")));
}

TEST(BagStamps, RejectBagsWhoseClocksWereAllSetBack) {
  const TimeOf set_back = [](int i) { return i < kNumImages / 2 ? 0.0 : -0.5; };
  const TopicTimes times = {Stream(set_back, set_back), Stream(set_back, set_back)};
  EXPECT_THAT(MessageOf([&] { Stamp(times); }), Names("/color, message 30", "goes back"));
  // The clock of the camera was not.
  const TopicTimes good = {Stream(Always(0.0), set_back), Stream(Always(0.0), set_back)};
  const Stamped stamped = Stamp(good);
  ExpectClock(good, stamped, &MessageTimes::header);
  EXPECT_THAT(stamped.warnings, IsEmpty());
}

TEST(BagStamps, AreThoseOfHeadersInConvertedBags) {
  // Written in 1 % of the time, depth 30 images after colour; and all at one time.
  for (const double speed : {0.01, 0.0}) {
    const auto written = [speed](int behind) {
      return [=](int i) { return 100.0 + speed * (i + behind) / 30.0 - Taken(i); };
    };
    const TopicTimes times = {Stream(Always(0.0), written(0)), Stream(Always(0.0), written(30))};
    const Stamped stamped = Stamp(times);
    ExpectClock(times, stamped, &MessageTimes::header);
    EXPECT_THAT(stamped.warnings, IsEmpty());
  }
}

TEST(BagStamps, AreThoseOfHeadersInFilesThatWereMerged) {
  TopicTimes times = {Stream(Always(0.0), Always(0.01)), Stream(Always(0.0), Always(0.02))};
  for (MessageTimes& time : times.color) time.header += 100.0 * (time.receive > Taken(30));
  for (MessageTimes& time : times.depth) time.header += 100.0 * (time.receive > Taken(30));
  std::rotate(times.color.begin(), times.color.begin() + 30, times.color.end());
  const Stamped stamped = Stamp(times);
  ExpectClock(times, stamped, &MessageTimes::header);
  EXPECT_THAT(stamped.warnings, IsEmpty());
}

}  // namespace
}  // namespace msc_vo
