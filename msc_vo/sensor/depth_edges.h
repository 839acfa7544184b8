// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// A pixel of a depth image beside which the depth jumps, on the nearer surface: the farther one
/// ends where it is occluded, or where the sensor's shadow begins.
struct DepthEdge {
  int x = 0;
  int y = 0;
  bool horizontal_jump = false;  ///< the depth jumps along the row
  /// Side of the farther surface: 1 if it is to the right of the pixel or below it, -1 if it is to
  /// the left or above.
  int far_side = 0;
};

/// Largest distance of the pixels on both sides of an edge at an image width of 320 pixels: the
/// shadow of a structured-light sensor is a gap without depth.
constexpr int kMaxEdgeGap = 10;

/// The edges of a depth image (CV_32FC1, metres; 0: no measurement). `max_gap`: largest distance of
/// the pixels on both sides of an edge.
std::vector<DepthEdge> FindDepthEdges(const cv::Mat& depth, int max_gap = kMaxEdgeGap);

/// Gradients closer to the border of an image than this are not compared with depth edges, pixels.
constexpr int kEdgeBorder = 4;

/// Gradients of a grey image along rows and along columns, with mean 0 and standard deviation 1.
struct EdgeGradients {
  cv::Mat along_rows;
  cv::Mat along_columns;
};
EdgeGradients GradientsOf(const cv::Mat& gray);

/// Sum of the gradients at all edges, shifted by (dx, dy); edges that leave the image count 0.
double SumAtEdges(const std::vector<DepthEdge>& edges, const EdgeGradients& gradients, int dx,
                  int dy);

/// An RGB-D image reduced to a smaller width. A pixel of the reduced grey image is the mean of an
/// area, one of the depth image the value at the first pixel of that area.
struct ReducedImage {
  cv::Mat gray;
  cv::Mat depth;
  double step = 1.0;  ///< pixels of the full image per pixel
};
/// Reduces images of more than `width` pixels in width.
ReducedImage Reduce(const cv::Mat& gray, const cv::Mat& depth, int width = 320);

/// How well depth edges lie on image edges.
struct EdgeAgreement {
  int num_edges = 0;  ///< pixels of the reduced image
  /// Mean gradient there, in standard deviations of the gradients above their mean; 0: no edges.
  double mean = 0.0;
};
EdgeAgreement MeasureEdgeAgreement(const cv::Mat& gray, const cv::Mat& depth);

/// Compares depth images that are registered in two ways. An error of the depth sensor may look
/// like a wrong registration to the motion of points, but not to the edges.
class EdgeComparison {
 public:
  /// Adds an image: CV_8UC1 grey, CV_32FC1 depth in metres, before and after another registration.
  void Add(const cv::Mat& gray, const cv::Mat& before, const cv::Mat& after);
  /// Whether depth edges lie on image edges better with the other registration, in images with
  /// three quarters of all edges. True without edges.
  bool Agrees() const { return num_better_ >= 3 * num_worse_; }

 private:
  int num_better_ = 0;  // edges of the images in which they lie better
  int num_worse_ = 0;
};

}  // namespace msc_vo
