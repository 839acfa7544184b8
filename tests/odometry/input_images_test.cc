// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What Odometry::Process() accepts as images.

#include <stdexcept>

#include "tests/support/image_views.h"
#include "tests/support/message_matchers.h"
#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

class InputImagesTest : public RoomTest {
 protected:
  static OdometryResult Run(const OdometryOptions& options, double depth_delay, bool as_views) {
    Odometry odometry(options, camera_, {});
    for (int i = 0; i < 30; ++i) {
      RgbdImage image = (*images_)[i];
      image.depth_delay = depth_delay;
      if (as_views) {  // another kind of view, and other surroundings, for every image
        image.gray = ViewsOf(image.gray, i)[i % 3];
        image.depth = ViewsOf(image.depth, i)[i % 3];
      }
      odometry.Process(image);
    }
    return odometry.Finish();
  }

  // Whole units; the images of the suite share their pixels.
  static cv::Mat Rounded(const cv::Mat& depth, double units_per_metre) {
    cv::Mat raw, rounded;
    depth.convertTo(raw, CV_16UC1, units_per_metre);
    raw.convertTo(rounded, CV_32FC1);
    return rounded;
  }

  static std::string ErrorOf(const RgbdImage& image) {
    Odometry odometry({}, camera_, {});
    try {
      odometry.Process(image);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(InputImagesTest, ViewsGiveTheBitsOfCopies) {
  for (const double delay : {0.0, 0.004}) {
    for (const LineDetector detector : {LineDetector::kEdgeDrawing, LineDetector::kLsd}) {
      OdometryOptions options;
      options.features.lines.detector = detector;
      options.mapping.self_calibration = true;
      ExpectSameBytes(Run(options, delay, false), Run(options, delay, true));
    }
  }
}

// As a driver does that writes every image into the same memory.
TEST_F(InputImagesTest, MayBeOverwrittenAfterTheCall) {
  OdometryOptions options;
  options.mapping.self_calibration = true;
  for (const int threads : {1, 2}) {
    options.threads = threads;
    for (const double delay : {0.0, 0.004}) {
      Odometry odometry(options, camera_, {});
      RgbdImage image;
      for (int i = 0; i < 30; ++i) {
        const RgbdImage& given = (*images_)[i];
        image.id = given.id;
        image.timestamp = given.timestamp;
        image.depth_delay = delay;
        given.gray.copyTo(image.gray);
        given.depth.copyTo(image.depth);
        odometry.Process(image);
        image.gray = i % 2;
        image.depth = 0.5;
      }
      ExpectSameBytes(Run(options, delay, false), odometry.Finish());
    }
  }
}

TEST_F(InputImagesTest, WrongTypesAndSizesAreRefusedBeforeTheyAreRead) {
  Odometry odometry({}, camera_, {});
  for (int i = 0; i < 3; ++i) odometry.Process((*images_)[i]);
  RgbdImage image = (*images_)[3];
  image.depth_delay = 0.01;  // depth is warped before features are extracted
  image.depth = cv::Mat(image.depth.rows / 2, image.depth.cols, CV_32FC1, cv::Scalar(1.5));
  EXPECT_THROW(odometry.Process(image), std::invalid_argument);
  image.depth = cv::Mat(image.gray.size(), CV_16UC1, cv::Scalar(1500));
  EXPECT_THROW(odometry.Process(image), std::invalid_argument);
  EXPECT_EQ(odometry.Process((*images_)[3]).status, TrackingStatus::kTracked);
}

TEST_F(InputImagesTest, RawDepthIsNotTakenForMetres) {
  for (const double units_per_metre : {1000.0, 5000.0}) {
    RgbdImage image = (*images_)[0];
    image.depth = Rounded(image.depth, units_per_metre);
    EXPECT_THAT(ErrorOf(image), Names("image 0", "metres", "1000"));
  }
}

TEST_F(InputImagesTest, MetresRoundedToTheMillimetreAndSentinelsAreTaken) {
  RgbdImage image = (*images_)[0];
  image.depth = 0.001 * Rounded(image.depth, 1000.0);
  EXPECT_EQ(ErrorOf(image), "");
  image.depth = cv::Mat(image.depth.size(), CV_32FC1, cv::Scalar(65504.0));  // sky of a simulator
  EXPECT_EQ(ErrorOf(image), "");
}

}  // namespace
}  // namespace msc_vo
