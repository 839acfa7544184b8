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
}

void ListLineMatcher(LineMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_angle", &matcher->max_angle, {0.01, 90, "degrees"},
            "Largest difference of direction in the image, in tracking and in fusion.");
  list->Add("max_distance", &matcher->max_distance, {0, 256, "bits"},
            "Largest descriptor distance of a match.");
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
  list->Section("point_matcher", &tracking->matchers.point_matcher, ListPointMatcher);
  list->Section("line_matcher", &tracking->matchers.line_matcher, ListLineMatcher);
  list->Add(
      "pose.consensus.enabled", &tracking->pose.consensus.enabled,
      "Reject dynamic objects by cell consensus, and leave features in free space out of the map.");
  list->Section("keyframes", &tracking->keyframes, ListKeyframePolicy);
  list->Add("relocalizer.min_inliers", &tracking->relocalizer.min_inliers, {3, 10000, "matches"},
            "Smallest number of inliers of a pose; a line counts as two points.");
  list->Section("segments", &tracking->segments, ListSegments);
}

}  // namespace msc_vo
