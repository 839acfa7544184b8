// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Mapping on request of the caller (Odometry::RunMapping).

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ExternalMappingTest : public RoomTest {
 protected:
  static OdometryOptions Options(int threads, bool external) {
    OdometryOptions options;
    options.threads = threads;
    options.external_mapping = external;
    return options;
  }
  // Without a budget, RunMapping() is never called.
  static OdometryResult Run(const OdometryOptions& options, std::optional<double> budget) {
    Odometry odometry(options, camera_, {});
    for (const RgbdImage& image : *images_) {
      odometry.Process(image);
      if (budget) odometry.RunMapping(*budget);
    }
    OdometryResult result = odometry.Finish();
    EXPECT_FALSE(odometry.MappingPending());
    return result;
  }
  // Index of the first image whose Process() throws.
  static int FirstFailure(Odometry* odometry, bool external) {
    for (size_t i = 0; i < images_->size(); ++i) {
      try {
        odometry->Process((*images_)[i]);
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "no wheel data");
        return static_cast<int>(i);
      }
      if (external) odometry->RunMapping(kInfinity);  // does not throw
    }
    return -1;
  }
};

TEST_F(ExternalMappingTest, GivesTheSameBytesAtAnyBudget) {
  const OdometryResult expected = Run(Options(1, false), std::nullopt);
  for (const std::optional<double> budget :
       {std::optional<double>(), std::optional(0.0005), std::optional(kInfinity)}) {
    ExpectSameBytes(Run(Options(1, true), budget), expected);
  }
  ExpectSameBytes(Run(Options(2, true), 0.003), expected);
}

TEST_F(ExternalMappingTest, CountsUnfinishedMapsAsLateInRealTime) {
  OdometryOptions options = Options(1, true);
  options.snapshots.realtime = true;
  const OdometryResult never = Run(options, std::nullopt);
  EXPECT_GT(never.num_late_maps, 0);
  EXPECT_EQ(never.frames.size(), images_->size());
  const OdometryResult in_time = Run(options, kInfinity);
  EXPECT_EQ(in_time.num_late_maps, 0);
  ExpectSameBytes(in_time, Run(Options(1, false), std::nullopt));
}

TEST_F(ExternalMappingTest, CallbacksRunInTheThreadOfTheCaller) {
  Odometry odometry(Options(2, true), camera_, {});
  int num_windows = 0, num_in_gaps = 0;
  bool in_gap = false;
  const std::thread::id caller = std::this_thread::get_id();
  odometry.SetWindowFactors([&](const WindowContext& context) {
    ++num_windows;
    num_in_gaps += in_gap ? 1 : 0;
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_FALSE(context.data->points.empty());
    return WindowFactors();
  });
  for (const RgbdImage& image : *images_) {
    odometry.Process(image);
    in_gap = true;
    if (image.id < 30) odometry.RunMapping(kInfinity);
    in_gap = false;
  }
  odometry.Finish();
  EXPECT_GT(num_in_gaps, 1);
  EXPECT_LT(num_in_gaps, num_windows);
}

TEST_F(ExternalMappingTest, ThrowsErrorsOfKeyframesAtTheSameFrame) {
  std::vector<int> failures;
  for (const bool external : {false, true}) {
    Odometry odometry(Options(1, external), camera_, {});
    int num_windows = 0;
    odometry.SetWindowFactors([&](const WindowContext&) -> WindowFactors {
      if (++num_windows == 3) throw std::runtime_error("no wheel data");
      return {};
    });
    failures.push_back(FirstFailure(&odometry, external));
  }
  EXPECT_GT(failures[0], 0);
  EXPECT_EQ(failures[0], failures[1]);
}

TEST_F(ExternalMappingTest, SavesAndRestoresWithPendingWork) {
  const OdometryResult expected = Run(Options(1, false), std::nullopt);
  Odometry first(Options(1, true), camera_, {}), second(Options(1, true), camera_, {});
  size_t next = 0;
  while (next < 20 || !first.MappingPending()) first.Process(images_->at(next++));
  EXPECT_TRUE(first.IsMapping());
  first.RunMapping(0.001);
  ObjectJournal journal;
  BinaryWriter writer(&journal);
  ASSERT_TRUE(first.Save(&writer));
  EXPECT_FALSE(first.IsMapping());
  EXPECT_FALSE(first.MappingPending());
  ObjectJournal loaded(journal.pending());
  BinaryReader reader(writer.bytes(), &loaded);
  second.Restore(&reader);
  for (; next < images_->size(); ++next) {
    for (Odometry* odometry : {&first, &second}) odometry->Process((*images_)[next]);
    second.RunMapping(0.002);
  }
  ExpectSameBytes(first.Finish(), expected);
  ExpectSameBytes(second.Finish(), expected);
}

TEST_F(ExternalMappingTest, MapFinishesPendingWork) {
  Odometry odometry(Options(1, true), camera_, {});
  size_t next = 0;
  while (next < 10 || !odometry.MappingPending()) odometry.Process(images_->at(next++));
  const KeyframeId newest = odometry.Map()->newest_keyframe;
  EXPECT_FALSE(odometry.MappingPending());
  EXPECT_GT(newest, 0);
  EXPECT_EQ(odometry.Map()->newest_keyframe, newest);
}

TEST_F(ExternalMappingTest, RefusesMisuse) {
  Odometry internal(Options(1, false), camera_, {}), external(Options(1, true), camera_, {});
  EXPECT_THROW(internal.RunMapping(1.0), std::invalid_argument);
  internal.Process(images_->front());
  EXPECT_FALSE(internal.MappingPending());
  EXPECT_THROW(external.RunMapping(-0.001), std::invalid_argument);
  EXPECT_THROW(external.RunMapping(std::nan("")), std::invalid_argument);
  EXPECT_FALSE(external.RunMapping(0.0));
}

}  // namespace
}  // namespace msc_vo
