// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/image_exposure.h"

#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/odometry/loss_cause.h"

namespace msc_vo {
namespace {

// Stripes an eighth of the width wide, whose edges are blurred by a Gaussian of `sigma` pixels.
cv::Mat BlurredStripes(int width, double sigma) {
  cv::Mat image(width * 3 / 4, width, CV_8UC1);
  for (int x = 0; x < width; ++x) image.col(x).setTo(x * 8 / width % 2 == 0 ? 90 : 150);
  cv::GaussianBlur(image, image, cv::Size(), sigma);
  return image;
}

TEST(ImageExposure, MeasuresTheSameBlurAtEveryImageSize) {
  for (const int width : {320, 640, 1280, 1920}) {
    const double sigma = 4.0 * width / 640.0;
    // Grey levels are rounded, so that the ends of a wide edge are flat.
    EXPECT_NEAR(MeasureExposure(BlurredStripes(width, sigma)).edge_width / (2.5 * sigma), 1.0, 0.1)
        << width;
  }
}

// An image of one grey level and the noise of a sensor.
ImageExposure Uniform(double grey, double measured_depth) {
  ImageExposure image;
  image.mean = image.bright_level = grey;
  image.contrast = 2.0;
  image.measured_depth = measured_depth;
  return image;
}

ImageExposure Textured() {
  ImageExposure image = Uniform(110.0, 1.0);
  image.bright_level = 200.0;
  image.contrast = 40.0;
  return image;
}

Findings FindingsOf(const std::vector<ImageExposure>& images) {
  Findings findings;
  AddExposureFindings(images, 640, &findings);
  return findings;
}

TEST(UniformImages, AreAWarningThatNamesPlanesIfTheyHaveDepth) {
  for (const double grey : {5.0, 143.0, 240.0}) {
    const Findings findings = FindingsOf({Uniform(grey, 0.9), Uniform(grey, 0.3)});
    const Finding finding =
        ExpectFinding(findings, Severity::kWarning, "images.uniform",
                      Names("2 of 2", "100 %", "planes", "three directions"), "grey");
    EXPECT_EQ(Describe(finding).find("leave"), std::string::npos) << Describe(finding);
    EXPECT_EQ(findings.size(), 1U) << Text(findings);
  }
}

TEST(UniformImages, AreAnErrorIfMostHaveNoDepth) {
  ExpectFinding(FindingsOf({Uniform(5.0, 0.0), Uniform(5.0, 0.02), Textured()}), Severity::kError,
                "images.uniform", Names("2 of 3", "black", "leave these images out"), "most");
  ExpectFinding(FindingsOf({Uniform(5.0, 0.0), Textured(), Textured()}), Severity::kWarning,
                "images.uniform", Names("1 of 3", "leave these images out"), "few");
}

TEST(UniformImages, AreCountedWithAndWithoutDepth) {
  const Findings findings =
      FindingsOf({Uniform(5.0, 0.0), Uniform(200.0, 1.0), Uniform(200.0, 1.0), Textured()});
  ExpectFinding(findings, Severity::kWarning, "images.uniform", Names("1 of 4", "black", "leave"),
                "without depth");
  ExpectFinding(findings, Severity::kWarning, "images.uniform", Names("2 of 4", "grey", "planes"),
                "with depth");
}

// Those that `images.uniform` reports have no exposure that would be good.
TEST(UniformImages, TakeNoPartInTheExposure) {
  ExpectFinding(FindingsOf({Uniform(5.0, 1.0), Uniform(5.0, 1.0), Textured()}), Severity::kGood,
                "images.exposure", Names("110", "40"), "exposure");
}

TEST(UniformImages, AreThoseOfARun) {
  for (const double contrast : {1.0, 3.0, 3.9, 4.1, 10.0}) {
    ImageExposure image = Textured();
    image.contrast = contrast;
    const Findings findings = FindingsOf({image});
    FrameResult frame;
    frame.image = {image.mean, contrast, 1.0};
    EXPECT_EQ(findings.front().check == "images.uniform",
              FindLossCause(frame, 20, false) == LossCause::kUniformImage)
        << contrast << Text(findings);
  }
}

}  // namespace
}  // namespace msc_vo
