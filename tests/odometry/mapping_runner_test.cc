// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/mapping_runner.h"

#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/support/synthetic_frames.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

enum class RunnerKind { kInline, kThreaded, kCalled };

// Keyframes of a synthetic world for all kinds of runner. Local bundle adjustment runs from the
// second keyframe on; the tests use the window observer to intervene in a step.
class MappingRunnerTest : public testing::TestWithParam<RunnerKind> {
 protected:
  static bool IsThreaded() { return GetParam() == RunnerKind::kThreaded; }

  std::unique_ptr<MappingRunner> MakeRunner() {
    return msc_vo::MakeRunner(IsThreaded() ? 2 : 1, GetParam() == RunnerKind::kCalled, &mapper_);
  }
  // Matched with the points of keyframe 0, which become landmarks in their order, so that there is
  // a window from keyframe 1 on.
  KeyframePacket Packet(int index) {
    KeyframePacket packet;
    packet.frame = world_.MakeFrame(10 * index);
    packet.cam_from_reference =
        SyntheticFrames::CamFromWorld(10 * index) * SyntheticFrames::CamFromWorld(0).Inverse();
    if (index == 0) first_frame_ = packet.frame;
    for (size_t i = 0; i < packet.frame->points.size() && index > 0; ++i) {
      for (size_t id = 0; id < first_frame_->points.size(); ++id) {
        const int distance = HammingDistance(first_frame_->points[id].descriptor,
                                             packet.frame->points[i].descriptor);
        if (distance > 40) continue;
        packet.matches.points.push_back(
            {static_cast<int>(i), static_cast<LandmarkId>(id), Eigen::Vector3d::Zero(), true});
        break;
      }
    }
    return packet;
  }

  SyntheticFrames world_{SyntheticFrames::Options()};
  std::shared_ptr<const Frame> first_frame_;
  Mapper mapper_{MapperOptions()};
};

std::string RunnerName(const testing::TestParamInfo<RunnerKind>& info) {
  switch (info.param) {
    case RunnerKind::kInline:
      return "Inline";
    case RunnerKind::kThreaded:
      return "Threaded";
    case RunnerKind::kCalled:
      break;
  }
  return "Called";
}
INSTANTIATE_TEST_SUITE_P(All, MappingRunnerTest,
                         testing::Values(RunnerKind::kInline, RunnerKind::kThreaded,
                                         RunnerKind::kCalled),
                         RunnerName);

TEST_P(MappingRunnerTest, ReturnsTwoStepsPerKeyframeInOrder) {
  const std::thread::id caller = std::this_thread::get_id();
  std::thread::id worker;
  mapper_.SetWindowObserver([&](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) {
    worker = std::this_thread::get_id();
  });
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  EXPECT_FALSE(runner->TryTake().has_value());
  for (int i = 0; i < 3; ++i) runner->Submit(Packet(i));
  for (int i = 0; i < 3; ++i) {
    const MappingStep inserted = runner->Take(), refined = runner->Take();
    for (const MappingStep& step : {inserted, refined}) {
      EXPECT_EQ(step.summary.keyframe, i);
      ASSERT_NE(step.snapshot, nullptr);
      EXPECT_EQ(step.snapshot->newest_keyframe, i);
      EXPECT_EQ(step.snapshot->map.keyframes().size(), static_cast<size_t>(i + 1));
      EXPECT_EQ(step.error, nullptr);
    }
    EXPECT_FALSE(inserted.summary.window.has_value());
    EXPECT_EQ(refined.summary.window.has_value() && refined.summary.window->usable, i > 0);
    EXPECT_FALSE(inserted.summary.times.window.has_value());
    EXPECT_EQ(refined.summary.times.window.has_value(), i > 0);
    EXPECT_EQ(refined.summary.times.creation, inserted.summary.times.creation);
    EXPECT_GT(refined.milliseconds, inserted.milliseconds);
  }
  EXPECT_FALSE(runner->TryTake().has_value());
  EXPECT_EQ(worker != caller, IsThreaded());
}

TEST_P(MappingRunnerTest, ReturnsTheExceptionOfAStepAndContinues) {
  mapper_.SetWindowObserver(
      [](KeyframeId keyframe, const BundleAdjustmentOptions&, const WindowData&) {
        if (keyframe == 1) throw std::runtime_error("disk full");
      });
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  for (int i = 0; i < 3; ++i) runner->Submit(Packet(i));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(runner->Take().error, nullptr);
  const MappingStep failed = runner->Take();
  EXPECT_EQ(failed.snapshot, nullptr);
  ASSERT_NE(failed.error, nullptr);
  try {
    std::rethrow_exception(failed.error);
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "disk full");
  }
  const MappingStep next = runner->Take();
  EXPECT_EQ(next.error, nullptr);
  EXPECT_EQ(next.summary.keyframe, 2);
}

TEST_P(MappingRunnerTest, RefusesToWaitWithoutPendingKeyframes) {
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  EXPECT_THROW(runner->Take(), std::logic_error);
  runner->Submit(Packet(0));
  for (int i = 0; i < 2; ++i) runner->Take();
  EXPECT_THROW(runner->Take(), std::logic_error);
}

TEST_P(MappingRunnerTest, IsDestroyedWithStepsNotTaken) {
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  for (int i = 0; i < 2; ++i) runner->Submit(Packet(i));
}

