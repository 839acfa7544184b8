// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>

#include "msc_vo/diagnosis/quantile.h"

namespace msc_vo {

namespace {

// Depth is sampled in cells, so many per row of the image.
constexpr int kCellsPerRow = 160;
// Widths of the patches, cells: small ones where surfaces are small, large ones where depth is
// noisy. Neighbours overlap by half.
constexpr int kPatchSizes[] = {12, 24, 40};
// Least ratio of the cells of a patch that have a depth.
constexpr double kMinFill = 0.8;
// Standard deviation of rounding to whole raw units.
constexpr double kRounding = 0.3;
// Largest correlation of neighbouring residuals: beyond, the patch is not smooth anyway.
constexpr double kMaxCorrelation = 0.9;
// Largest radius on the plane z = 1 of a sample: 72 degrees.
constexpr double kMaxRadius = 3.0;

// A patch counts if the two curves differ by so many standard deviations of its measurement. It
// supports the curve that it is nearer to than this ratio of their difference.
constexpr double kMinSigmas = 4.0;
constexpr double kTolerance = 0.25;
// Fewest supporting patches in excess of those by chance, and ratio to the others: surfaces that
// are not plane support two curves about equally. Of sequences that are described right, at most
// 0.4 times as many patches support another curve as depth, see docs/lab/depth_curve.md.
constexpr int kMinVotes = 10;
constexpr int kMinRatio = 2;
// A curve with a parameter must gain so much over inverse depth, which has none.
constexpr double kMinGain = 1.2;

// Origins of inverted depth as multiples of the largest value, exponents of z = v^q, and scales of
// log z = v / a as multiples of the median value.
constexpr double kOrigins[] = {1.02, 1.05, 1.1, 1.18, 1.3, 1.5, 2.0, 3.0};
constexpr double kCompressed[] = {2.0, 3.0};
constexpr double kStretched[] = {0.5, 1.0 / 3.0};
constexpr double kLogScales[] = {0.2, 0.25, 0.3, 0.4};

using Coefficients = Eigen::Matrix<double, 6, 1>;

// Least squares for the quadratic polynomial c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2.
class QuadraticFit {
 public:
  static constexpr int kNumParameters = 6;

  void Add(double x, double y, double value) {
    Coefficients basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    matrix_.selfadjointView<Eigen::Lower>().rankUpdate(basis);
    rhs_ += value * basis;
    ++count_;
  }
  int count() const { return count_; }

  // Returns false if the polynomial is not determined.
  bool Solve() {
    if (count_ <= rhs_.size()) return false;
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> ldlt(
        Eigen::Matrix<double, 6, 6>(matrix_.selfadjointView<Eigen::Lower>()));
    coefficients_ = ldlt.solve(rhs_);
    covariance_ = ldlt.solve(Eigen::Matrix<double, 6, 6>::Identity());
    return coefficients_.allFinite() && covariance_.allFinite();
  }
  double At(double x, double y) const {
    Coefficients basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    return basis.dot(coefficients_);
  }
  // Sets the variance of the values, 1 by default.
  void SetVariance(double variance) { covariance_ *= variance; }

  double value() const { return coefficients_(0); }
  Eigen::Vector2d gradient() const { return coefficients_.segment<2>(1); }
  // The combination w0 f_xx + w1 f_xy + w2 f_yy of second derivatives and its standard deviation.
  double SecondDerivative(const Eigen::Vector3d& w, double* sigma) const {
    const Eigen::Vector3d by_coefficient(2.0 * w(0), w(1), 2.0 * w(2));
    *sigma = std::sqrt(by_coefficient.dot(covariance_.bottomRightCorner<3, 3>() * by_coefficient));
    return by_coefficient.dot(coefficients_.tail<3>());
  }

