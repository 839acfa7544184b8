// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// One rule for exceptions of Odometry::Process(): an image that is refused leaves no frame; any
// other exception is thrown after the frame is complete.

#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "tests/support/custom_pose_factors.h"
#include "tests/support/message_matchers.h"
#include "tests/support/rendered_images.h"
#include <ceres/cost_function.h>
#include <gmock/gmock.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

using ::testing::HasSubstr;

// A cost function over a pose that throws when it is evaluated for the `count`-th time.
class ThrowingCost : public ceres::CostFunction {
 public:
  ThrowingCost(std::shared_ptr<const ceres::CostFunction> cost, int count)
      : cost_(std::move(cost)), count_(count) {
    set_num_residuals(cost_->num_residuals());
    *mutable_parameter_block_sizes() = cost_->parameter_block_sizes();
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (--count_ == 0) throw std::runtime_error("on purpose");
    return cost_->Evaluate(parameters, residuals, jacobians);
  }

 private:
  std::shared_ptr<const ceres::CostFunction> cost_;
  mutable int count_;
};

// Sets a callback that fails in one call.
using Saboteur = std::function<void(Odometry*)>;

struct Kind {
  std::string name;
  Saboteur sabotage;
  std::string message;  // of the exception
};

// Calls `fail` in call number `when`, and returns the factors of that call.
template <typename Factors, typename Context>
std::function<Factors(const Context&)> FailIn(int when, std::function<Factors()> fail) {
  return [when, fail, calls = std::make_shared<int>(0)](const Context&) {
    return ++*calls == when ? fail() : Factors();
  };
}

constexpr int kCall = 3;

Kind FailingPoseFactors(const std::string& name, const std::function<PoseFactor()>& factor,
                        const std::string& message) {
  return {name,
          [factor](Odometry* odometry) {
            odometry->SetPoseFactors(FailIn<std::vector<PoseFactor>, FrameContext>(
                kCall, [factor] { return std::vector<PoseFactor>{factor()}; }));
          },
          message};
}

// A prior so weak that it changes nothing but the last bits, which throws in its evaluation.
PoseFactor ThrowingFactor(int count) {
  PoseFactor factor = PriorFactor("late", Rigid3(), 1e3, 1e3);
  factor.cost = std::make_shared<ThrowingCost>(factor.cost, count);
  return factor;
}

// Exceptions of the factors over the pose of a frame.
std::vector<Kind> PoseFactorKinds() {
  return {
      FailingPoseFactors(
          "pose factor callback", []() -> PoseFactor { throw std::runtime_error("on purpose"); },
          "on purpose"),
      FailingPoseFactors(
          "invalid pose factor",
          [] {
            return PoseFactor{"wheel", nullptr, nullptr};
          },
          "'wheel'"),
      FailingPoseFactors(
          "first evaluation of a pose factor", [] { return ThrowingFactor(1); }, "on purpose"),
      FailingPoseFactors(
          "later evaluation of a pose factor", [] { return ThrowingFactor(12); }, "on purpose")};
}

// Exceptions of keyframe steps and of the tracking observer.
std::vector<Kind> OtherKinds() {
  const auto throws = []() -> WindowFactors { throw std::runtime_error("on purpose"); };
  const auto invalid = [] {
    WindowFactors factors;
    factors.factors.push_back({"marker", nullptr, nullptr, {BlockId::Pose(0)}});
    return factors;
  };
  return {{"window observer",
           [calls = 0](Odometry* odometry) {
             odometry->SetWindowObserver(
                 [calls](KeyframeId, const BundleAdjustmentOptions&, const WindowData&) mutable {
                   if (++calls == 2) throw std::runtime_error("on purpose");
                 });
           },
           "on purpose"},
          {"window factor callback",
           [throws](Odometry* odometry) {
             odometry->SetWindowFactors(FailIn<WindowFactors, WindowContext>(2, throws));
           },
           "on purpose"},
          {"invalid window factor",
           [invalid](Odometry* odometry) {
             odometry->SetWindowFactors(FailIn<WindowFactors, WindowContext>(2, invalid));
           },
           "'marker'"},
          {"tracking observer",
           [](Odometry* odometry) {
             odometry->SetTrackingObserver([](const TrackedImage& image) {
               if (image.result.id == kCall) throw std::runtime_error("on purpose");
             });
           },
           "on purpose"}};
}

