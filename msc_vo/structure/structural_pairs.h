// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/structure/deviation_estimator.h"

namespace msc_vo {

struct StructuralPairOptions {
  bool parallel = true;
  bool perpendicular = true;
  /// Range around 0 and 90 degrees in which pairs are sought, degrees: wide enough to show how many
  /// pairs lie there by chance.
  double max_angle = 3.0;
};

/// Pairs of lines of a window whose angle is near to 0 or 90 degrees.
struct PairCandidates {
  template <typename Deviation>
  struct Pair {
    double sigma = 0.0;  ///< radians, of the angle between the two
    int i = 0, j = 0;    ///< indices of both lines in `lines`
    Deviation deviation;
    double probability = 0.0;  ///< of a relation
  };
  using Parallel = Pair<DirectionDeviation>;
  using Perpendicular = Pair<AngleDeviation>;

  std::vector<int64_t> lines;  ///< ids of the lines whose directions are certain enough
  std::vector<Parallel> parallel;
  std::vector<Perpendicular> perpendicular;
};

/// The parallel and perpendicular pairs of a window (paper: L_par^z, L_perp^z of the lines z):
/// lines that at least one keyframe of the window observes together and whose angle is near to 0 or
/// 90 degrees.
///
/// Angles are those of the observations (EstimateDirections), not of lines that earlier pairs have
/// turned. The deviation of pairs is learnt from the angles of parallel ones, which are rare by
/// chance; pairs that are as likely by chance are left out (RelationProbabilities).
///
/// A line's own deviation is common to all its pairs. The variance of a pair is therefore
/// multiplied by (n_a + n_b + 2) / 4, with n the number of partners; among k lines that are all
/// partners of each other, this weighs the deviation of each line once. For the same reason a pair
/// counts once and not, as in the paper, once per keyframe that observes both lines. Pairs of two
/// lines that are aligned with Manhattan axes are omitted: the alignment holds the same constraint.
class StructuralPairs {
 public:
  /// The options must be valid (OdometryOptions::IsValid).
  explicit StructuralPairs(const StructuralPairOptions& options);

  /// The candidates of a window whose lines have been aligned with axes: the most certain pairs of
  /// each line among those that a keyframe of the window observes together, without pairs of two
  /// lines that are aligned with axes. None if pairs are disabled.
  PairCandidates Find(const WindowData& window) const;
  /// Updates the deviation of pairs with the parallel candidates of a window.
  void Learn(const PairCandidates& candidates);
  /// Adds those candidates to their window that are no pairs by chance.
  void Add(PairCandidates candidates, WindowData* window) const;

  const DeviationEstimator& deviation() const { return deviation_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, estimator] = *this;  // all members, or it does not compile
    archive(estimator);
  }

 private:
  StructuralPairOptions options_;
  DeviationEstimator deviation_;
};

}  // namespace msc_vo
