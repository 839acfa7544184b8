// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/live_run.h"

#include <thread>

#include "tests/support/tracked_scene.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/report/base64.h"

namespace msc_vo {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

class LiveRunTest : public testing::Test {
 protected:
  static LiveRunOptions Options() {
    LiveRunOptions options;
    options.num_frames = 1000;
    options.vanished = milliseconds(50);
    return options;
  }
  // Processes frames as a replay does.
  void Process(int count) {
    for (int i = 0; i < count; ++i) {
      scene_.result.timestamp = 0.1 * static_cast<double>(++scene_.result.id);
      run_.Show(scene_.View());
      run_.Add(scene_.result, [] { return false; });
    }
  }
  // Processes a frame one metre in front of keyframe 0, which the mapper has moved to `x` since the
  // frame before, late enough for viewers to get the map.
  void ProcessAfterMapping(double x) {
    std::this_thread::sleep_for(milliseconds(310));
    scene_.map.map.SetPose(0, Rigid3(Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}));
    ++scene_.map.newest_keyframe;
    scene_.tracked.reference = 0;
    scene_.tracked.cam_from_reference.translation() = Eigen::Vector3d(0.0, 0.0, -1.0);
    scene_.result.cam_from_world =
        scene_.tracked.cam_from_reference * scene_.map.map.CamFromWorld(0);
    Process(1);
  }
  // The poses of as many frames at `x`, as they are sent.
  static std::string PosesAt(double x, int count) {
    const Rigid3 pose = Rigid3(Eigen::Quaterniond::Identity(), {-x, 0.0, -1.0}).Inverse();
    std::vector<float> poses;
    for (int i = 0; i < count; ++i) {
      const Eigen::Matrix<float, 7, 1> params = pose.params.cast<float>();
      poses.insert(poses.end(), params.data() + 4, params.data() + 7);  // translation
      poses.insert(poses.end(), params.data(), params.data() + 4);
    }
    return EncodeBase64(poses);
  }
  json Update(int num_frames, int map = -1, int view = -1) {
    return json::parse(run_.Update(num_frames, map, view));
  }

  TrackedScene scene_;
  LiveRun run_{Options()};
};

TEST_F(LiveRunTest, SendsFramesOnceInBoundedPieces) {
  scene_.result.id = -1;
  Process(1200);
  json update = Update(0);
  EXPECT_EQ(update["state"], "running");
  EXPECT_EQ(update["count"], 1200);
  EXPECT_EQ(update["total"], 1000);
  EXPECT_EQ(update["more"], true);
  EXPECT_EQ(update["frames"]["first"], 0);
  const size_t first_size = update["frames"]["status"].get<std::string>().size();
  EXPECT_EQ(first_size, 668u);  // 500 bytes
  update = Update(1000);
  EXPECT_EQ(update["more"], false);
  EXPECT_EQ(update["frames"]["first"], 1000);
  EXPECT_FALSE(Update(1200).contains("frames"));
  EXPECT_FALSE(Update(5000).contains("frames"));
}

TEST_F(LiveRunTest, ShowsImagesAndMapOnlyToThoseWhoWatch) {
  scene_.result.id = -1;
  Process(5);
  json update = Update(0);
  EXPECT_FALSE(update.contains("views"));
  EXPECT_FALSE(update.contains("map"));
  EXPECT_EQ(update["map_version"], -1);

  Process(1);  // watched since Update()
  update = Update(5);
  ASSERT_TRUE(update.contains("views"));
  EXPECT_EQ(update["views"][0]["frame"], 5);
  EXPECT_EQ(update["map_version"], 0);
  EXPECT_TRUE(update["map"].contains("axes"));
  // A viewer that has both gets neither again.
  update = Update(6, 0, 5);
  EXPECT_FALSE(update.contains("views"));
  EXPECT_FALSE(update.contains("map"));
}

TEST_F(LiveRunTest, MovesItsFramesWithTheMapWhenALoopIsClosed) {
  scene_.result.id = -1;
  Update(0);
  ProcessAfterMapping(0.0);
  EXPECT_EQ(Update(0)["loops"], json::array());
  ProcessAfterMapping(0.5);  // without a loop, poses are those known at the time
  json update = Update(1, 0);
  EXPECT_TRUE(update.contains("map"));
  EXPECT_FALSE(update.contains("moved"));
  EXPECT_EQ(update["frames"]["pose"], PosesAt(0.5, 1));

  scene_.loops = {{1, 0, 3, 0.0, 2.0}};
  scene_.map.num_loops = 1;
  ProcessAfterMapping(2.0);
  update = Update(2, 1);
  EXPECT_EQ(update["moved"]["pose"], PosesAt(2.0, 2));
  EXPECT_EQ(update["frames"]["pose"], PosesAt(2.0, 1));
  EXPECT_EQ(update["loops"], json::parse("[[1, 0]]"));
  EXPECT_FALSE(Update(3, 2).contains("moved"));
  EXPECT_EQ(Update(0)["frames"]["pose"], PosesAt(2.0, 3));  // for another viewer
}

