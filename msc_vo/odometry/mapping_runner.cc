// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/mapping_runner.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

// The work of the mapper on one keyframe, and its two steps.
class KeyframeRun {
 public:
  KeyframeRun(KeyframePacket packet, Mapper* mapper) : mapper_(mapper), task_(std::move(packet)) {}

  bool IsDone() const { return is_done_; }
  MappingStage stage() const { return task_.stage(); }

  // Runs the next slice and returns the steps that it ends. If insertion fails, it ends both; the
  // second one is empty.
  std::vector<MappingStep> Advance() {
    const Stopwatch stopwatch;
    const bool was_inserted = task_.IsInserted();
    bool ends_step = true;
    MappingStep failed;
    try {
      mapper_->Advance(&task_);
      ends_step = task_.IsInserted() != was_inserted || task_.IsDone();
      if (ends_step) AddMap();
      is_done_ = task_.IsDone();
    } catch (...) {
      failed.error = std::current_exception();
      is_done_ = true;
    }
    step_.milliseconds += stopwatch.Milliseconds();
    if (!ends_step) return {};
    if (!failed.error) return {step_};
    failed.milliseconds = step_.milliseconds;
    return was_inserted ? std::vector<MappingStep>{failed}
                        : std::vector<MappingStep>{failed, MappingStep()};
  }

 private:
  void AddMap() {
    step_.summary = task_.summary();
    step_.snapshot = Timed(&step_.snapshot_ms, [this] { return mapper_->Snapshot(); });
  }

  Mapper* mapper_;
  KeyframeTask task_;
  MappingStep step_;
  bool is_done_ = false;
};

MappingStep PopFront(std::deque<MappingStep>* steps) {
  MappingStep step = std::move(steps->front());
  steps->pop_front();
  return step;
}

[[noreturn]] void ThrowNothingPending() {
  throw std::logic_error("mapping: a step was requested, but no keyframe is pending");
}

// A slice of the work on a keyframe: its stage, and its number in it.
struct Slice {
  MappingStage stage = MappingStage::kStructure;
  size_t number = 0;
};

// Longest recent times of slices, milliseconds.
class SliceTimes {
 public:
  double Expected(const Slice& slice) const { return longest_[Index(slice)]; }
  // A time that was exceptional is forgotten by half with every later one.
  void Add(const Slice& slice, double milliseconds) {
    double& longest = longest_[Index(slice)];
    longest = std::max(milliseconds, 0.5 * (longest + milliseconds));
  }
  // A slice that never fits would hold up all that follow: with every keyframe that comes before it
  // has run, it is expected to take less.
  void Skip(const Slice& slice) { longest_[Index(slice)] *= 0.8; }

 private:
  // Later ones of a stage share an entry. A window of the mapper has about a dozen.
  static constexpr size_t kMaxSlices = 16;
  static size_t Index(const Slice& slice) {
    return kMaxSlices * static_cast<size_t>(slice.stage) + std::min(slice.number, kMaxSlices - 1);
  }
  std::array<double, kMaxSlices * kNumMappingStages> longest_{};
};

class CalledRunner : public MappingRunner {
 public:
  explicit CalledRunner(Mapper* mapper) : mapper_(mapper) {}

  void Submit(KeyframePacket packet) override {
    if (HasWork()) times_.Skip(next_);
    while (waiting_.size() >= kMaxWaiting) RunSlice();
    waiting_.push_back(std::move(packet));
  }
  MappingStep Take() override {
    while (done_.empty() && HasWork()) RunSlice();
    if (done_.empty()) ThrowNothingPending();
    return PopFront(&done_);
  }
  std::optional<MappingStep> TryTake() override {
    if (done_.empty()) return std::nullopt;
    return PopFront(&done_);
  }
  bool HasWork() const override { return run_ || !waiting_.empty(); }
  void Run(double seconds) override {
    const Stopwatch stopwatch;
    while (HasWork()) {
      const double left = 1000.0 * seconds - stopwatch.Milliseconds();
      if (!(left > 0.0) || times_.Expected(next_) > left) return;
      RunSlice();
    }
  }

 private:
  void RunSlice() {
    // Callbacks of a slice are part of it.
    if (std::exchange(is_running_, true)) {
      throw std::logic_error("mapping: a callback must not run the mapper that has called it");
    }
    struct Guard {
      bool* is_running;
      ~Guard() { *is_running = false; }
    } const guard{&is_running_};
    if (!run_) {
      run_.emplace(std::move(waiting_.front()), mapper_);
      waiting_.pop_front();
    }
    const Stopwatch stopwatch;
    for (MappingStep& step : run_->Advance()) done_.push_back(std::move(step));
    times_.Add(next_, stopwatch.Milliseconds());
    if (run_->IsDone()) {
      run_.reset();
      next_ = {};
    } else {
      const bool is_same_stage = run_->stage() == next_.stage;
      next_ = {run_->stage(), is_same_stage ? next_.number + 1 : 0};
    }
  }

  Mapper* mapper_;
  std::deque<KeyframePacket> waiting_;
  std::optional<KeyframeRun> run_;  // the keyframe that has been begun
  std::deque<MappingStep> done_;
  Slice next_;
  SliceTimes times_;
  bool is_running_ = false;
};

class InlineRunner : public CalledRunner {
 public:
  using CalledRunner::CalledRunner;
  void Submit(KeyframePacket packet) override {
    CalledRunner::Submit(std::move(packet));
    Run(std::numeric_limits<double>::infinity());
  }
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
      KeyframePacket packet = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      changed_.notify_all();  // Submit() may be waiting for space in the queue
      Work(std::move(packet));
      lock.lock();
    }
  }

  // Its data are destroyed without the lock, for which other threads wait.
  void Work(KeyframePacket packet) {
    KeyframeRun run(std::move(packet), mapper_);
    while (!run.IsDone()) {
      for (MappingStep& step : run.Advance()) Deliver(std::move(step));
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

std::unique_ptr<MappingRunner> MakeRunner(int threads, bool external_mapping, Mapper* mapper) {
  if (external_mapping) return std::make_unique<CalledRunner>(mapper);
  if (threads > 1) return std::make_unique<ThreadedRunner>(mapper);
  return std::make_unique<InlineRunner>(mapper);
}

}  // namespace msc_vo
