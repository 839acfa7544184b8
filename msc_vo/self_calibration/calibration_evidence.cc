// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

using Vector = SensorCorrection::Vector;
using Matrix = SensorCorrection::Matrix;

// Prior odds of a group to be wrong.
constexpr double kPriorOdds = 0.1;

// Ratio of the standard deviations after and before a measurement from which on it does not tell a
// parameter.
constexpr double kUnobservable = 0.7;

// Fewest standard deviations of a correction.
constexpr double kMinSigmas = 3.0;

// Of parameters that are held, in their units.
constexpr double kHeldSigma = 1e-6;

constexpr unsigned kNumModels = 1U << kNumCorrectionGroups;

Vector MakeVector(double focal, double center, double k1, double k2, double depth_focal,
                  double depth_shift, double roll, double parallax) {
  Vector sigma;
  // Errors of depth sensors, which every model contains. Structured-light cameras have up to
  // 0.012 1/m and 0.05, see docs/lab/self_calibration.md.
  constexpr double kOffset = 0.003;
  constexpr double kBowl = 0.05;
  sigma << focal, center, center, k1, k2, depth_focal, depth_shift, depth_shift, roll, parallax,
      parallax, kOffset, kBowl;
  return sigma;
}

// Errors of a calibration that counts as right. They also cover what the model of the sensor leaves
// out.
Vector GoodCalibrationSigma() {
  return MakeVector(0.005, 0.004, 0.01, 0.01, 0.005, 0.004, DegreesToRadians(0.2), 0.005);
}

struct Model {
  Vector mean = Vector::Zero();
  Vector sigma = Vector::Zero();
};

unsigned MaskOf(const CorrectionGroups& wrong) {
  unsigned mask = 0;
  for (int g = 0; g < kNumCorrectionGroups; ++g) mask |= (wrong[g] ? 1U : 0U) << g;
  return mask;
}

CorrectionGroups GroupsOf(unsigned mask) {
  CorrectionGroups groups;
  for (int g = 0; g < kNumCorrectionGroups; ++g) groups[g] = (mask >> g & 1U) != 0;
  return groups;
}

Vector PriorSigma(unsigned wrong_groups) {
  Vector sigma = GoodCalibrationSigma();
  const Vector wrong = WrongCalibrationSigma();
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    if ((wrong_groups >> g & 1U) == 0) continue;
    for (const int i : IndicesOf(static_cast<CorrectionGroup>(g))) sigma(i) = wrong(i);
  }
  return sigma;
}

// The same where the colour camera keeps its given values for what is not wrong.
Vector HoldingPriorSigma(unsigned wrong_groups) {
  Vector sigma = PriorSigma(wrong_groups);
  for (const CorrectionGroup group : kColorGroups) {
    if ((wrong_groups >> static_cast<unsigned>(group) & 1U) != 0) continue;
    for (const int i : IndicesOf(group)) sigma(i) = kHeldSigma;
  }
  return sigma;
}

// The normal equations of a model in units of its prior: I + S H S.
struct ScaledEquations {
  ScaledEquations(const CalibrationInformation& information, const Vector& prior_sigma)
      : prior(prior_sigma),
        rhs(prior.cwiseProduct(information.vector)),
        ldlt(Matrix::Identity() + prior.asDiagonal() * information.matrix * prior.asDiagonal()),
        solution(ldlt.solve(rhs)) {}

  Vector Mean() const { return prior.cwiseProduct(solution); }

  Vector prior;
  Vector rhs;
  Eigen::LDLT<Matrix> ldlt;
  Vector solution;
};

Model Solve(const CalibrationInformation& information, const Vector& prior_sigma) {
  const ScaledEquations scaled(information, prior_sigma);
  const Matrix inverse = scaled.ldlt.solve(Matrix::Identity());
  return {scaled.Mean(), scaled.prior.cwiseProduct(inverse.diagonal().cwiseMax(0.0).cwiseSqrt())};
}

double LogEvidence(const CalibrationInformation& information, unsigned wrong_groups) {
  const ScaledEquations scaled(information, PriorSigma(wrong_groups));
  double log_determinant = 0.0;
  for (int i = 0; i < Vector::RowsAtCompileTime; ++i) {
    log_determinant += std::log(std::max(scaled.ldlt.vectorD()(i), 1e-12));
  }
  double log_evidence = 0.5 * scaled.rhs.dot(scaled.solution) - 0.5 * log_determinant;
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    if ((wrong_groups >> g & 1U) != 0) log_evidence += std::log(kPriorOdds);
  }
  return log_evidence;
}

// By model.
std::array<double, kNumModels> LogEvidences(const CalibrationInformation& information) {
  std::array<double, kNumModels> evidence;
  for (unsigned m = 0; m < kNumModels; ++m) evidence[m] = LogEvidence(information, m);
  return evidence;
}

