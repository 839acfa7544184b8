// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/structure/deviation_estimator.h"

namespace msc_vo {

struct StructuralPairOptions {
  bool parallel = true;
  bool perpendicular = true;
  /// Range around 0 and 90 degrees in which pairs are sought, degrees: wide enough to show how many
  /// pairs lie there by chance.
  double max_angle = 3.0;
  /// Largest standard deviation of a line's direction, degrees: a third of the range.
  double max_sigma = 1.0;
  /// Smallest probability of a pair not to be one by chance.
  double min_probability = 0.8;
  int max_partners = 4;  ///< pairs of each kind per line, most certain first
  /// Deviation of the angle between two lines from 0 or 90 degrees.
  DeviationOptions deviation;

  bool IsValid(std::string* error) const;
};

/// The parallel and perpendicular pairs of a window (paper: L_par^z, L_perp^z of the lines z):
/// lines that at least one keyframe of the window observes together and whose angle is near to 0 or
/// 90 degrees.
///
/// - Angles are those of the observations (EstimateDirections), not of lines that earlier pairs
/// have
///   turned.
/// - The deviation of pairs is learnt from the angles of parallel ones, which are rare by chance.
/// - Pairs that are as likely by chance are left out: RelationProbabilities().
/// - A line's own deviation is common to all its pairs. The variance of a pair is therefore
///   multiplied by (n_a + n_b + 2) / 4, with n the number of partners; among k lines that are all
///   partners of each other, this weighs the deviation of each line once. For the same reason a
///   pair counts once and not, as in the paper, once per keyframe that observes both lines.
/// - Pairs of two lines that are aligned with Manhattan axes are omitted, because the alignment
/// holds
///   the same constraint.
class StructuralPairs {
 public:
  /// Throws std::invalid_argument on options that are not valid.
  explicit StructuralPairs(const StructuralPairOptions& options);

  /// Learns from the window, and adds its pairs to it. Call after its lines have been aligned.
  void Add(WindowData* window);

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