class ProcessErrorsTest : public RoomTest {
 protected:
  // Options for threads and latencies of all combinations.
  static std::vector<OdometryOptions> AllOptions() {
    std::vector<OdometryOptions> all;
    for (const int threads : {1, 2}) {
      for (const bool waits : {false, true}) {
        OdometryOptions options;
        options.threads = threads;
        if (waits) options.snapshots.insertion_latency = options.snapshots.latency = 0.0;
        all.push_back(options);
      }
    }
    return all;
  }

  // The frame of the image is complete, and the image is refused when it is passed again.
  static void ExpectProcessed(const RgbdImage& image, Odometry* odometry) {
    const size_t count = odometry->frames().size();
    ASSERT_EQ(count, static_cast<size_t>(image.id) + 1);
    const FrameResult& frame = odometry->frames().back();
    EXPECT_EQ(frame.id, image.id);
    EXPECT_EQ(frame.timestamp, image.timestamp);
    EXPECT_EQ(frame.status, TrackingStatus::kTracked);
    try {
      odometry->Process(image);
      ADD_FAILURE() << "the image was processed twice";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(),
                  Names("image " + std::to_string(image.id), "time stamp", "previous"));
    }
    EXPECT_EQ(odometry->frames().size(), count);
  }

  static OdometryResult Run(const OdometryOptions& options, const Kind& kind) {
    Odometry odometry(options, camera_, LensDistortion());
    kind.sabotage(&odometry);
    int num_errors = 0;
    for (const RgbdImage& image : *images_) {
      try {
        const FrameResult frame = odometry.Process(image);
        EXPECT_EQ(frame.id, odometry.frames().back().id);
      } catch (const std::exception& error) {
        ++num_errors;
        EXPECT_THAT(error.what(), HasSubstr(kind.message));
        ExpectProcessed(image, &odometry);
      }
    }
    EXPECT_EQ(num_errors, 1);
    return odometry.Finish();
  }
};

TEST_F(ProcessErrorsTest, ComeAfterTheFrameIsComplete) {
  for (const OdometryOptions& options : AllOptions()) {
    for (const Kind& kind : OtherKinds()) {
      SCOPED_TRACE(kind.name + ", threads " + std::to_string(options.threads) + ", latency " +
                   std::to_string(options.snapshots.latency));
      const OdometryResult result = Run(options, kind);
      EXPECT_EQ(result.frames.size(), images_->size());
      EXPECT_LT(ApeRmse(result), 0.01);
    }
  }
}

// A frame whose factors fail has the pose that its image yields.
TEST_F(ProcessErrorsTest, OfPoseFactorsAndObserversDoNotChangeTheRun) {
  const OdometryOptions options;
  Odometry plain(options, camera_, LensDistortion());
  for (const RgbdImage& image : *images_) plain.Process(image);
  const OdometryResult expected = plain.Finish();
  for (const Kind& kind : PoseFactorKinds()) {
    SCOPED_TRACE(kind.name);
    ExpectSameBytes(Run(options, kind), expected);
  }
  ExpectSameBytes(Run(options, OtherKinds().back()), expected);
}

TEST_F(ProcessErrorsTest, ThrowTheFirstOfTwoInOneImage) {
  Odometry odometry(OdometryOptions(), camera_, LensDistortion());
  odometry.SetPoseFactors([](const FrameContext&) -> std::vector<PoseFactor> {
    throw std::runtime_error("from the factors");
  });
  int num_observed = 0;
  odometry.SetTrackingObserver([&](const TrackedImage&) {
    if (++num_observed > 1) throw std::runtime_error("from the observer");
  });
  odometry.Process((*images_)[0]);
  for (int i = 1; i < 4; ++i) {
    try {
      odometry.Process((*images_)[i]);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "from the factors");
    }
    EXPECT_EQ(odometry.frames().back().id, i);
  }
  EXPECT_EQ(num_observed, 4);
}

