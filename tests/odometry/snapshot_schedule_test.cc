// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/snapshot_schedule.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ElementsAre;

// A mapper that is as fast as the test says: TryTake() finds `num_ready` steps, Take() any. Step 2
// k leaves the map that keyframe k was inserted into, step 2 k + 1 the refined one; the newest
// keyframe of a map here is the number of its step.
class FakeRunner : public MappingRunner {
 public:
  void Submit(KeyframePacket) override { num_submitted_ += 2; }
  MappingStep Take() override {
    if (num_taken_ == num_submitted_) throw std::logic_error("nothing under way");
    const int number = num_taken_++;
    MappingStep step;
    step.summary.keyframe = number / 2;
    if (number == failing) {
      step.error = std::make_exception_ptr(std::runtime_error("disk full"));
    } else if (!IsRefinementOfFailed(number)) {
      auto snapshot = std::make_shared<MapSnapshot>();
      snapshot->map.AddKeyframe(std::make_shared<Frame>(), Rigid3());
      snapshot->newest_keyframe = number;
      step.snapshot = std::move(snapshot);
    }
    return step;
  }
  std::optional<MappingStep> TryTake() override {
    if (num_ready <= num_taken_) return std::nullopt;
    return Take();
  }

  int num_ready = 0;
  int failing = -2;

 private:
  bool IsRefinementOfFailed(int number) const { return number % 2 == 1 && number == failing + 1; }

  int num_submitted_ = 0;
  int num_taken_ = 0;
};

class SnapshotScheduleTest : public testing::Test {
 protected:
  SnapshotSchedule MakeSchedule(int insertion_latency_frames, int latency_frames,
                                bool realtime = false) {
    auto runner = std::make_unique<FakeRunner>();
    runner_ = runner.get();
    return {{insertion_latency_frames, latency_frames, realtime},
            std::move(runner),
            std::make_shared<MapSnapshot>(),
            [this](int frame, const MappingStep&) { recorded_.push_back(frame); }};
  }
  // The step whose map each frame from `begin` to `end - 1` sees.
  static std::vector<int> Seen(SnapshotSchedule* schedule, int begin, int end) {
    std::vector<int> seen;
    for (int i = begin; i < end; ++i) seen.push_back(schedule->SnapshotAt(i)->newest_keyframe);
    return seen;
  }

  FakeRunner* runner_ = nullptr;
  std::vector<int> recorded_;
};

TEST_F(SnapshotScheduleTest, AMapIsSeenSoManyFramesBehindItsKeyframeHoweverFastTheMapperIs) {
  for (const int num_ready : {0, 6}) {
    recorded_.clear();
    SnapshotSchedule schedule = MakeSchedule(1, 3);
    runner_->num_ready = num_ready;
    EXPECT_EQ(schedule.SnapshotAt(0)->newest_keyframe, kNoId);
    schedule.Submit(0, {});
    EXPECT_THAT(Seen(&schedule, 0, 5), ElementsAre(0, 0, 0, 1, 1));  // the first is waited for
    schedule.Submit(4, {});
    EXPECT_THAT(Seen(&schedule, 4, 9), ElementsAre(1, 2, 2, 3, 3));
    schedule.Submit(8, {});
    EXPECT_THAT(Seen(&schedule, 8, 12), ElementsAre(3, 4, 4, 5));
    EXPECT_THAT(recorded_, ElementsAre(0, 0, 4, 4, 8, 8));
  }
}

TEST_F(SnapshotScheduleTest, AKeyframeIsInsertedIntoAMapThatHasBeenRefined) {
  SnapshotSchedule schedule = MakeSchedule(1, 9);
  schedule.Submit(0, {});
  EXPECT_THAT(Seen(&schedule, 0, 3), ElementsAre(0, 0, 0));
  schedule.Submit(2, {});
  EXPECT_THAT(Seen(&schedule, 2, 5), ElementsAre(0, 2, 2));
}

TEST_F(SnapshotScheduleTest, WithoutLatencyAKeyframeSeesItsOwnMap) {
  SnapshotSchedule schedule = MakeSchedule(1, 0);
  schedule.Submit(0, {});
  schedule.SnapshotAt(0);
  schedule.Submit(1, {});
  EXPECT_EQ(schedule.SnapshotAt(1)->newest_keyframe, 3);
}

