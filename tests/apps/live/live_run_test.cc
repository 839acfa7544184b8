// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/live_run.h"

#include <thread>

#include "tests/support/tracked_scene.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace msc_vo {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

bool Never() { return false; }

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
      run_.Add(scene_.result, Never);
    }
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