 private:
  Eigen::Matrix<double, 6, 6> matrix_ = Eigen::Matrix<double, 6, 6>::Zero();
  Coefficients rhs_ = Coefficients::Zero();
  int count_ = 0;
  Coefficients coefficients_;
  Eigen::Matrix<double, 6, 6> covariance_;
};

// The variance of independent values that determine a polynomial as well as those of a patch,
// whose residuals (NaN: no value) have it in common with their neighbours: a matcher of stereo
// images smooths its noise, rounded disparities form steps, edges bend all values beside them.
double VarianceOf(const cv::Mat_<double>& residuals, int num_parameters) {
  double squares = 0.0, by_x = 0.0, by_y = 0.0;
  int count = 0, count_x = 0, count_y = 0;
  for (int y = 0; y < residuals.rows; ++y) {
    for (int x = 0; x < residuals.cols; ++x) {
      const double r = residuals(y, x);
      if (std::isnan(r)) continue;
      squares += r * r;
      ++count;
      if (x > 0 && !std::isnan(residuals(y, x - 1))) {
        by_x += r * residuals(y, x - 1);
        ++count_x;
      }
      if (y > 0 && !std::isnan(residuals(y - 1, x))) {
        by_y += r * residuals(y - 1, x);
        ++count_y;
      }
    }
  }
  const double variance = squares / count;
  double factor = static_cast<double>(count) / (count - num_parameters);
  // Sum of a geometric autocorrelation along both axes.
  for (const double covariance : {by_x / std::max(1, count_x), by_y / std::max(1, count_y)}) {
    const double correlation = std::clamp(covariance / variance, 0.0, kMaxCorrelation);
    factor *= (1.0 + correlation) / (1.0 - correlation);
  }
  return factor * variance;
}

// Laplacian of w = (affine function) / rho over w, where rho = sqrt(1 + |x|^2).
double BowlOfRay(const Eigen::Vector2d& x, const Eigen::Vector2d& relative_gradient) {
  const double squared_radius = x.squaredNorm();
  const double rho = std::sqrt(1.0 + squared_radius);
  const double laplacian = (2.0 + squared_radius) / (rho * rho * rho);
  return -(2.0 * relative_gradient.dot(x) / rho + laplacian) / rho;
}

// `reference` was subtracted from the values; the coordinates of the fit are those of the plane
// z = 1, relative to `center` and in units of `unit`. Returns std::nullopt without a slope.
std::optional<SurfacePatch> MakePatch(const QuadraticFit& fit, double reference, double unit,
                                      const Eigen::Vector2d& center) {
  SurfacePatch patch;
  patch.value = fit.value() + reference;
  const double slope = fit.gradient().norm();
  if (!(patch.value > 0.0) || !(slope > 0.0)) return std::nullopt;
  const Eigen::Vector2d n = fit.gradient() / slope;
  double sigma = 0.0;
  const double second =
      fit.SecondDerivative({n.x() * n.x(), 2.0 * n.x() * n.y(), n.y() * n.y()}, &sigma);
  patch.bend = -second / (slope * slope);
  patch.bend_sigma = sigma / (slope * slope);
  const double laplacian = fit.SecondDerivative({1.0, 0.0, 1.0}, &sigma);
  const double scale = 1.0 / (patch.value * unit * unit);
  const Eigen::Vector2d relative = fit.gradient() / (patch.value * unit);
  patch.bowl = -laplacian * scale + 2.0 * relative.squaredNorm();
  patch.bowl_sigma = sigma * scale;
  patch.bowl_of_ray = BowlOfRay(center, -relative);
  patch.is_outward = fit.gradient().dot(center) > 0.0;
  return patch;
}

// Counts the patches that support a measured quantity's value under a curve, and under depth.
void Count(double measured, double sigma, double of_curve, double of_depth, bool is_outward,
           DepthCurveTest::Votes* votes) {
  const double difference = std::abs(of_curve - of_depth);
  if (!(difference > kMinSigmas * sigma)) return;
  if (std::abs(measured - of_curve) < kTolerance * difference) {
    ++votes->num_curve;
    votes->num_outward_curve += is_outward;
  }
  if (std::abs(measured - of_depth) < kTolerance * difference) {
    ++votes->num_depth;
    votes->num_outward_depth += is_outward;
  }
}

template <typename Bend>
DepthCurveTest::Votes CountBends(const std::vector<SurfacePatch>& patches, DepthCurve curve,
                                 const Bend& bend) {
  DepthCurveTest::Votes votes;
  votes.curve = curve;
  for (const SurfacePatch& patch : patches) {
    Count(patch.bend, patch.bend_sigma, bend(patch.value), -2.0 / patch.value, patch.is_outward,
          &votes);
  }
  return votes;
}

DepthCurveTest::Votes CountBowls(const std::vector<SurfacePatch>& patches) {
  DepthCurveTest::Votes votes;
  votes.curve = DepthCurve::kRayLength;
  for (const SurfacePatch& patch : patches) {
    Count(patch.bowl, patch.bowl_sigma, patch.bowl_of_ray, 0.0, patch.is_outward, &votes);
  }
  return votes;
}

double Score(const DepthCurveTest::Votes& votes) {
  return (votes.num_curve - votes.num_depth) / std::sqrt(votes.num_curve + votes.num_depth + 1.0);
}

}  // namespace

bool DepthCurveTest::Votes::ProveCurve() const {
  return num_curve >= kMinRatio * num_depth + kMinVotes;
}

bool DepthCurveTest::Votes::MayBeLens() const {
  const auto proves = [](int num_for, int num_against) {
    return num_for >= kMinRatio * num_against + kMinVotes / 2;
  };
  return !proves(num_outward_curve, num_outward_depth) ||
         !proves(num_curve - num_outward_curve, num_depth - num_outward_depth);
}

bool DepthCurveTest::Votes::ProveDepth() const {
  return num_depth >= kMinRatio * num_curve + kMinVotes;
}

DepthCurveTest::DepthCurveTest(const PinholeCamera& camera, const LensDistortion& distortion,
                               double depth_scale)
    : depth_scale_(depth_scale) {
  const PinholeCamera& recorded = distortion.Recorded(camera);
  step_ = std::max(1, recorded.width / kCellsPerRow);
  cell_size_ = step_ / recorded.FocalLength();
  rays_.create((recorded.height + step_ - 1) / step_, (recorded.width + step_ - 1) / step_);
  constexpr double kRayTolerance = 1e-6;
  for (int y = 0; y < rays_.rows; ++y) {
    for (int x = 0; x < rays_.cols; ++x) {
      const Eigen::Vector2d distorted = recorded.Ray({x * step_, y * step_}).head<2>();
      const Eigen::Vector2d ray = distortion.UndistortNormalized(distorted, kRayTolerance);
      rays_(y, x) = {ray.x(), ray.y()};
    }
  }
}

void DepthCurveTest::Add(const cv::Mat& recorded) {
  // Some drivers write their largest value for everything beyond.
  cv::Mat depth = recorded.clone();
  cv::patchNaNs(depth, 0.0);
  double largest = 0.0;
  cv::minMaxLoc(depth, nullptr, &largest);
  depth.setTo(0.0f, depth >= largest);
  for (const int size : kPatchSizes) {
    for (int y = 0; y + size <= rays_.rows; y += size / 2) {
      for (int x = 0; x + size <= rays_.cols; x += size / 2) {
        AddPatch(depth, {x, y, size, size});
      }
    }
  }
}

void DepthCurveTest::AddPatch(const cv::Mat& depth, const cv::Rect& cells) {
  const cv::Vec2d middle = rays_(cells.y + cells.height / 2, cells.x + cells.width / 2);
  const double unit = 0.5 * cells.width * cell_size_;  // of the coordinates of the fit
  // Relative to a value of the patch, which keeps the digits.
  const float reference =
      depth.at<float>(step_ * (cells.y + cells.height / 2), step_ * (cells.x + cells.width / 2));
  // Calls visit(cell, x, y, value) of all cells with a depth.
  const auto for_each = [&](const auto& visit) {
    for (int y = 0; y < cells.height; ++y) {
      const auto* row = depth.ptr<float>((cells.y + y) * step_);
      for (int x = 0; x < cells.width; ++x) {
        const float value = row[(cells.x + x) * step_];
        const cv::Vec2d& ray = rays_(cells.y + y, cells.x + x);
        if (!(value > 0.0f) || !(std::hypot(ray[0], ray[1]) < kMaxRadius)) continue;
        visit(cv::Point(x, y), (ray[0] - middle[0]) / unit, (ray[1] - middle[1]) / unit,
              static_cast<double>(value) - reference);
      }
    }
  };
  QuadraticFit fit;
  for_each([&](const cv::Point&, double x, double y, double value) { fit.Add(x, y, value); });
  if (fit.count() < kMinFill * cells.area() || !fit.Solve()) return;
  cv::Mat_<double> residuals(cells.size(), std::numeric_limits<double>::quiet_NaN());
  for_each([&](const cv::Point& cell, double x, double y, double value) {
    residuals(cell) = fit.At(x, y) - value;
  });
  const double rounding = kRounding / depth_scale_;
  fit.SetVariance(
      std::max(rounding * rounding, VarianceOf(residuals, QuadraticFit::kNumParameters)));
  const std::optional<SurfacePatch> patch =
      MakePatch(fit, reference, unit, Eigen::Vector2d(middle[0], middle[1]));
  if (patch) patches_.push_back(*patch);
}

DepthCurveTest::Votes DepthCurveTest::OfInverse() const {
  return CountBends(patches_, DepthCurve::kInverse, [](double) { return 0.0; });
}

std::vector<DepthCurveTest::Votes> DepthCurveTest::AllVotes() const {
  std::vector<double> values;
  for (const SurfacePatch& patch : patches_) values.push_back(patch.value);
  if (values.empty()) return {};
  const double largest = *std::max_element(values.begin(), values.end());
  const double median = Median(std::move(values));
  std::vector<Votes> all = {OfInverse()};
  for (const double factor : kOrigins) {
    const double origin = factor * largest;
    all.push_back(CountBends(patches_, DepthCurve::kInverted,
                             [origin](double v) { return 2.0 / (origin - v); }));
    all.back().origin = origin;
  }
  for (const double q : kCompressed) {
    all.push_back(
        CountBends(patches_, DepthCurve::kCompressed, [q](double v) { return -(q + 1.0) / v; }));
  }
  for (const double q : kStretched) {
    all.push_back(
        CountBends(patches_, DepthCurve::kStretched, [q](double v) { return -(q + 1.0) / v; }));
  }
  for (const double a : kLogScales) {
    const double bend = -1.0 / (a * median);
    all.push_back(CountBends(patches_, DepthCurve::kCompressed, [bend](double) { return bend; }));
  }
  all.push_back(CountBowls(patches_));
  return all;
}

DepthCurveTest::Votes DepthCurveTest::Best() const {
  Votes best;
  for (const Votes& votes : AllVotes()) {
    const double gain = best.curve == DepthCurve::kInverse && Score(best) > 0.0 ? kMinGain : 1.0;
    const bool is_first = best.curve == DepthCurve::kDepth;
    if (is_first || Score(votes) > gain * Score(best)) best = votes;
  }
  return best;
}

bool DepthCurveTest::IsDecided() const {
  const std::vector<Votes> all = AllVotes();
  const auto proves_depth = [](const Votes& votes) { return votes.ProveDepth(); };
  return Best().ProveCurve() || (!all.empty() && std::all_of(all.begin(), all.end(), proves_depth));
}

}  // namespace msc_vo