TEST_F(SnapshotScheduleTest, InsertionIsNotLaterThanRefinement) {
  SnapshotSchedule schedule = MakeSchedule(5, 2);
  schedule.Submit(0, {});
  schedule.SnapshotAt(0);
  schedule.Submit(4, {});
  EXPECT_THAT(Seen(&schedule, 4, 7), ElementsAre(1, 1, 3));
}

TEST_F(SnapshotScheduleTest, InRealTimeNoFrameWaitsForAMapThatIsLate) {
  SnapshotSchedule schedule = MakeSchedule(1, 3, true);
  schedule.Submit(0, {});
  EXPECT_EQ(schedule.SnapshotAt(1)->newest_keyframe, 0);  // waited for
  schedule.Submit(1, {});
  EXPECT_THAT(Seen(&schedule, 2, 20), testing::Each(0));  // nothing else is
  EXPECT_EQ(schedule.num_late(), 1);
  runner_->num_ready = 3;
  EXPECT_EQ(schedule.SnapshotAt(20)->newest_keyframe, 2);
  EXPECT_EQ(schedule.num_late(), 2);
  runner_->num_ready = 4;
  EXPECT_EQ(schedule.SnapshotAt(21)->newest_keyframe, 3);
  EXPECT_EQ(schedule.num_late(), 2);
}

TEST_F(SnapshotScheduleTest, InRealTimeFramesSeeWhatTheyAlwaysSeeIfNoMapIsLate) {
  SnapshotSchedule schedule = MakeSchedule(1, 3, true);
  runner_->num_ready = 6;
  schedule.Submit(0, {});
  EXPECT_THAT(Seen(&schedule, 0, 5), ElementsAre(0, 0, 0, 1, 1));
  schedule.Submit(4, {});
  EXPECT_THAT(Seen(&schedule, 4, 7), ElementsAre(1, 2, 2));
  schedule.Submit(6, {});
  EXPECT_THAT(Seen(&schedule, 6, 10), ElementsAre(2, 4, 4, 5));
  EXPECT_EQ(schedule.num_late(), 0);
}

TEST_F(SnapshotScheduleTest, DrainingRecordsAllAndChangesNothingForTheFrames) {
  SnapshotSchedule schedule = MakeSchedule(1, 3);
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(3, {});
  schedule.Drain();
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 3, 3));
  EXPECT_THAT(Seen(&schedule, 3, 7), ElementsAre(1, 2, 2, 3));
  schedule.Drain();
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 3, 3));
}

TEST_F(SnapshotScheduleTest, AnErrorIsThrownOnceWhereItsMapIsMissing) {
  SnapshotSchedule schedule = MakeSchedule(1, 3);
  runner_->failing = 3;
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, {});
  EXPECT_THAT(Seen(&schedule, 2, 4), ElementsAre(2, 2));
  EXPECT_THROW(schedule.SnapshotAt(4), std::runtime_error);
  schedule.Submit(4, {});
  EXPECT_THAT(Seen(&schedule, 4, 8), ElementsAre(2, 4, 4, 5));
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 1, 4, 4));
}

TEST_F(SnapshotScheduleTest, WhatCouldNotBeInsertedLeavesNoMap) {
  SnapshotSchedule schedule = MakeSchedule(1, 3);
  runner_->failing = 2;
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(3, {});
  EXPECT_THROW(schedule.SnapshotAt(4), std::runtime_error);
  EXPECT_THAT(Seen(&schedule, 4, 8), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(recorded_, ElementsAre(0, 0));
}

TEST_F(SnapshotScheduleTest, DrainingThrowsAnErrorThatNobodyHeardOf) {
  SnapshotSchedule schedule = MakeSchedule(1, 5);
  runner_->failing = 3;
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, {});
  EXPECT_THROW(schedule.Drain(), std::runtime_error);
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 1));
  EXPECT_NO_THROW(schedule.Drain());
  EXPECT_THAT(Seen(&schedule, 1, 9), ElementsAre(0, 2, 2, 2, 2, 2, 2, 2));
}

TEST_F(SnapshotScheduleTest, NegativeLatencyIsRefused) {
  std::string error;
  EXPECT_FALSE((SnapshotOptions{1, -1, false}).IsValid(&error));
  EXPECT_THAT(error, testing::HasSubstr("mapping.latency_frames"));
  EXPECT_FALSE((SnapshotOptions{-1, 1, false}).IsValid(&error));
  EXPECT_THAT(error, testing::HasSubstr("insertion_latency_frames"));
}

}  // namespace
}  // namespace msc_vo
