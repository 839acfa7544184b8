// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_source.h"

#include <future>
#include <map>
#include <vector>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// Delivers images with given stamps at once, then ends.
class FakeCamera : public RgbdCamera {
 public:
  explicit FakeCamera(const std::vector<double>& stamps) : stamps_(stamps) {}

  bool Grab(CameraImage* image) override {
    if (next_ == stamps_.size()) {
      ended_.set_value();
      return false;
    }
    image->timestamp = stamps_[next_++];
    return true;
  }
  void WaitForEnd() { ended_.get_future().wait(); }

 private:
  std::vector<double> stamps_;
  size_t next_ = 0;
  std::promise<void> ended_;
};

// Stamps that a reader gets who begins when the camera has ended.
std::vector<double> WaitingStamps(const std::vector<double>& stamps, double max_waiting) {
  FakeCamera camera(stamps);
  CameraSource source(&camera, max_waiting);
  camera.WaitForEnd();
  std::vector<double> waiting;
  int num_dropped = 0;
  CameraImage image;
  while (source.Next(&image, &num_dropped)) waiting.push_back(image.timestamp);
  EXPECT_EQ(waiting.size() + num_dropped, stamps.size());
  return waiting;
}

TEST(CameraSource, QueuesATenthOfASecondAtAnyRate) {
  const std::map<double, size_t> num_waiting = {{5.0, 1}, {15.0, 2}, {30.0, 3}, {60.0, 6}};
  for (const auto& [rate, count] : num_waiting) {
    std::vector<double> stamps;
    for (int i = 0; i < 20; ++i) stamps.push_back(1.7e9 + i / rate);
    const std::vector<double> waiting = WaitingStamps(stamps, 0.09);
    EXPECT_EQ(waiting.size(), count) << rate;
    EXPECT_EQ(waiting.back(), stamps.back()) << rate;
  }
}

TEST(CameraSource, KeepsOnlyTheNewestImageIfStampsDoNotAscend) {
  EXPECT_THAT(WaitingStamps({1.0, 1.0, 1.0, 0.5}, 10.0), testing::ElementsAre(0.5));
}

}  // namespace
}  // namespace msc_vo