// An image that is refused is as if it had not been passed.
TEST_F(ProcessErrorsTest, OfTheImageLeaveNoFrame) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(RgbdImage*)>> faults = {
      [](RgbdImage* image) { image->gray = image->gray.rowRange(1, image->gray.rows); },
      [](RgbdImage* image) { image->gray.convertTo(image->gray, CV_16U); },
      [](RgbdImage* image) { image->gray = cv::Mat(); },
      [](RgbdImage* image) { image->depth = image->depth.colRange(1, image->depth.cols); },
      [](RgbdImage* image) { image->depth.convertTo(image->depth, CV_64F); },
      [](RgbdImage* image) { image->depth.convertTo(image->recorded_depth, CV_16U, 1000.0); },
      [nan](RgbdImage* image) { image->timestamp = nan; },
      [](RgbdImage* image) { image->timestamp = -1.0; },
      [](RgbdImage* image) { image->timestamp = 1.7e15; },  // microseconds
      [](RgbdImage* image) { image->depth_delay = 2.0; }};
  Odometry plain({}, camera_, {}), disturbed({}, camera_, {});
  for (const RgbdImage& image : *images_) {
    plain.Process(image);
    if (image.id > 0) {
      RgbdImage bad = image;
      faults[image.id % faults.size()](&bad);
      EXPECT_THROW(disturbed.Process(bad), std::invalid_argument) << image.id;
      EXPECT_EQ(disturbed.frames().size(), static_cast<size_t>(image.id));
    }
    disturbed.Process(image);
  }
  ExpectSameBytes(plain.Finish(), disturbed.Finish());
}

// What the mapper's thread may use cannot change during a run.
TEST_F(ProcessErrorsTest, AreThrownIfTheOdometryIsSetUpAfterTheFirstImage) {
  ObjectJournal journal;
  BinaryWriter writer(&journal);
  ASSERT_TRUE(Odometry({}, camera_, {}).Save(&writer));
  const std::vector<std::pair<std::string, Saboteur>> setters = {
      {"SetWindowObserver", [](Odometry* odometry) { odometry->SetWindowObserver({}); }},
      {"SetWindowFactors", [](Odometry* odometry) { odometry->SetWindowFactors({}); }},
      {"SetPoseFactors", [](Odometry* odometry) { odometry->SetPoseFactors({}); }},
      {"SetTrackingObserver", [](Odometry* odometry) { odometry->SetTrackingObserver({}); }},
      {"SkipClippedDepthSearch", [](Odometry* odometry) { odometry->SkipClippedDepthSearch(); }},
      {"Restore", [&](Odometry* odometry) {
         ObjectJournal loaded(journal.pending());
         BinaryReader reader(writer.bytes(), &loaded);
         odometry->Restore(&reader);
       }}};
  const std::vector<Saboteur> steps = {
      [](Odometry* odometry) { odometry->Process((*images_)[0]); },
      [](Odometry* odometry) { odometry->Drop(0, (*images_)[0].timestamp); }};
  for (const auto& [name, set] : setters) {
    for (const Saboteur& step : steps) {
      Odometry odometry({}, camera_, {});
      EXPECT_NO_THROW(set(&odometry)) << name;
      RgbdImage refused = (*images_)[0];
      refused.depth = cv::Mat();
      EXPECT_THROW(odometry.Process(refused), std::invalid_argument);
      EXPECT_NO_THROW(set(&odometry)) << name;
      step(&odometry);
      try {
        set(&odometry);
        ADD_FAILURE() << name << " was accepted";
      } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), Names(name + "()", "first image"));
      }
      EXPECT_EQ(odometry.Process((*images_)[1]).id, 1);
    }
  }
}

}  // namespace
}  // namespace msc_vo
