// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Images of a driver that gives one value to all depths beyond a limit.

#include <functional>
#include <memory>
#include <sstream>

#include "tests/support/message_matchers.h"
#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/logging/logger.h"

namespace msc_vo {
namespace {

using testing::Not;

constexpr float kFarthest = 2.5f, kNearest = 1.7f;  // metres

class ClippedDepthRunTest : public RoomTest {
 protected:
  static std::vector<RgbdImage> Changed(const std::function<float(float)>& change) {
    std::vector<RgbdImage> images = *images_;
    for (RgbdImage& image : images) {
      image.depth = image.depth.clone();
      for (auto z = image.depth.begin<float>(); z != image.depth.end<float>(); ++z) {
        if (*z > 0.0f) *z = change(*z);
      }
    }
    return images;
  }
  static std::vector<RgbdImage> Clipped() {
    return Changed([](float z) { return std::clamp(z, kNearest, kFarthest); });
  }

  // Runs the images. `is_saved`: whether the run is saved and continued after image i.
  static OdometryResult Run(const std::vector<RgbdImage>& images, int threads = 1,
                            const std::function<bool(int64_t)>& is_saved = {}) {
    const auto make = [threads] {
      OdometryOptions options;
      options.threads = threads;
      return std::make_unique<Odometry>(options, camera_, LensDistortion());
    };
    std::unique_ptr<Odometry> odometry = make();
    for (const RgbdImage& image : images) {
      odometry->Process(image);
      if (!is_saved || !is_saved(image.id)) continue;
      ObjectJournal journal;
      BinaryWriter writer(&journal);
      EXPECT_TRUE(odometry->Save(&writer));
      odometry = make();
      ObjectJournal loaded(journal.pending());
      BinaryReader reader(writer.bytes(), &loaded);
      odometry->Restore(&reader);
      reader.Finish();
    }
    return odometry->Finish();
  }
};

TEST_F(ClippedDepthRunTest, IsRepeatableFromACheckpointAndAtAnyNumberOfThreads) {
  const std::vector<RgbdImage> images = Clipped();
  const OdometryResult expected = Run(images);
  ExpectSameBytes(Run(images, 3), expected);
  ExpectSameBytes(Run(images, 2, [](int64_t i) { return i % 5 == 2; }), expected);
}

TEST_F(ClippedDepthRunTest, LogsTheLimits) {
  std::ostringstream text;
  const auto silent = Log().sinks();
  Log().sinks() = {std::make_shared<spdlog::sinks::ostream_sink_mt>(text)};
  Log().set_level(spdlog::level::warn);
  Run(*images_);
  EXPECT_THAT(text.str(), Not(Names("clipped")));
  Run(Clipped());
  EXPECT_THAT(text.str(), LineNames("clipped", "2.500 m"));
  Log().set_level(spdlog::level::off);
  Log().sinks() = silent;
}

}  // namespace
}  // namespace msc_vo
