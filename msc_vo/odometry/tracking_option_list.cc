// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListPointMatcher(PointMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_distance", &matcher->max_distance, {0, 256, "bits"},
            "Largest descriptor distance of a match, in tracking and in fusion.");
  list->Add("max_ratio", &matcher->max_ratio, {0.001, 1},
            "Largest ratio of the best to the second best descriptor distance.");
  list->Add("max_level_difference", &matcher->max_level_difference, {0, 32, "levels"},
            "Largest difference from the predicted pyramid level.");
}

void ListLineMatcher(LineMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_angle", &matcher->max_angle, {0.01, 90, "degrees"},
            "Largest difference of direction in the image, in tracking and in fusion.");
  list->Add("min_overlap", &matcher->min_overlap, {0.001, 1},
            "Smallest overlap, as a fraction of the shorter segment.");
  list->Add("max_distance", &matcher->max_distance, {0, 256, "bits"},
            "Largest descriptor distance of a match.");
  list->Add("bits_per_pixel", &matcher->bits_per_pixel, {0, 1000, "bits/pixel"},
            "Weight of the distance in the image relative to the descriptor distance.");
}

void ListConsensus(CellConsensusOptions* consensus, OptionLister* list) {
  list->Add(
      "enabled", &consensus->enabled,
      "Reject dynamic objects by cell consensus, and leave features in free space out of the map.");
  list->Add("columns", &consensus->columns, {1, 64, "cells"}, "Columns of the image grid.");
  list->Add("rows", &consensus->rows, {1, 64, "cells"}, "Rows of the image grid.");
  list->Add("reject_chi2_6", &consensus->reject_chi2_6, {0.001, 10000},
            "Chi-square with 6 degrees of freedom, of the inflated sigmas, above which a cell "
            "contradicts a pose.");
  list->Add("unconfirmed_weight", &consensus->unconfirmed_weight, {1e-6, 1},
            "Weight of a cell without landmarks that are confirmed static.");
  list->Add("min_cells", &consensus->min_cells, {0, 4096, "cells"},
            "Number of cells by which another pose must be better to replace the estimate.");
}

void ListPose(PoseOptions* pose, OptionLister* list) {
  list->Add("num_rounds", &pose->num_rounds, {1, 100, "rounds"},
            "Rounds of optimisation and classification of all matches.");
  list->Add("num_robust_rounds", &pose->num_robust_rounds, {0, 100, "rounds"},
            "Number of these rounds, from the first one, with a robust loss.");
  list->Add("iterations_per_round", &pose->iterations_per_round, {1, 100, "iterations"},
            "Largest number of iterations of a round.");
  list->Add(
      "max_frame_noise", &pose->max_frame_noise, {1, 100},
      "Largest factor by which the sigmas of a frame are inflated for the chi-square tests, of "
      "single matches and of cells.");
  list->Section("consensus", &pose->consensus, ListConsensus);
}

void ListKeyframePolicy(KeyframePolicyOptions* policy, OptionLister* list) {
  list->Add("min_tracked_ratio", &policy->min_tracked_ratio, {0, 1},
            "A keyframe is inserted when the ratio of tracked features falls below this fraction "
            "of its best value since the last keyframe.")
      .MakeBasic("Increase for more keyframes, decrease to save time.");
  list->Add("max_interval", &policy->max_interval, {0, 10, "seconds"},
            "Longest time between keyframes.")
      .MakeBasic("Decrease for more keyframes while the camera is at rest.");
  list->Add("min_interval", &policy->min_interval, {0, 1, "seconds"},
            "Shortest time between keyframes.");
  list->Add("close_relative_sigma", &policy->close_relative_sigma, {1e-6, 10},
            "A point is close if the standard deviation of its depth is below this fraction of the "
            "depth.");
}

void ListRelocalizer(RelocalizerOptions* relocalizer, OptionLister* list) {
  list->Add("max_distance", &relocalizer->max_distance, {0, 256, "bits"},
            "Largest descriptor distance of a match.");
  list->Add("max_ratio", &relocalizer->max_ratio, {0.001, 1},
            "Largest ratio of the best to the second best descriptor distance.");
  list->Add("max_iterations", &relocalizer->max_iterations, {1, 10000, "iterations"},
            "Triples of points that a search tries, and half as many of a line and a point.");
  list->Add("min_inliers", &relocalizer->min_inliers, {3, 10000, "matches"},
            "Smallest number of inliers of a pose; a line counts as two points.");
  list->Add("max_angle", &relocalizer->max_angle, {0.01, 45, "degrees"},
            "Largest reprojection error of an inlier, as an angle.");
}

