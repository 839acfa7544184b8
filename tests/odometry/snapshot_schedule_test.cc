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

// A runner with controlled speed: TryTake() returns the first `num_ready` steps, Take() any. Step
// 2 k results in the map with keyframe k inserted, step 2 k + 1 in the refined map. The newest
// keyframe of a map is set to the number of its step.
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

// Frame k has the time stamp k seconds.
class SnapshotScheduleTest : public testing::Test {
 protected:
  SnapshotSchedule MakeSchedule(double insertion_latency, double latency, bool realtime = false) {
    auto runner = std::make_unique<FakeRunner>();
    runner_ = runner.get();
    return {{insertion_latency, latency, realtime},
            std::move(runner),
            std::make_shared<MapSnapshot>(),
            [this](int frame, const MappingStep&) { recorded_.push_back(frame); }};
  }
  // The steps whose maps the frames from `begin` to `end - 1` are tracked in.
  static std::vector<int> StepsUsed(SnapshotSchedule* schedule, int begin, int end) {
    std::vector<int> steps;
    for (int i = begin; i < end; ++i) steps.push_back(schedule->SnapshotAt(i)->newest_keyframe);
    return steps;
  }

  FakeRunner* runner_ = nullptr;
  std::vector<int> recorded_;
};

TEST_F(SnapshotScheduleTest, UsesMapsAtAFixedLatencyHoweverFastTheMapperIs) {
  for (const int num_ready : {0, 6}) {
    recorded_.clear();
    SnapshotSchedule schedule = MakeSchedule(1, 3);
    runner_->num_ready = num_ready;
    EXPECT_EQ(schedule.SnapshotAt(0)->newest_keyframe, kNoId);
    schedule.Submit(0, 0.0, {});
    EXPECT_THAT(StepsUsed(&schedule, 0, 5), ElementsAre(0, 0, 0, 1, 1));  // frame 0 waits for it
    schedule.Submit(4, 4.0, {});
    EXPECT_THAT(StepsUsed(&schedule, 4, 9), ElementsAre(1, 2, 2, 3, 3));
    schedule.Submit(8, 8.0, {});
    EXPECT_THAT(StepsUsed(&schedule, 8, 12), ElementsAre(3, 4, 4, 5));
    EXPECT_THAT(recorded_, ElementsAre(0, 0, 4, 4, 8, 8));
  }
}

// The first frames after a keyframe that are tracked in its map and in the refined one.
TEST_F(SnapshotScheduleTest, MeasuresLatencyByTimeStamps) {
  const auto first_frames = [this](double start, double fps) {
    const SnapshotOptions defaults;
    SnapshotSchedule schedule = MakeSchedule(defaults.insertion_latency, defaults.latency);
    schedule.Submit(0, start, {});
    schedule.SnapshotAt(start);
    schedule.SnapshotAt(start + 1.0);
    schedule.Submit(1, start + 2.0, {});
    std::vector<int> frames = {0, 0};
    for (int k = 1; frames[1] == 0 && k < 100; ++k) {
      const KeyframeId step = schedule.SnapshotAt(start + 2.0 + k / fps)->newest_keyframe;
      if (frames[0] == 0 && step >= 2) frames[0] = k;
      if (step == 3) frames[1] = k;
    }
    return frames;
  };
  for (const double start : {-1000.0, 0.0, 1.0, 1305031102.175304}) {
    EXPECT_THAT(first_frames(start, 60.0), ElementsAre(1, 6)) << start;
    EXPECT_THAT(first_frames(start, 50.0), ElementsAre(1, 5)) << start;
    EXPECT_THAT(first_frames(start, 30.0), ElementsAre(1, 3)) << start;
    EXPECT_THAT(first_frames(start, 25.0), ElementsAre(1, 3)) << start;
    EXPECT_THAT(first_frames(start, 5.0), ElementsAre(1, 1)) << start;
  }
}

TEST_F(SnapshotScheduleTest, UsesTheRefinedMapNotLaterThanTheNextInsertion) {
  SnapshotSchedule schedule = MakeSchedule(1, 9);
  schedule.Submit(0, 0.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 0, 3), ElementsAre(0, 0, 0));
  schedule.Submit(2, 2.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 2, 5), ElementsAre(0, 2, 2));
}

TEST_F(SnapshotScheduleTest, UsesTheMapOfAKeyframeForItselfWithoutLatency) {
  SnapshotSchedule schedule = MakeSchedule(1, 0);
  schedule.Submit(0, 0.0, {});
  schedule.SnapshotAt(0);
  schedule.Submit(1, 1.0, {});
  EXPECT_EQ(schedule.SnapshotAt(1)->newest_keyframe, 3);
}