// A mapper that blocks in the window of its second keyframe until the gate opens.
class BusyRunnerTest : public MappingRunnerTest {
 protected:
  BusyRunnerTest() {
    mapper_.SetWindowObserver(
        [this](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) {
          if (num_windows_++ == 0) {
            reached_.set_value();
            gate_.get_future().wait();
          }
        });
  }

  std::promise<void> reached_;
  std::promise<void> gate_;
  std::atomic<int> num_windows_{0};
};
INSTANTIATE_TEST_SUITE_P(Threads, BusyRunnerTest, testing::Values(RunnerKind::kThreaded),
                         RunnerName);

TEST_P(BusyRunnerTest, BlocksWhenTheQueueIsFull) {
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  runner->Submit(Packet(0));
  runner->Submit(Packet(1));
  reached_.get_future().wait();
  for (int i = 0; i < MappingRunner::kMaxWaiting; ++i) runner->Submit(Packet(2 + i));
  std::future<void> one_more = std::async(
      std::launch::async, [&] { runner->Submit(Packet(2 + MappingRunner::kMaxWaiting)); });
  // The queue stays full until the mapper continues.
  EXPECT_EQ(one_more.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  gate_.set_value();
  one_more.get();
  for (int i = 0; i < 3 + MappingRunner::kMaxWaiting; ++i) {
    for (int step = 0; step < 2; ++step) EXPECT_EQ(runner->Take().summary.keyframe, i);
  }
}

TEST_P(BusyRunnerTest, DiscardsTheQueueOnDestruction) {
  std::unique_ptr<MappingRunner> runner = MakeRunner();
  runner->Submit(Packet(0));
  runner->Submit(Packet(1));
  reached_.get_future().wait();
  runner->Submit(Packet(2));
  std::future<void> end = std::async(std::launch::async, [&] { runner.reset(); });
  // The destructor waits for the running step.
  EXPECT_EQ(end.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  gate_.set_value();
  end.get();
  EXPECT_EQ(mapper_.map().keyframes().size(), 2u);
}

// Works when it is called.
class CalledRunnerTest : public MappingRunnerTest {};
INSTANTIATE_TEST_SUITE_P(Budget, CalledRunnerTest, testing::Values(RunnerKind::kCalled),
                         RunnerName);

TEST_P(CalledRunnerTest, WorksInRunAlone) {
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  EXPECT_FALSE(runner->HasWork());
  runner->Submit(Packet(0));
  EXPECT_TRUE(runner->HasWork());
  EXPECT_FALSE(runner->TryTake().has_value());
  runner->Run(0.0);
  EXPECT_TRUE(mapper_.map().keyframes().empty());
  runner->Run(1e3);
  EXPECT_FALSE(runner->HasWork());
  for (int step = 0; step < 2; ++step) EXPECT_EQ(runner->TryTake()->summary.keyframe, 0);
}

TEST_P(CalledRunnerTest, DoesNotBeginASliceThatExceedsTheBudget) {
  const std::chrono::milliseconds slow(200);  // the observer belongs to a slice
  int num_windows = 0;
  mapper_.SetWindowObserver([&](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) {
    ++num_windows;
    std::this_thread::sleep_for(slow);
  });
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  for (int i = 0; i < 2; ++i) {
    runner->Submit(Packet(i));
    runner->Run(1e3);
    for (int step = 0; step < 2; ++step) EXPECT_EQ(runner->Take().error, nullptr);
  }
  EXPECT_EQ(num_windows, 1);
  runner->Submit(Packet(2));
  for (int i = 0; i < 100; ++i) runner->Run(0.1);
  EXPECT_EQ(num_windows, 1);
  EXPECT_TRUE(runner->HasWork());
  EXPECT_TRUE(runner->TryTake().has_value());  // insertion fits
  EXPECT_FALSE(runner->TryTake().has_value());
  EXPECT_TRUE(runner->Take().summary.window.has_value());  // has to wait
  EXPECT_EQ(num_windows, 2);
  EXPECT_FALSE(runner->HasWork());
}

TEST_P(CalledRunnerTest, RefusesCallsFromCallbacks) {
  std::unique_ptr<MappingRunner> runner;
  mapper_.SetWindowObserver(
      [&](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) { runner->Run(1e3); });
  runner = MakeRunner();
  for (int i = 0; i < 2; ++i) runner->Submit(Packet(i));
  runner->Run(1e3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(runner->Take().error, nullptr);
  EXPECT_THROW(std::rethrow_exception(runner->Take().error), std::logic_error);
}

TEST_P(CalledRunnerTest, BoundsTheKeyframesThatWait) {
  const std::unique_ptr<MappingRunner> runner = MakeRunner();
  constexpr int kNumKeyframes = MappingRunner::kMaxWaiting + 3;
  for (int i = 0; i < kNumKeyframes; ++i) {
    runner->Submit(Packet(i));
    // Of those that were submitted, the last ones wait, and the one before them may be unfinished.
    EXPECT_GE(static_cast<int>(mapper_.map().keyframes().size()), i - MappingRunner::kMaxWaiting);
  }
  for (int i = 0; i < kNumKeyframes; ++i) {
    for (int step = 0; step < 2; ++step) EXPECT_EQ(runner->Take().summary.keyframe, i);
  }
  EXPECT_THROW(runner->Take(), std::logic_error);
}

}  // namespace
}  // namespace msc_vo
