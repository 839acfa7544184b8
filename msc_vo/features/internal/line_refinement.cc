// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/line_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// Spacing of the samples along the line, pixels (closer ones would use the same pixels), and their
// largest number in the fine and in the coarse pass.
constexpr double kSpacing = 2.0;
constexpr int kMaxSamples = 48;
constexpr int kMaxCoarseSamples = 16;
// Length of the profile of grey values on each side of the line, pixels.
constexpr int kReach = 3;
// Largest error of a detector, pixels; an edge farther away is another one.
constexpr double kMaxOffset = 1.5;
// Smallest contrast of an edge, grey values per pixel: the sigma of sensor noise is 2 to 3.
constexpr double kMinRise = 4.0;
// Inliers of the second fit are within this distance of the first, pixels.
constexpr double kInlierDistance = 0.75;
constexpr int kMinSamples = 5;

// Bilinear interpolation; the pixel must be at least one pixel inside the image.
double GrayAt(const cv::Mat& gray, const Vector2d& pixel) {
  const int x = static_cast<int>(pixel.x());
  const int y = static_cast<int>(pixel.y());
  const double fx = pixel.x() - x;
  const double fy = pixel.y() - y;
  const uint8_t* upper = gray.ptr<uint8_t>(y) + x;
  const uint8_t* lower = gray.ptr<uint8_t>(y + 1) + x;
  return (1.0 - fy) * ((1.0 - fx) * upper[0] + fx * upper[1]) +
         fy * ((1.0 - fx) * lower[0] + fx * lower[1]);
}

struct Edge {
  double t = 0.0;       // position along the segment from its midpoint, pixels
  double offset = 0.0;  // position across it, towards the bright side, pixels
  double weight = 0.0;
};

// Locates the steepest increase along `across` through `center`: the centroid of the largest
// difference between neighbours and the two adjacent differences.
std::optional<Edge> SteepestRise(const cv::Mat& gray, const Vector2d& center,
                                 const Vector2d& across) {
  const Vector2d low = center - (kReach + 0.5) * across;
  const Vector2d high = center + (kReach + 0.5) * across;
  for (const Vector2d* x : {&low, &high}) {
    const bool is_inside =
        x->x() >= 1.0 && x->y() >= 1.0 && x->x() < gray.cols - 2 && x->y() < gray.rows - 2;
    if (!is_inside) return std::nullopt;
  }
  // rise[k] is the difference centred at offset k - kReach.
  std::array<double, 2 * kReach + 1> rise;
  double previous = GrayAt(gray, low);
  for (size_t k = 0; k < rise.size(); ++k) {
    const double next = GrayAt(gray, low + (k + 1.0) * across);
    rise[k] = next - previous;
    previous = next;
  }
  const auto best = std::max_element(rise.begin() + 1, rise.end() - 1);
  if (*best < kMinRise) return std::nullopt;
  const double before = std::max(0.0, *(best - 1));
  const double after = std::max(0.0, *(best + 1));
  const double offset = static_cast<double>(best - rise.begin()) - kReach +
                        (after - before) / (before + *best + after);
  if (std::abs(offset) > kMaxOffset) return std::nullopt;
  return Edge{0.0, offset, *best};
}

// Weighted least-squares fit of offset = line[0] + line[1] t to the edges within `max_distance` of
// `prior`.
std::optional<Vector2d> FitOffsets(const std::array<Edge, kMaxSamples>& edges, int count,
                                   const Vector2d& prior, double max_distance) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Vector2d rhs = Vector2d::Zero();
  int used = 0;
  for (int i = 0; i < count; ++i) {
    const Vector2d a(1.0, edges[i].t);
    if (std::abs(edges[i].offset - a.dot(prior)) > max_distance) continue;
    information += edges[i].weight * a * a.transpose();
    rhs += edges[i].weight * edges[i].offset * a;
    ++used;
  }
  if (used < kMinSamples) return std::nullopt;
  return Vector2d(information.inverse() * rhs);
}

// Moves the segment onto the line through the steepest increases across it. Returns false if there
// is no edge within kMaxOffset.
bool MoveOntoEdge(const cv::Mat& gray, int max_samples, LineSegment2* segment) {
  const Vector2d direction = segment->Direction();
  const Vector2d across(-direction.y(), direction.x());
  const double length = segment->Length();
  const int samples = std::max(CellIndex(length / kSpacing, max_samples + 1), kMinSamples);
  std::array<Edge, kMaxSamples> edges;
  int count = 0;
  for (int i = 0; i < samples; ++i) {
    const double s = (i + 0.5) / samples;
    const std::optional<Edge> edge = SteepestRise(gray, segment->At(s), across);
    if (!edge) continue;
    edges[count] = *edge;
    edges[count].t = (s - 0.5) * length;
    ++count;
  }
  if (2 * count < samples) return false;
  std::optional<Vector2d> line = FitOffsets(edges, count, Vector2d::Zero(), kMaxOffset);
  if (line) line = FitOffsets(edges, count, *line, kInlierDistance);
  if (!line) return false;
  const double at_start = (*line)[0] - 0.5 * length * (*line)[1];
  const double at_end = (*line)[0] + 0.5 * length * (*line)[1];
  if (std::max(std::abs(at_start), std::abs(at_end)) > kMaxOffset) return false;
  segment->start += at_start * across;
  segment->end += at_end * across;
  return true;
}

}  // namespace

bool RefineSegment(const cv::Mat& gray, LineSegment2* segment) {
  // If the blur of the edge is wider than three differences, their centroid is biased towards the
  // middle one. The second pass starts with the edge in the middle.
  if (!MoveOntoEdge(gray, kMaxCoarseSamples, segment)) return false;
  MoveOntoEdge(gray, kMaxSamples, segment);
  return true;
}

}  // namespace msc_vo