TEST_F(SnapshotScheduleTest, LimitsTheLatencyOfInsertionToThatOfRefinement) {
  SnapshotSchedule schedule = MakeSchedule(5, 2);
  schedule.Submit(0, 0.0, {});
  schedule.SnapshotAt(0);
  schedule.Submit(4, 4.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 4, 7), ElementsAre(1, 1, 3));
}

TEST_F(SnapshotScheduleTest, DoesNotWaitForLateMapsInRealTime) {
  SnapshotSchedule schedule = MakeSchedule(1, 3, true);
  schedule.Submit(0, 0.0, {});
  EXPECT_EQ(schedule.SnapshotAt(1)->newest_keyframe, 0);  // the first map is waited for
  schedule.Submit(1, 1.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 2, 20), testing::Each(0));  // others are not
  EXPECT_EQ(schedule.num_late(), 1);
  runner_->num_ready = 3;
  EXPECT_EQ(schedule.SnapshotAt(20)->newest_keyframe, 2);
  EXPECT_EQ(schedule.num_late(), 2);
  runner_->num_ready = 4;
  EXPECT_EQ(schedule.SnapshotAt(21)->newest_keyframe, 3);
  EXPECT_EQ(schedule.num_late(), 2);
}

TEST_F(SnapshotScheduleTest, WaitsForTheFirstMapOfASegment) {
  for (const bool realtime : {false, true}) {
    SnapshotSchedule schedule = MakeSchedule(5, 9, realtime);
    schedule.Submit(0, 0.0, {});
    EXPECT_THAT(StepsUsed(&schedule, 0, 2), ElementsAre(0, 0));
    KeyframePacket packet;
    packet.begins_map = true;
    schedule.Submit(2, 2.0, std::move(packet));
    // The pending step of the old map comes first.
    EXPECT_THAT(StepsUsed(&schedule, 2, 5), ElementsAre(2, 2, 2));
    EXPECT_EQ(schedule.num_late(), 0);
  }
}

TEST_F(SnapshotScheduleTest, UsesTheSameMapsInRealTimeIfNoneIsLate) {
  SnapshotSchedule schedule = MakeSchedule(1, 3, true);
  runner_->num_ready = 6;
  schedule.Submit(0, 0.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 0, 5), ElementsAre(0, 0, 0, 1, 1));
  schedule.Submit(4, 4.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 4, 7), ElementsAre(1, 2, 2));
  schedule.Submit(6, 6.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 6, 10), ElementsAre(2, 4, 4, 5));
  EXPECT_EQ(schedule.num_late(), 0);
}

TEST_F(SnapshotScheduleTest, RecordsAllStepsOnDrainWithoutChangingLaterFrames) {
  SnapshotSchedule schedule = MakeSchedule(1, 3);
  schedule.Submit(0, 0.0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(3, 3.0, {});
  schedule.Drain();
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 3, 3));
  EXPECT_THAT(StepsUsed(&schedule, 3, 7), ElementsAre(1, 2, 2, 3));
  schedule.Drain();
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 3, 3));
}

TEST_F(SnapshotScheduleTest, ThrowsAnErrorOnceWhenItsMapIsDue) {
  SnapshotSchedule schedule = MakeSchedule(1, 3);
  runner_->failing = 3;
  schedule.Submit(0, 0.0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, 1.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 2, 4), ElementsAre(2, 2));
  EXPECT_THROW(schedule.SnapshotAt(4), std::runtime_error);
  schedule.Submit(4, 4.0, {});
  EXPECT_THAT(StepsUsed(&schedule, 4, 8), ElementsAre(2, 4, 4, 5));
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 1, 4, 4));
}

TEST_F(SnapshotScheduleTest, KeepsTheMapAfterAFailedInsertion) {
  SnapshotSchedule schedule = MakeSchedule(1, 3);
  runner_->failing = 2;
  schedule.Submit(0, 0.0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(3, 3.0, {});
  EXPECT_THROW(schedule.SnapshotAt(4), std::runtime_error);
  EXPECT_THAT(StepsUsed(&schedule, 4, 8), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(recorded_, ElementsAre(0, 0));
}

TEST_F(SnapshotScheduleTest, ThrowsAnErrorOnDrainIfItHasNotBeenThrown) {
  SnapshotSchedule schedule = MakeSchedule(1, 5);
  runner_->failing = 3;
  schedule.Submit(0, 0.0, {});
  schedule.SnapshotAt(1);
  schedule.Submit(1, 1.0, {});
  EXPECT_THROW(schedule.Drain(), std::runtime_error);
  EXPECT_THAT(recorded_, ElementsAre(0, 0, 1));
  EXPECT_NO_THROW(schedule.Drain());
  EXPECT_THAT(StepsUsed(&schedule, 1, 9), ElementsAre(0, 2, 2, 2, 2, 2, 2, 2));
}

}  // namespace
}  // namespace msc_vo
