// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/event_log.h"

#include <memory>
#include <sstream>

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>

#include "msc_vo/logging/logger.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;

// Collects the lines of the library's logger, without their time stamps.
class EventLogTest : public testing::Test {
 protected:
  void SetUp() override {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(text_);
    sink->set_pattern("%l: %v");
    Log().sinks() = {sink};
    Log().set_level(spdlog::level::debug);
  }
  void TearDown() override {
    Log().set_level(spdlog::level::off);
    Log().sinks() = silent_;
  }

  static FrameResult Frame(int64_t id, TrackingStatus status) {
    FrameResult frame;
    frame.id = id;
    frame.timestamp = 0.5 * static_cast<double>(id);
    frame.status = status;
    if (status == TrackingStatus::kLost) frame.cause = LossCause::kUniformImage;
    return frame;
  }
  static MappingStep Step(AxesState axes, int num_refinements, double readout_time) {
    MappingStep step;
    step.summary.keyframe = 4;
    step.summary.axes_state = axes;
    step.summary.num_axes_refinements = num_refinements;
    auto snapshot = std::make_shared<MapSnapshot>();
    snapshot->readout_time = readout_time;
    step.snapshot = snapshot;
    return step;
  }
  std::vector<std::string> Lines() const {
    std::vector<std::string> lines;
    std::istringstream text(text_.str());
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

  EventLog log_;

 private:
  std::ostringstream text_;
  std::vector<spdlog::sink_ptr> silent_ = Log().sinks();
};

TEST_F(EventLogTest, WritesChangesOfTheStatus) {
  log_.LogFrame(Frame(0, TrackingStatus::kTracked), false);
  log_.LogFrame(Frame(1, TrackingStatus::kTracked), false);
  log_.LogFrame(Frame(2, TrackingStatus::kWeak), false);
  log_.LogFrame(Frame(3, TrackingStatus::kLost), false);
  log_.LogFrame(Frame(4, TrackingStatus::kLost), false);
  log_.LogFrame(Frame(5, TrackingStatus::kTracked), true);
  EXPECT_THAT(
      Lines(),
      ElementsAre(
          "info: frame 0 (0.000000 s) is tracked",
          "warning: frame 2 (1.000000 s) is weak; the 2 before it: tracked",
          "warning: frame 3 (1.500000 s) is lost, image black or uniform; the 1 before it: weak",
          "info: frame 5 is relocalised in the map",
          "info: frame 5 (2.500000 s) is tracked; the 2 before it: lost"));
}

TEST_F(EventLogTest, WritesKeyframesForDebugging) {
  FrameResult frame = Frame(0, TrackingStatus::kTracked);
  log_.LogFrame(frame, false);
  frame.is_keyframe = true;
  frame.num_points = 800;
  frame.num_lines = 90;
  frame.num_inlier_points = 300;
  frame.num_inlier_lines = 40;
  log_.LogFrame(frame, false);
  EXPECT_THAT(Lines(), ElementsAre("info: frame 0 (0.000000 s) is tracked",
                                   "debug: frame 0 is a keyframe: 800 points, 90 lines; inliers: "
                                   "300 points, 40 lines"));
}

TEST_F(EventLogTest, WritesAxesAndReadoutTimeWhenTheyChange) {
  log_.LogMapping(Step(AxesState::kNone, 0, 0.0));
  log_.LogMapping(Step(AxesState::kCoarse, 0, 0.0));
  log_.LogMapping(Step(AxesState::kCoarse, 0, 0.0));
  log_.LogMapping(Step(AxesState::kRefined, 1, 0.025));
  log_.LogMapping(Step(AxesState::kRefined, 1, 0.025));
  log_.LogMapping(Step(AxesState::kRefined, 1, 0.026));
  EXPECT_THAT(Lines(), ElementsAre("info: Manhattan axes at keyframe 4: coarse; refinements: 0",
                                   "info: Manhattan axes at keyframe 4: refined; refinements: 1",
                                   "info: readout time accepted at keyframe 4: 25.00 ms",
                                   "debug: readout time updated at keyframe 4: 26.00 ms"));
}

TEST_F(EventLogTest, WritesEachRefusedJoinOnce) {
  MappingStep step = Step(AxesState::kNone, 0, 0.0);
  for (const int num_refused : {0, 1, 1, 2}) {
    step.summary.num_refused_joins = num_refused;
    log_.LogMapping(step);
  }
  EXPECT_THAT(Lines(), ElementsAre(Names("keyframe 4", "joined"), Names("keyframe 4", "joined")));
}

TEST_F(EventLogTest, CountsFramesBelowTheLevel) {
  Log().set_level(spdlog::level::warn);
  for (int i = 0; i < 3; ++i) log_.LogFrame(Frame(i, TrackingStatus::kTracked), false);
  log_.LogFrame(Frame(3, TrackingStatus::kWeak), false);
  EXPECT_THAT(Lines(),
              ElementsAre("warning: frame 3 (1.500000 s) is weak; the 3 before it: tracked"));
}

TEST_F(EventLogTest, WritesNothingBelowTheLevel) {
  Log().set_level(spdlog::level::warn);
  log_.LogStart(OdometryOptions(), PinholeCamera());
  log_.LogFrame(Frame(0, TrackingStatus::kTracked), false);
  log_.LogFinish(NoiseScale(), 0.0, 1);
  EXPECT_THAT(Lines(), ElementsAre());
}

TEST_F(EventLogTest, WarnsOfDepthThatContradictsTheImages) {
  Log().set_level(spdlog::level::warn);
  NoiseScale scale;
  scale.line_depth = 2.9;
  log_.LogFinish(scale, 0.0, 1);
  EXPECT_THAT(Lines(), ElementsAre());
  scale.point_depth = 3.0;
  log_.LogFinish(scale, 0.0, 1);
  EXPECT_THAT(Lines(), ElementsAre(Names("warning", "depth", "contradicts")));
}

}  // namespace
}  // namespace msc_vo
