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

// A mapper that is as fast as the test says: TryTake() finds `num_ready` steps, Take() any. Step i
// leaves a map whose newest keyframe is i.
class FakeRunner : public MappingRunner {
 public:
  void Submit(KeyframePacket) override { ++num_submitted_; }
  MappingStep Take() override {
    if (num_taken_ == num_submitted_) throw std::logic_error("nothing under way");
    MappingStep step;
    step.summary.keyframe = num_taken_++;
    if (step.summary.keyframe == failing) {
      step.error = std::make_exception_ptr(std::runtime_error("disk full"));
      return step;
    }
    auto snapshot = std::make_shared<MapSnapshot>();
    snapshot->map.AddKeyframe(std::make_shared<Frame>(), Rigid3());
    snapshot->newest_keyframe = step.summary.keyframe;
    step.snapshot = std::move(snapshot);
    return step;
  }
  std::optional<MappingStep> TryTake() override {
    if (num_ready <= num_taken_) return std::nullopt;
    return Take();
  }

  int num_ready = 0;
  int failing = -1;

 private:
  int num_submitted_ = 0;
  int num_taken_ = 0;
};

class SnapshotScheduleTest : public testing::Test {
 protected:
  SnapshotSchedule MakeSchedule(int latency_frames, bool realtime = false) {
    auto runner = std::make_unique<FakeRunner>();
    runner_ = runner.get();
    return {{latency_frames, realtime},
            std::move(runner),
            std::make_shared<MapSnapshot>(),
            [this](int frame, const MappingStep&) { recorded_.push_back(frame); }};
  }
  // The newest keyframe that each frame from `begin` to `end - 1` sees.
  static std::vector<KeyframeId> Seen(SnapshotSchedule* schedule, int begin, int end) {
    std::vector<KeyframeId> seen;
    for (int i = begin; i < end; ++i) seen.push_back(schedule->SnapshotAt(i)->newest_keyframe);
    return seen;
  }

  FakeRunner* runner_ = nullptr;
  std::vector<int> recorded_;
};

TEST_F(SnapshotScheduleTest, AMapIsSeenSoManyFramesBehindItsKeyframeHoweverFastTheMapperIs) {
  for (const int num_ready : {0, 3}) {
    recorded_.clear();
    SnapshotSchedule schedule = MakeSchedule(3);
    runner_->num_ready = num_ready;
    EXPECT_EQ(schedule.SnapshotAt(0)->newest_keyframe, kNoId);
    schedule.Submit(0, {});
    EXPECT_THAT(Seen(&schedule, 0, 5), ElementsAre(0, 0, 0, 0, 0));  // the first is waited for
    schedule.Submit(4, {});
    EXPECT_THAT(Seen(&schedule, 4, 7), ElementsAre(0, 0, 0));
    schedule.Submit(6, {});
    EXPECT_THAT(Seen(&schedule, 6, 11), ElementsAre(0, 1, 1, 2, 2));
    EXPECT_THAT(recorded_, ElementsAre(0, 4, 6));
  }
}

TEST_F(SnapshotScheduleTest, WithoutLatencyAKeyframeSeesItsOwnMap) {
  SnapshotSchedule schedule = MakeSchedule(0);
  schedule.Submit(0, {});
  schedule.SnapshotAt(0);
  schedule.Submit(1, {});
  EXPECT_EQ(schedule.SnapshotAt(1)->newest_keyframe, 1);
}

TEST_F(SnapshotScheduleTest, InRealTimeNoFrameWaitsForAMapThatIsLate) {
  SnapshotSchedule schedule = MakeSchedule(3, true);
  schedule.Submit(0, {});
  EXPECT_EQ(schedule.SnapshotAt(1)->newest_keyframe, 0);  // waited for
  schedule.Submit(1, {});
  schedule.Submit(3, {});
  EXPECT_THAT(Seen(&schedule, 4, 20), testing::Each(0));  // nothing else is
  EXPECT_EQ(schedule.num_late(), 1);
  runner_->num_ready = 2;
  EXPECT_EQ(schedule.SnapshotAt(20)->newest_keyframe, 1);
  EXPECT_EQ(schedule.num_late(), 2);
  runner_->num_ready = 3;
  EXPECT_EQ(schedule.SnapshotAt(21)->newest_keyframe, 2);
  EXPECT_EQ(schedule.num_late(), 2);
}

TEST_F(SnapshotScheduleTest, InRealTimeFramesSeeWhatTheyAlwaysSeeIfNoMapIsLate) {
  SnapshotSchedule schedule = MakeSchedule(3, true);
  runner_->num_ready = 3;
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(4, {});
  EXPECT_THAT(Seen(&schedule, 4, 7), ElementsAre(0, 0, 0));
  schedule.Submit(6, {});
  EXPECT_THAT(Seen(&schedule, 6, 11), ElementsAre(0, 1, 1, 2, 2));
  EXPECT_EQ(schedule.num_late(), 0);
}

TEST_F(SnapshotScheduleTest, DrainingRecordsAllAndChangesNothingForTheFrames) {
  SnapshotSchedule schedule = MakeSchedule(3);
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, {});
  schedule.Submit(3, {});
  schedule.Drain();
  EXPECT_THAT(recorded_, ElementsAre(0, 1, 3));
  EXPECT_THAT(Seen(&schedule, 3, 7), ElementsAre(0, 1, 1, 2));
  schedule.Drain();
  EXPECT_THAT(recorded_, ElementsAre(0, 1, 3));
}

TEST_F(SnapshotScheduleTest, AnErrorIsThrownOnceWhereItsMapIsMissing) {
  SnapshotSchedule schedule = MakeSchedule(2);
  runner_->failing = 1;
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, {});
  schedule.Submit(3, {});
  EXPECT_EQ(schedule.SnapshotAt(2)->newest_keyframe, 0);
  EXPECT_THROW(schedule.SnapshotAt(3), std::runtime_error);
  EXPECT_THAT(Seen(&schedule, 3, 6), ElementsAre(0, 0, 2));
  EXPECT_THAT(recorded_, ElementsAre(0, 3));
}

TEST_F(SnapshotScheduleTest, DrainingThrowsAnErrorThatNobodyHeardOf) {
  SnapshotSchedule schedule = MakeSchedule(5);
  runner_->failing = 1;
  schedule.Submit(0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, {});
  schedule.Submit(3, {});
  EXPECT_THROW(schedule.Drain(), std::runtime_error);
  EXPECT_THAT(recorded_, ElementsAre(0, 3));
  EXPECT_NO_THROW(schedule.Drain());
  EXPECT_THAT(Seen(&schedule, 4, 9), ElementsAre(0, 0, 0, 0, 2));
}

TEST_F(SnapshotScheduleTest, NegativeLatencyIsRefused) {
  std::string error;
  EXPECT_FALSE((SnapshotOptions{-1, false}).IsValid(&error));
  EXPECT_THAT(error, testing::HasSubstr("latency_frames"));
}

}  // namespace
}  // namespace msc_vo
