// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/mapping_runner.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

using MappingCall = std::function<MappingSummary()>;

// Runs a call of the mapper and returns `step`, the previous one of the keyframe, updated.
MappingStep RunStep(const MappingCall& call, Mapper* mapper, MappingStep step) {
  const Stopwatch stopwatch;
  const double milliseconds_before = step.milliseconds;
  try {
    step.summary = call();
    const Stopwatch snapshot;
    step.snapshot = mapper->Snapshot();
    step.snapshot_ms += snapshot.Milliseconds();
  } catch (...) {
    step = {};
    step.error = std::current_exception();
  }
  step.milliseconds = milliseconds_before + stopwatch.Milliseconds();
  return step;
}

// Delivers each of the two steps of a keyframe when it is done. If the first one fails, the second
// one is empty.
void RunKeyframe(const KeyframePacket& packet, Mapper* mapper,
                 const std::function<void(MappingStep)>& deliver) {
  std::optional<InsertedKeyframe> keyframe;
  const MappingStep inserted = RunStep(
      [&] {
        keyframe.emplace(mapper->Insert(packet));
        return keyframe->summary();
      },
      mapper, MappingStep());
  deliver(inserted);
  if (inserted.error) return deliver(MappingStep());
  deliver(RunStep([&] { return mapper->Refine(*std::move(keyframe)); }, mapper, inserted));
}

MappingStep PopFront(std::deque<MappingStep>* steps) {
  MappingStep step = std::move(steps->front());
  steps->pop_front();
  return step;
}

[[noreturn]] void ThrowNothingPending() {
  throw std::logic_error("mapping: a step was requested, but no keyframe is pending");
}

class InlineRunner : public MappingRunner {
 public:
  explicit InlineRunner(Mapper* mapper) : mapper_(mapper) {}

  void Submit(KeyframePacket packet) override {
    RunKeyframe(packet, mapper_, [this](MappingStep step) { done_.push_back(std::move(step)); });
  }
  MappingStep Take() override {
    if (done_.empty()) ThrowNothingPending();
    return PopFront(&done_);
  }
  std::optional<MappingStep> TryTake() override {
    if (done_.empty()) return std::nullopt;
    return PopFront(&done_);
  }

 private:
  Mapper* mapper_;
  std::deque<MappingStep> done_;
};

class ThreadedRunner : public MappingRunner {
 public:
  explicit ThreadedRunner(Mapper* mapper) : mapper_(mapper), thread_([this] { Loop(); }) {}

  ~ThreadedRunner() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void Submit(KeyframePacket packet) override {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting; });
      waiting_.push_back(std::move(packet));
      num_pending_ += 2;
    }
    changed_.notify_all();
  }

  MappingStep Take() override {
    std::unique_lock<std::mutex> lock(mutex_);
    if (num_pending_ == 0) ThrowNothingPending();
    changed_.wait(lock, [this] { return !done_.empty(); });
    --num_pending_;
    return PopFront(&done_);
  }

  std::optional<MappingStep> TryTake() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (done_.empty()) return std::nullopt;
    --num_pending_;
    return PopFront(&done_);
  }

 private:
  void Loop() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      const KeyframePacket packet = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      changed_.notify_all();  // Submit() may be waiting for space in the queue
      RunKeyframe(packet, mapper_, [this](MappingStep step) { Deliver(std::move(step)); });
      lock.lock();
    }
  }

  void Deliver(MappingStep step) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      done_.push_back(std::move(step));
    }
    changed_.notify_all();
  }

  Mapper* mapper_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<KeyframePacket> waiting_;
  std::deque<MappingStep> done_;
  int num_pending_ = 0;  // steps of submitted keyframes that have not been taken
  bool stopping_ = false;
  std::thread thread_;  // last: it uses the members above
};

}  // namespace

std::unique_ptr<MappingRunner> MakeInlineRunner(Mapper* mapper) {
  return std::make_unique<InlineRunner>(mapper);
}

std::unique_ptr<MappingRunner> MakeThreadedRunner(Mapper* mapper) {
  return std::make_unique<ThreadedRunner>(mapper);
}

}  // namespace msc_vo
