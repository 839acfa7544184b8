// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Errors in custom factors and extra blocks.

#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/support/custom_factors.h"
#include "tests/support/message_matchers.h"
#include "tests/support/test_window.h"
#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/factors/plane_manifold.h"

namespace msc_vo {
namespace {

struct Undefined {
  template <typename T>
  bool operator()(const T*, T*) const {
    return false;
  }
};

struct NotFinite {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = x[0] * std::numeric_limits<double>::quiet_NaN();
    return true;
  }
};

// Its derivative at x = 0 is infinite.
struct SquareRoot {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    using std::sqrt;
    residual[0] = sqrt(x[0]);
    return true;
  }
};

class CustomValidationTest : public ::testing::Test {
 protected:
  CustomValidationTest() {
    scene_.num_keyframes = 4;
    good_ = MakeTestWindow(scene_).data;
    good_.extra_blocks.push_back({5, Eigen::VectorXd::Zero(3), {}, false});
    good_.custom_factors.push_back(
        MakeCustomFactor<3, 3, 3>("mine", PointDifference{Eigen::Vector3d::Zero(), 1.0},
                                  {BlockId::Point(good_.points[0].id), BlockId::Extra(5)}));
  }

  // The message of LocalBundleAdjustment, which must leave the data unchanged.
  std::string ErrorOf(const std::function<void(WindowData*)>& change) {
    WindowData data = good_;
    change(&data);
    const WindowData before = data;
    try {
      LocalBundleAdjustment({}, &data);
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(SameState(data, before));
      return error.what();
    }
    return "";
  }
  std::string ErrorOfFactor(const CustomFactor& factor) {
    return ErrorOf([&factor](WindowData* data) { data->custom_factors = {factor}; });
  }

  TestWindowOptions scene_;
  WindowData good_;
};

TEST_F(CustomValidationTest, AcceptsAValidFactor) {
  EXPECT_EQ(ErrorOf([](WindowData*) {}), "");
}

TEST_F(CustomValidationTest, NamesTheFactor) {
  CustomFactor factor = good_.custom_factors[0];
  factor.cost = nullptr;
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "null"));
  factor = good_.custom_factors[0];
  factor.blocks.pop_back();
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "parameter block", "2", "1"));
  factor.blocks.push_back(BlockId::Pose(good_.keyframes[0].id));
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "block 1", "3", "keyframe 100", "7"));
  factor.blocks[1] = factor.blocks[0];
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "point 1000", "twice"));
  factor.blocks[1] = BlockId::Axes();
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "Manhattan axes"));
  factor.blocks[1] = BlockId::Extra(6);
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "extra block", "6"));
  factor.blocks[1] = BlockId::Line(1);
  EXPECT_THAT(ErrorOfFactor(factor), Names("'mine'", "line 1"));
}

TEST_F(CustomValidationTest, NamesAFactorThatCannotBeEvaluated) {
  EXPECT_THAT(ErrorOfFactor(MakeCustomFactor<1, 3>("u", Undefined(), {BlockId::Extra(5)})),
              Names("'u'", "evaluated"));
  EXPECT_THAT(ErrorOfFactor(MakeCustomFactor<1, 3>("n", NotFinite(), {BlockId::Extra(5)})),
              Names("'n'", "evaluated"));
  EXPECT_THAT(ErrorOfFactor(MakeCustomFactor<1, 3>("s", SquareRoot(), {BlockId::Extra(5)})),
              Names("'s'", "derivatives"));
}

TEST_F(CustomValidationTest, IgnoresDerivativesOfFixedBlocks) {
  EXPECT_EQ(
      ErrorOf([](WindowData* data) {
        data->extra_blocks[0].fixed = true;
        data->custom_factors = {MakeCustomFactor<1, 3>("s", SquareRoot(), {BlockId::Extra(5)})};
      }),
      "");
}

TEST_F(CustomValidationTest, NamesTheExtraBlock) {
  const auto error_of = [this](const ExtraBlock& extra) {
    return ErrorOf([&extra](WindowData* data) { data->extra_blocks.push_back(extra); });
  };
  EXPECT_THAT(error_of({5, Eigen::VectorXd::Zero(1), {}, false}),
              Names("extra block", "5", "twice"));
  EXPECT_THAT(error_of({6, Eigen::VectorXd(), {}, false}), Names("extra block", "6", "no value"));
  EXPECT_THAT(error_of({6, Eigen::VectorXd::Constant(1, INFINITY), {}, false}),
              Names("extra block", "6", "finite"));
  const auto direction = std::make_shared<UnitVectorManifold>();
  const auto plane = std::make_shared<PlaneManifold>();
  EXPECT_THAT(error_of({6, Eigen::VectorXd::Zero(2), direction, false}),
              Names("extra block", "6", "2", "manifold", "3"));
  EXPECT_EQ(error_of({6, Eigen::Vector3d(0.0, 0.6, 0.8), direction}), "");
  EXPECT_THAT(error_of({6, Eigen::Vector3d(0.0, 0.0, 9.81), direction}),
              Names("extra block", "6", "unit vector"));
  EXPECT_EQ(error_of({6, Eigen::Vector4d(0.0, 0.6, 0.8, 2.0), plane}), "");
  EXPECT_THAT(error_of({6, Eigen::Vector4d(0.0, 0.0, 2.0, 2.0), plane}),
              Names("extra block", "6", "unit vector"));
}

TEST_F(CustomValidationTest, RejectsAxesThatAreNoRotation) {
  EXPECT_THAT(ErrorOf([](WindowData* data) {
                data->axes.emplace();
                data->axes->world_from_axes.coeffs() *= 1.1;
              }),
              Names("Manhattan axes", "quaternion"));
}

TEST_F(CustomValidationTest, RequiresAGauge) {
  EXPECT_THAT(ErrorOf([](WindowData* data) {
                for (auto& keyframe : data->keyframes) keyframe.fixed = false;
              }),
              Names("gauge"));
}

}  // namespace
}  // namespace msc_vo
