// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListConsensus(CellConsensusOptions* consensus, OptionLister* list) {
  list->Add("enabled", &consensus->enabled, "leave out what moves by itself");
  list->Add("columns", &consensus->columns, {1, 64}, "of parts of the image that vote on a pose");
  list->Add("rows", &consensus->rows, {1, 64}, "of parts of the image that vote on a pose");
  list->Add("reject_chi2_6", &consensus->reject_chi2_6, {0.001, 10000},
            "chi-square of the common errors of a part, beyond which it votes against a pose");
  list->Add("unconfirmed_weight", &consensus->unconfirmed_weight, {1e-6, 1},
            "of a vote of what no two keyframes have seen");
  list->Add("min_cells", &consensus->min_cells, {0, 4096}, "by which another pose must be better");
}

void ListPose(PoseOptions* pose, OptionLister* list) {
  ListTerms(pose, list);
  list->Add("num_rounds", &pose->num_rounds, {1, 100}, "of solving and classifying all matches");
  list->Add("num_robust_rounds", &pose->num_robust_rounds, {0, 100},
            "the first ones, with the loss");
  list->Add("iterations_per_round", &pose->iterations_per_round, {1, 100}, "at most");
  list->Add(
      "max_frame_noise", &pose->max_frame_noise, {1, 100},
      "how far chi-square limits grow, in sigmas, where all points of a frame are seen worse");
  list->Section("consensus", &pose->consensus, ListConsensus);
}

void ListKeyframePolicy(KeyframePolicyOptions* policy, OptionLister* list) {
  list->Add("min_tracked_ratio", &policy->min_tracked_ratio, {0, 1},
            "of tracked features, relative to what it was after the last keyframe");
  list->Add("min_interval", &policy->min_interval, {1, 10000}, "frames between keyframes");
  list->Add("max_interval", &policy->max_interval, {1, 10000}, "frames between keyframes");
  list->Add("close_relative_sigma", &policy->close_relative_sigma, {1e-6, 10},
            "of the depth, below which a point is close");
}

void ListRelocalizer(RelocalizerOptions* relocalizer, OptionLister* list) {
  list->Add("max_distance", &relocalizer->max_distance, {0, 256}, "bits between descriptors");
  list->Add("max_ratio", &relocalizer->max_ratio, {0.001, 1},
            "best over second best descriptor distance");
  list->Add("max_iterations", &relocalizer->max_iterations, {1, 10000}, "triples of matches tried");
  list->Add("min_inliers", &relocalizer->min_inliers, {3, 10000}, "matches that must agree");
  list->Add("inlier_sigmas", &relocalizer->inlier_sigmas, {0.01, 100},
            "reprojection of a match that agrees");
}

}  // namespace

void ListPointMatcher(PointMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_distance", &matcher->max_distance, {0, 256}, "bits between descriptors");
  list->Add("max_ratio", &matcher->max_ratio, {0.001, 1},
            "best over second best descriptor distance");
  list->Add("max_level_difference", &matcher->max_level_difference, {0, 32},
            "pyramid levels from the predicted one");
}

void ListLineMatcher(LineMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_angle", &matcher->max_angle, {0.01, 90},
            "degrees between directions in the image");
  list->Add("min_overlap", &matcher->min_overlap, {0.001, 1}, "part of the shorter segment");
  list->Add("max_distance", &matcher->max_distance, {0, 256}, "bits between descriptors");
  list->Add("bits_per_pixel", &matcher->bits_per_pixel, {0, 1000},
            "bits of descriptor distance that weigh as much as one pixel");
}

void ListTerm(TermOptions* term, OptionLister* list) {
  list->Add("enabled", &term->enabled, "whether the term takes part");
  list->Add("huber", &term->huber, {0.01, 1000},
            "sigmas; where the loss turns from square to linear");
}

void ListTracking(TrackerOptions* tracking, OptionLister* list) {
  list->Section("point_matcher", &tracking->point_matcher, ListPointMatcher);
  list->Section("line_matcher", &tracking->line_matcher, ListLineMatcher);
  list->Section("pose", &tracking->pose, ListPose);
  list->Section("keyframes", &tracking->keyframes, ListKeyframePolicy);
  list->Section("relocalizer", &tracking->relocalizer, ListRelocalizer);
  list->Add("prediction_radius", &tracking->prediction_radius, {0.1, 1000},
            "pixels, search around the predicted pose");
  list->Add("wide_radius", &tracking->wide_radius, {0.1, 1000},
            "pixels, when that found too little");
  list->Add("local_map_radius", &tracking->local_map_radius, {0.1, 1000},
            "pixels, around an estimated pose");
  list->Add("max_local_keyframes", &tracking->max_local_keyframes, {1, 1000}, "in the local map");
  list->Add("min_matches", &tracking->min_matches, {3, 10000},
            "points and lines that a pose stands on");
  list->Add("min_inlier_ratio", &tracking->min_inlier_ratio, {0, 1}, "of all matches of a pose");
  list->Add("weak_translation_sigma", &tracking->weak_translation_sigma, {1e-6, 1000},
            "metres; a pose known worse is weak");
  list->Add("weak_rotation_sigma", &tracking->weak_rotation_sigma, {1e-6, 1000},
            "degrees; a pose known worse is weak");
  list->Add("max_prediction", &tracking->max_prediction, {0, 60},
            "seconds that constant velocity may bridge");
  list->Add("relocalization_keyframes", &tracking->relocalization_keyframes, {1, 100},
            "tried per frame while the map is searched");
  list->Add("min_initial_features", &tracking->min_initial_features, {3, 10000},
            "with depth, in the first frame");
}

}  // namespace msc_vo
