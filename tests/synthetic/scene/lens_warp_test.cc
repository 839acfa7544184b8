// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/lens_warp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "tests/support/lenses.h"
#include "tests/support/message_matchers.h"
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

// Depth along the ray of a recorded pixel; infinity where it hits nothing.
double TrueDepth(const SyntheticSequence& sequence, const LensDistortion& lens,
                 const Rigid3& world_from_cam, const Vector2d& pixel) {
  const Vector3d ray = sequence.camera().Ray(lens.Undistort(sequence.camera(), pixel));
  const auto hit =
      sequence.scene().CastRay(world_from_cam.translation(), world_from_cam.rotation() * ray);
  return hit ? *hit : std::numeric_limits<double>::infinity();
}

// The depth of a recorded pixel is that of the first surface on its ray, or, at edges between
// surfaces, on a ray within a pixel of it.
TEST(LensWarpTest, RecordsWhatTheRaysHit) {
  SyntheticSequenceOptions options = WideOptions();
  options.width = 320;
  options.height = 240;
  options.focal_length = 150.0;
  for (const LensDistortion& lens : {WideLens(), AzureKinectLens()}) {
    options.lens = lens;
    const SyntheticSequence sequence(options);
    const SyntheticFrame frame = sequence.Render(2);
    ASSERT_EQ(frame.image.width, 320);
    int exact = 0, seen = 0;
    for (int y = 6; y < 234; y += 6) {
      for (int x = 6; x < 314; x += 6) {
        const double depth = frame.image.depth[y * 320 + x];
        if (depth == 0.0) continue;
        ++seen;
        const Vector2d pixel(x, y);
        const auto truth = [&](const Vector2d& at) {
          return TrueDepth(sequence, lens, frame.pose.world_from_cam, at);
        };
        if (std::abs(truth(pixel) / depth - 1.0) < 1e-5) {
          ++exact;
          continue;
        }
        double low = truth(pixel), high = low;
        for (double v = -1.0; v <= 1.0; v += 0.25) {
          for (double u = -1.0; u <= 1.0; u += 0.25) {
            const double near = truth(pixel + Vector2d(u, v));
            low = std::min(low, near);
            high = std::max(high, near);
          }
        }
        EXPECT_LE(low, depth * (1.0 + 1e-5)) << x << " " << y;
        EXPECT_GE(high, depth * (1.0 - 1e-5)) << x << " " << y;
      }
    }
    EXPECT_GT(seen, 1800);
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
  EXPECT_THAT(error(options), Names("lens", "readout_time"));
  options = WideOptions();
  options.lens.k[0] = -2.0;
  EXPECT_THAT(error(options), Names("lens", "folds"));
  options = WideOptions();
  options.focal_length = 1.0;
  EXPECT_THAT(error(options), Names("focal_length", "not 1 px"));
}

}  // namespace
}  // namespace msc_vo
