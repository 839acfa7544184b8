// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace msc_vo::testing {

// Draws anti-aliased images: at eight times their size, then averaged. Coordinates are pixels of
// the final image with the centre of the first pixel at (0, 0).
class Canvas {
 public:
  Canvas(int width, int height, int background)
      : fine_(height * kFactor, width * kFactor, CV_8UC1, cv::Scalar(background)) {}

  void FillPolygon(const std::vector<Eigen::Vector2d>& corners, int gray) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& corner : corners) {
      points.emplace_back(cvRound((corner.x() + 0.5) * kFactor - 0.5),
                          cvRound((corner.y() + 0.5) * kFactor - 0.5));
    }
    cv::fillPoly(fine_, std::vector<std::vector<cv::Point>>{points}, cv::Scalar(gray));
  }

  void FillRectangle(double x0, double y0, double x1, double y1, int gray) {
    FillPolygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, gray);
  }

  // Returns the image with Gaussian noise of the given standard deviation (grey values).
  cv::Mat Render(double noise = 0.0, uint32_t seed = 1) const {
    cv::Mat image;
    cv::resize(fine_, image, cv::Size(fine_.cols / kFactor, fine_.rows / kFactor), 0.0, 0.0,
               cv::INTER_AREA);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    for (int y = 0; y < image.rows && noise > 0.0; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        uint8_t& value = image.at<uint8_t>(y, x);
        value = cv::saturate_cast<uint8_t>(value + noise * normal(random));
      }
    }
    return image;
  }

 private:
  static constexpr int kFactor = 8;
  cv::Mat fine_;
};

// Draws quadrilaterals of many sizes, positions and grey values, all translated by `shift` and
// rotated by `angle` (radians) about the centre of the image: an image with many corners and edges.
inline cv::Mat DrawQuadrilaterals(int width, int height, const Eigen::Vector2d& shift,
                                  double angle = 0.0, double noise = 1.0, int count = 160) {
  Canvas canvas(width, height, 120);
  std::mt19937 random(7);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  const Eigen::Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d center{uniform(0.0, width), uniform(0.0, height)};
    const Eigen::Vector2d half{uniform(8.0, 50.0), uniform(8.0, 50.0)};
    const double own = uniform(0.0, 3.0);
    Eigen::Matrix2d own_turn;
    own_turn << std::cos(own), -std::sin(own), std::sin(own), std::cos(own);
    std::vector<Eigen::Vector2d> corners;
    for (const Eigen::Vector2d& sign : {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, -1),
                                        Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)}) {
      const Eigen::Vector2d corner = center + own_turn * half.cwiseProduct(sign);
      corners.push_back(middle + turn * (corner - middle) + shift);
    }
    canvas.FillPolygon(corners, static_cast<int>(uniform(10.0, 245.0)));
  }
  return canvas.Render(noise, static_cast<uint32_t>(1000 * (shift.norm() + angle)) + 1);
}

}  // namespace msc_vo::testing