void ListSegments(SegmentOptions* segments, OptionLister* list) {
  list->Add("enabled", &segments->enabled,
            "Begin a new segment, with a map of its own, when the map cannot be found again.");
  list->Add("min_search", &segments->min_search, {0, 3600, "seconds"},
            "Shortest time for which the map is searched before a new segment begins.");
  list->Add(
      "max_search", &segments->max_search, {0, 3600, "seconds"},
      "Longest time for which the map is searched, even if not all of its keyframes have been "
      "tried.");
  list->Add(
      "search_keyframes", &segments->search_keyframes, {1, 100, "keyframes"},
      "Keyframes of older segments that are tried per 1/30 s, to join the maps; at least one per "
      "tracked frame.");
  list->Add("search_interval", &segments->search_interval, {0, 3600, "seconds"},
            "Shortest time between two frames that are found in the map of an older segment.");
}

void ListStatus(TrackerOptions* tracking, OptionLister* list) {
  list->Add("min_matches", &tracking->min_matches, {3, 10000, "matches"},
            "Smallest number of inliers of a pose, points and lines together; lines count twice in "
            "images with fewer points than this.")
      .MakeBasic("Decrease for scenes with little texture, at the risk of wrong poses.");
  list->Add("max_prediction", &tracking->max_prediction, {0, 60, "seconds"},
            "Longest gap that is bridged by constant velocity before a frame is lost.")
      .MakeBasic("Decrease for irregular motion.");
  list->Add("weak_translation_sigma", &tracking->weak_translation_sigma, {1e-6, 1000, "metres"},
            "Standard deviation of the position above which a pose has the status weak.")
      .MakeBasic("Set it to the accuracy that the application needs.");
  list->Add("weak_rotation_sigma", &tracking->weak_rotation_sigma, {1e-6, 1000, "degrees"},
            "Standard deviation of the orientation above which a pose has the status weak.")
      .MakeBasic("Set it to the accuracy that the application needs.");
  list->Add("min_inlier_ratio", &tracking->min_inlier_ratio, {0, 1},
            "Smallest ratio of inliers of a pose, to the matches that are confirmed static or, if "
            "these are few, to all.");
}

}  // namespace

void ListTracking(TrackerOptions* tracking, OptionLister* list) {
  list->Add("prediction_radius", &tracking->prediction_radius, {0.1, 1000, "pixels"},
            "Search radius around the predicted projection of a landmark.")
      .MakeBasic("Increase for fast motion, low frame rates or large images.");
  ListStatus(tracking, list);
  list->Add("wide_radius", &tracking->wide_radius, {0.1, 1000, "pixels"},
            "Search radius after a search within prediction_radius has failed.");
  list->Add("local_map_radius", &tracking->local_map_radius, {0.1, 1000, "pixels"},
            "Search radius around the projection with an estimated pose.");
  list->Add("max_local_keyframes", &tracking->max_local_keyframes, {1, 1000, "keyframes"},
            "Largest number of keyframes of the local map.");
  list->Add("relocalization_keyframes", &tracking->relocalization_keyframes, {1, 100, "keyframes"},
            "Keyframes that relocalisation tries per 1/30 s; at least one per frame.");
  list->Add(
      "min_initial_features", &tracking->min_initial_features, {3, 10000, "features"},
      "Smallest number of features with depth of the first frame; five lines in two directions "
      "suffice as well.");
  list->Section("point_matcher", &tracking->point_matcher, ListPointMatcher);
  list->Section("line_matcher", &tracking->line_matcher, ListLineMatcher);
  list->Section("pose", &tracking->pose, ListPose);
  list->Section("keyframes", &tracking->keyframes, ListKeyframePolicy);
  list->Section("relocalizer", &tracking->relocalizer, ListRelocalizer);
  list->Section("segments", &tracking->segments, ListSegments);
}

}  // namespace msc_vo
