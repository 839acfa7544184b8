// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListFrameStructure(FrameStructureOptions* structure, OptionLister* list) {
  list->Add("max_angle", &structure->max_angle, {0.01, 44, "degrees"},
            "Largest deviation of a pair's angle from 0 or 90 degrees in a frame.");
  list->Add("pair_sigma", &structure->pair_sigma, {0.001, 90, "degrees"},
            "Standard deviation of the true angle of lines that were built parallel or "
            "perpendicular.");
}

void ListSelection(WindowSelectionOptions* selection, OptionLister* list) {
  list->Add("max_keyframes", &selection->max_keyframes, {1, 100, "keyframes"},
            "Largest number of keyframes that local bundle adjustment optimises.");
  list->Add("max_fixed_keyframes", &selection->max_fixed_keyframes, {0, 1000, "keyframes"},
            "Largest number of keyframes that observe its landmarks and are held fixed.");
}

void ListTerm(TermOptions* term, OptionLister* list) {
  list->Add("enabled", &term->enabled, "Use the factor in local bundle adjustment.");
}

void ListHuber(TermOptions* term, OptionLister* list) {
  list->Add("huber", &term->huber, {0.01, 1000, "sigmas"}, "Huber threshold of the term.");
}

// The terms that pose optimisation has too use the same settings there.
void ListTerms(void (*list_term)(TermOptions*, OptionLister*), BundleAdjustmentOptions* window,
               OptionLister* list) {
  list->Section("point_reprojection", &window->point_reprojection, list_term);
  list->Section("point_depth", &window->point_depth, list_term);
  list->Section("line_reprojection", &window->line_reprojection, list_term);
  list->Section("line_depth", &window->line_depth, list_term);
  list->Section("parallel", &window->parallel, list_term);
  list->Section("perpendicular", &window->perpendicular, list_term);
  list->Section("manhattan", &window->manhattan, list_term);
}

// What only window files hold.
void ListThresholds(BundleAdjustmentOptions* window, OptionLister* list) {
  list->Add("line_endpoint_prior_sigma", &window->line_endpoint_prior_sigma, {1e-6, 100, "metres"},
            "Standard deviation of the end-point prior.");
  list->Add("reject_chi2_1", &window->reject_chi2_1, {0.001, 10000},
            "Smallest chi-square of an outlier with one row.");
  list->Add("reject_chi2_2", &window->reject_chi2_2, {0.001, 10000}, "The same with two rows.");
  list->Add("reject_chi2_3", &window->reject_chi2_3, {0.001, 10000}, "The same with three rows.");
  list->Add("reject_chi2_4", &window->reject_chi2_4, {0.001, 10000}, "The same with four rows.");
  ListTerms(ListHuber, window, list);
}

void ListWindow(BundleAdjustmentOptions* window, OptionLister* list) {
  list->AddChoice("solver", &window->solver, {"block-schur", "ceres", "ceres-suite-sparse"},
                  "Solver of local bundle adjustment.")
      .MakeBasic("Choose a Ceres solver for comparison; block-schur is the fastest.");
  list->Add("line_endpoint_prior", &window->line_endpoint_prior,
            "Prior on the end points of a line along its direction.");
  list->Add("first_iterations", &window->first_iterations, {1, 100, "iterations"},
            "Iterations of the first solve, with all observations.");
  list->Add("second_iterations", &window->second_iterations, {1, 100, "iterations"},
            "Iterations of the second solve, without outliers.");
  ListTerms(ListTerm, window, list);
  list->Add("landmark_noise.enabled", &window->landmark_noise.enabled,
            "Estimate a noise scale for each landmark.");
  list->Add("consensus.enabled", &window->consensus.enabled,
            "Test every observation against the other views of its landmark.");
}

void ListPairs(StructuralPairOptions* pairs, OptionLister* list) {
  list->Add("parallel", &pairs->parallel,
            "Constrain pairs of parallel lines of the map. Mode msc-vo only.")
      .MakeBasic("Disable for comparison.");
  list->Add("perpendicular", &pairs->perpendicular,
            "Constrain pairs of perpendicular lines of the map. Mode msc-vo only.")
      .MakeBasic("Disable for comparison.");
  list->Add("max_angle", &pairs->max_angle, {0.01, 44, "degrees"},
            "Range around 0 and 90 degrees in which pairs of lines of the map are sought.");
}

void ListCulling(CullingOptions* culling, OptionLister* list) {
  list->Add("probation_keyframes", &culling->probation_keyframes, {1, 1000, "keyframes"},
            "Keyframes during which a new landmark is on probation.");
  list->Add("min_found_ratio", &culling->min_found_ratio, {0, 1},
            "Smallest ratio of frames that match a landmark on probation to frames in which it is "
            "predicted to be visible.");
}

}  // namespace

void ListSnapshots(SnapshotOptions* snapshots, OptionLister* list) {
  list->Add("latency", &snapshots->latency, {0, 2, "seconds"},
            "Time from a keyframe to the first frame that is tracked in the map refined with it.")
      .MakeBasic("Increase if frames wait for the mapper; 0: no parallel mapping.");
  list->Add("insertion_latency", &snapshots->insertion_latency, {0, 2, "seconds"},
            "Time from a keyframe to the first frame that is tracked in a map with its new "
            "landmarks; at most mapping.latency.");
}

void ListMapping(MapperOptions* mapping, OptionLister* list) {
  list->Add("readout_time", &mapping->readout_time, {-0.99, 0.99, "seconds"},
            "Readout time of a rolling shutter, from the first image row to the last; 0: global "
            "shutter. Estimated if not set.")
      .MakeBasic("Set it if it is known.");
  list->Add("self_calibration", &mapping->self_calibration,
            "Correct focal length, principal point, radial distortion of the lens and the "
            "registration of depth if the images contradict them.");
  list->Add(
      "frame_structure", &mapping->frame_structure,
      "Refine the depths of parallel and perpendicular lines of a keyframe by each other. Not "
      "in mode pl-vo.");
  list->Add("min_window_interval", &mapping->min_window_interval, {0, 3600, "seconds"},
            "Smallest time between keyframes with local bundle adjustment.");
  list->Section("structure", &mapping->structure, ListFrameStructure);
  list->Add("fusion.max_neighbours", &mapping->fusion.max_neighbours, {0, 1000, "keyframes"},
            "Number of covisible keyframes that are searched for duplicate landmarks.");
  list->Section("selection", &mapping->selection, ListSelection);
  list->Add("noise.enabled", &mapping->noise.enabled,
            "Self-calibrate the sigmas of lines and depths.");
  list->Add("axes.enabled", &mapping->axes.enabled,
            "Estimate Manhattan axes and align lines with them. Mode msc-vo only.")
      .MakeBasic("Disable for comparison.");
  list->Section("pairs", &mapping->pairs, ListPairs);
  list->Section("window", &mapping->window, ListWindow);
  list->Section("culling", &mapping->culling, ListCulling);
}

std::vector<Option> ListWindowOptions(BundleAdjustmentOptions* window) {
  OptionLister list;
  list.Section("mapping.window", window, ListWindow);
  list.Section("mapping.window", window, ListThresholds);
  return list.Take();
}

}  // namespace msc_vo