TEST_F(LiveRunTest, MovesItsFramesIntoTheMapOfAnEarlierRun) {
  scene_.result.id = -1;
  Update(0);
  scene_.result.segment = scene_.result.world = scene_.map.world = 1;
  ProcessAfterMapping(0.0);
  json update = Update(0);
  EXPECT_FALSE(update.contains("found"));
  EXPECT_FALSE(update.contains("place"));
  EXPECT_EQ(update["frames"]["submap"], EncodeBase64(std::vector<uint16_t>{1}));
  scene_.result.world = scene_.map.world = 0;
  scene_.map.map.BeginSession();
  run_.ShowPlace({1, "run", 7, "map"});
  ProcessAfterMapping(3.0);
  update = Update(1, 0);
  EXPECT_EQ(update["place"]["keyframe"], 7);
  EXPECT_FALSE(Update(1, 1).contains("place"));  // the viewer has it with the map
  EXPECT_EQ(update["moved"]["pose"], PosesAt(3.0, 1));
  EXPECT_EQ(update["moved"]["submap"], EncodeBase64(std::vector<uint16_t>{0}));
  EXPECT_EQ(update["map"]["sessions"].size(), 1u);
  ProcessAfterMapping(3.0);
  EXPECT_EQ(Update(2, 1)["found"], 1);
}

TEST_F(LiveRunTest, ContinuesWithTheFramesOfAResumedRun) {
  std::vector<FrameResult> frames(3);
  for (int i = 0; i < 3; ++i) frames[i].timestamp = 0.1 * i;
  for (FrameResult& frame : frames) frame.segment = frame.world = 1;
  frames[2].world = 0;  // found in the map of an earlier run
  run_.Continue(frames);
  Update(0);
  scene_.result.id = 2;
  ProcessAfterMapping(1.0);
  const json update = Update(0);
  EXPECT_EQ(update["count"], 4);
  EXPECT_EQ(update["found"], 2);
  EXPECT_EQ(update["views"][0]["frame"], 3);
}

TEST_F(LiveRunTest, GoesOnIfItsViewersVanish) {
  Update(0);
  ASSERT_TRUE(run_.Control("pause", ""));
  EXPECT_EQ(Update(0)["state"], "paused");
  const auto start = std::chrono::steady_clock::now();
  Process(1);
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(2000));
  EXPECT_EQ(Update(0)["state"], "running");
}

TEST_F(LiveRunTest, IsWatchedByThoseWhoControlIt) {
  LiveRunOptions patient = Options();
  patient.vanished = milliseconds(60'000);
  LiveRun run(patient);
  ASSERT_TRUE(run.Control("pause", ""));  // before any other request
  int num_questions = 0;
  run.Add(scene_.result, [&] { return ++num_questions == 2; });
  EXPECT_EQ(num_questions, 2);  // still paused
}

TEST_F(LiveRunTest, UnderstandsItsControls) {
  EXPECT_TRUE(run_.Control("speed", "0.5"));
  EXPECT_EQ(Update(0)["speed"], 0.5);
  EXPECT_TRUE(run_.Control("speed", "0"));
  for (const char* value : {"", "fast", "-1", "nan", "1e300"}) {
    EXPECT_FALSE(run_.Control("speed", value)) << value;
  }
  EXPECT_FALSE(run_.Control("halt", ""));
  LiveRunOptions realtime = Options();
  realtime.can_pause = false;
  LiveRun run(realtime);
  EXPECT_FALSE(run.Control("pause", ""));
  EXPECT_EQ(json::parse(run.Update(0, -1, -1))["can_pause"], false);
}

TEST_F(LiveRunTest, WaitsOnlyForThoseWhoWatchItsReport) {
  const auto start = std::chrono::steady_clock::now();
  run_.Finish("<html>");
  run_.WaitForViewers(milliseconds(5000));  // nobody
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(1000));

  EXPECT_EQ(Update(0)["state"], "finished");
  run_.WaitForViewers(milliseconds(50));  // somebody who never asks for it
  std::thread viewer([&] {
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_EQ(*run_.Report(), "<html>");
  });
  run_.WaitForViewers(milliseconds(60'000));
  viewer.join();
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(20'000));
}

TEST_F(LiveRunTest, HasNoReportBeforeItsEnd) { EXPECT_EQ(run_.Report(), nullptr); }

TEST(LiveRun, HasAnIdOfItsOwn) { EXPECT_NE(LiveRun({}).id(), LiveRun({}).id()); }

// For the thread sanitizer.
TEST_F(LiveRunTest, MayBeWatchedWhileItRuns) {
  std::atomic<bool> done{false};
  std::vector<std::thread> viewers;
  for (int i = 0; i < 2; ++i) {
    viewers.emplace_back([&] {
      int count = 0;
      while (!done) count = json::parse(run_.Update(count, -1, -1))["count"].get<int>();
      EXPECT_GT(count, 0);
    });
  }
  Process(200);
  std::this_thread::sleep_for(milliseconds(20));
  done = true;
  for (std::thread& viewer : viewers) viewer.join();
}

}  // namespace
}  // namespace msc_vo