std::array<double, kNumCorrectionGroups> LogOddsOf(const std::array<double, kNumModels>& evidence) {
  std::array<double, kNumCorrectionGroups> log_odds;
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    double with = -std::numeric_limits<double>::infinity();
    double without = with;
    for (unsigned m = 0; m < kNumModels; ++m) {
      double& side = (m >> g & 1U) != 0 ? with : without;
      side = std::max(side, evidence[m]);
    }
    log_odds[g] = with - without;
  }
  return log_odds;
}

// Whether the corrections of a model are significant, those of `known` groups aside.
bool HasSignificantCorrections(const CalibrationInformation& information, unsigned wrong_groups,
                               unsigned known) {
  const CorrectionEstimate estimate = EstimateCorrections(information, GroupsOf(wrong_groups));
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    const bool is_new = ((wrong_groups & ~known) >> g & 1U) != 0;
    if (is_new && !IsSignificant(static_cast<CorrectionGroup>(g), estimate)) return false;
  }
  return true;
}

}  // namespace

const std::vector<int>& IndicesOf(CorrectionGroup group) {
  using S = SensorCorrection;
  static const std::array<std::vector<int>, kNumCorrectionGroups> indices_of_groups = {{
      {S::kFocalLength},
      {S::kCenterX, S::kCenterY},
      {S::kK1, S::kK2},
      {S::kDepthFocalLength, S::kDepthX, S::kDepthY, S::kDepthRoll, S::kDepthParallaxX,
       S::kDepthParallaxY},
  }};
  return indices_of_groups[static_cast<size_t>(group)];
}

bool CorrectionEstimate::IsCorrected() const {
  return std::any_of(is_corrected.begin(), is_corrected.end(), [](bool wrong) { return wrong; });
}

SensorCorrection::Vector WrongCalibrationSigma() {
  return MakeVector(0.03, 0.02, 0.1, 0.03, 0.06, 0.02, DegreesToRadians(1.0), 0.03);
}

bool IsObservable(int index, double sigma) {
  return sigma < kUnobservable * WrongCalibrationSigma()(index);
}

bool IsSignificant(CorrectionGroup group, const CorrectionEstimate& estimate) {
  const std::vector<int>& indices = IndicesOf(group);
  return std::any_of(indices.begin(), indices.end(), [&](int i) {
    // A small correction of k1 with a large one of k2 stands for errors that are not in the model.
    return i != SensorCorrection::kK2 &&
           std::abs(estimate.correction(i)) > kMinSigmas * estimate.sigma(i);
  });
}

CorrectionEstimate EstimateCorrections(const CalibrationInformation& information,
                                       const CorrectionGroups& wrong) {
  constexpr unsigned kAllGroups = kNumModels - 1;
  const unsigned mask = MaskOf(wrong);
  const Model unrestricted = Solve(information, PriorSigma(kAllGroups));
  Model model = unrestricted;
  if (mask != kAllGroups) {
    // What goes best with the given values that are kept, which may nevertheless be somewhat wrong.
    model.mean = ScaledEquations(information, HoldingPriorSigma(mask)).Mean();
    model.sigma = Solve(information, PriorSigma(mask)).sigma;
  }
  CorrectionEstimate estimate;
  estimate.sigma = unrestricted.sigma;
  estimate.sigma.segment<2>(SensorCorrection::kDepthOffset) =
      model.sigma.segment<2>(SensorCorrection::kDepthOffset);
  estimate.is_corrected = wrong;
  estimate.depth_errors = model.mean.segment<2>(SensorCorrection::kDepthOffset);
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    if (!wrong[g]) continue;
    for (const int i : IndicesOf(static_cast<CorrectionGroup>(g))) {
      estimate.correction(i) = model.mean(i);
      estimate.sigma(i) = model.sigma(i);
    }
  }
  return estimate;
}

CorrectionEstimate SelectCorrections(const CalibrationInformation& information,
                                     const CorrectionGroups& known_wrong,
                                     const CorrectionGroups& known_right) {
  const std::array<double, kNumModels> evidence = LogEvidences(information);
  const unsigned known = MaskOf(known_wrong);
  unsigned best = known;
  for (unsigned m = 0; m < kNumModels; ++m) {
    if ((m & known) != known || (m & MaskOf(known_right)) != 0) continue;
    if (evidence[m] > evidence[best] && HasSignificantCorrections(information, m, known)) best = m;
  }
  if (evidence[best] - evidence[known] < std::log(kAcceptedOdds)) best = known;

  CorrectionEstimate estimate = EstimateCorrections(information, GroupsOf(best));
  estimate.log_odds = LogOddsOf(evidence);
  return estimate;
}

SensorCorrection::Vector WithRegistrationErrors(SensorCorrection::Vector sigma) {
  for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
    sigma(i) =
        std::min(std::hypot(sigma(i), GoodCalibrationSigma()(i)), WrongCalibrationSigma()(i));
  }
  return sigma;
}

std::array<double, kNumCorrectionGroups> GroupLogOdds(const CalibrationInformation& information) {
  return LogOddsOf(LogEvidences(information));
}

}  // namespace msc_vo
