// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <tuple>
#include <type_traits>
#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_validation.h"
#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_endpoint_prior.h"
#include "msc_vo/factors/manhattan_axis_alignment.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"
#include "msc_vo/factors/point_reprojection.h"
#include "msc_vo/factors/pose_prior.h"

namespace msc_vo {

/// Inliers among the measurements of a window.
struct WindowInlierMask {
  std::vector<InlierMask> points;   ///< One per point observation.
  std::vector<InlierMask> lines;    ///< One per line observation.
  std::vector<bool> parallel;       ///< One per parallel pair.
  std::vector<bool> perpendicular;  ///< One per perpendicular pair.
  std::vector<bool> alignments;     ///< One per axis alignment.
};

/// A term of a window: all residual blocks of one factor.
template <typename FactorType>
struct Term {
  using Factor = FactorType;
  const char* name;  ///< In reports.
  TermSummary BundleAdjustmentSummary::*summary;
  TermOptions BundleAdjustmentOptions::*options = nullptr;  ///< Null: no robust loss.
};

/// A term of relations between lines, each with a record of its own that may be an outlier.
template <typename FactorType, typename RecordType>
struct RelationTerm : Term<FactorType> {
  using Lines = std::array<int, FactorType::kBlockKinds.size()>;
  std::vector<RecordType> WindowData::*records;
  std::vector<Lines> WindowIndex::*lines;
  std::vector<bool> WindowInlierMask::*inliers;
  double BundleAdjustmentOptions::*limit;  ///< Chi-square limit of the outlier test.
};

/// The terms of a window, in the order in which their costs are added and reported. Everything that
/// is done for every term iterates this list.
inline constexpr std::tuple kTerms{
    Term<PointReprojection>{"point_reprojection", &BundleAdjustmentSummary::point_reprojection,
                            &BundleAdjustmentOptions::point_reprojection},
    Term<DepthReprojection>{"point_depth", &BundleAdjustmentSummary::point_depth,
                            &BundleAdjustmentOptions::point_depth},
    Term<LineReprojection>{"line_reprojection", &BundleAdjustmentSummary::line_reprojection,
                           &BundleAdjustmentOptions::line_reprojection},
    Term<LineDepthReprojection>{"line_depth", &BundleAdjustmentSummary::line_depth,
                                &BundleAdjustmentOptions::line_depth},
    Term<LineEndpointPrior>{"line_endpoint_prior", &BundleAdjustmentSummary::line_endpoint_prior},
    RelationTerm<ManhattanAxisAlignment, WindowData::AxisAlignment>{
        {"manhattan", &BundleAdjustmentSummary::manhattan, &BundleAdjustmentOptions::manhattan},
        &WindowData::axis_alignments,
        &WindowIndex::alignments,
        &WindowInlierMask::alignments,
        &BundleAdjustmentOptions::reject_chi2_2},
    RelationTerm<ParallelLines, WindowData::LinePair>{
        {"parallel", &BundleAdjustmentSummary::parallel, &BundleAdjustmentOptions::parallel},
        &WindowData::parallel_pairs,
        &WindowIndex::parallel,
        &WindowInlierMask::parallel,
        &BundleAdjustmentOptions::reject_chi2_2},
    RelationTerm<PerpendicularLines, WindowData::LinePair>{
        {"perpendicular", &BundleAdjustmentSummary::perpendicular,
         &BundleAdjustmentOptions::perpendicular},
        &WindowData::perpendicular_pairs,
        &WindowIndex::perpendicular,
        &WindowInlierMask::perpendicular,
        &BundleAdjustmentOptions::reject_chi2_1},
    Term<PosePrior>{"pose_prior", &BundleAdjustmentSummary::pose_prior},
    Term<CustomFactor>{"custom", &BundleAdjustmentSummary::custom}};

/// Calls visit(term) for every term of the list.
template <typename Visitor>
void ForEachTerm(const Visitor& visit) {
  std::apply([&visit](const auto&... term) { (visit(term), ...); }, kTerms);
}

template <typename Term>
constexpr bool kIsRelation = false;
template <typename Factor, typename Record>
constexpr bool kIsRelation<RelationTerm<Factor, Record>> = true;

/// Calls visit(term) for every RelationTerm of the list.
template <typename Visitor>
void ForEachRelation(const Visitor& visit) {
  ForEachTerm([&visit](const auto& term) {
    if constexpr (kIsRelation<std::decay_t<decltype(term)>>) visit(term);
  });
}

}  // namespace msc_vo
