// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/lens_warp.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/support/lenses.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

SyntheticSequenceOptions WideOptions() {
  SyntheticSequenceOptions options;
  options.width = 160;
  options.height = 120;
  options.image_sigma = 0.0;
  options.focal_length = 75.0;
  options.lens = WideLens();
  return options;
}

// Depth and colour of a recorded pixel are those of the first surface on its ray.
TEST(LensWarpTest, RecordsWhatTheRaysHit) {
  SyntheticSequenceOptions options = WideOptions();
  options.width = 320;
  options.height = 240;
  options.focal_length = 150.0;
  for (const LensDistortion& lens : {WideLens(), AzureKinectLens()}) {
    options.lens = lens;
    const SyntheticSequence sequence(options);
    const SyntheticFrame frame = sequence.Render(2);
    const Rigid3& world_from_cam = frame.pose.world_from_cam;
    ASSERT_EQ(frame.image.width, 320);
    int exact = 0, seen = 0;
    for (int y = 0; y < 240; y += 6) {
      for (int x = 0; x < 320; x += 6) {
        const float depth = frame.image.depth[y * 320 + x];
        if (depth == 0.0f) continue;
        ++seen;
        const Vector3d ray = sequence.camera().Ray(lens.Undistort(sequence.camera(), {x, y}));
        const auto hit =
            sequence.scene().CastRay(world_from_cam.translation(), world_from_cam.rotation() * ray);
        exact += hit && std::abs(*hit / depth - 1.0) < 1e-5;
      }
    }
    EXPECT_GT(seen, 2000);
    // The others, 7 %, are within a pixel of an edge between two surfaces.
    EXPECT_GT(exact, seen * 90 / 100);
  }
}

TEST(LensWarpTest, PixelsOfTheSourceAreSmallEnough) {
  const LensWarp warp(WideCamera(), WideLens());
  EXPECT_GE(warp.source().fx, WideCamera().fx);
  const double right = (warp.source().width - 1 - warp.source().cx) / warp.source().fx;
  EXPECT_GT(right, std::tan(1.0));
  EXPECT_LT(right, std::tan(M_PI * LensWarp::kMaxAngle / 180.0) + 0.1);
}

TEST(LensWarpTest, RejectsWhatCannotBeRendered) {
  const auto error = [](const SyntheticSequenceOptions& options) {
    std::string text;
    return options.IsValid(&text) ? std::string() : text;
  };
  SyntheticSequenceOptions options = WideOptions();
  EXPECT_EQ(error(options), "");
  options.readout_time = 0.01;
  EXPECT_THAT(error(options), ::testing::HasSubstr("global shutter"));
  options = WideOptions();
  options.lens.k[0] = -2.0;
  EXPECT_THAT(error(options), ::testing::HasSubstr("folds over"));
  options = WideOptions();
  options.focal_length = 1.0;
  EXPECT_THAT(error(options), ::testing::HasSubstr("focal length"));
}

}  // namespace
}  // namespace msc_vo
