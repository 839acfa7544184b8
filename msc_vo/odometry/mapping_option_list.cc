// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListFrameStructure(FrameStructureOptions* structure, OptionLister* list) {
  list->Add("max_angle", &structure->max_angle, {0.01, 44},
            "degrees of a pair's angle from 0 or 90");
  list->Add("pair_sigma", &structure->pair_sigma, {0.001, 90},
            "degrees, of the angle of what was built so");
  list->Add("gate_sigmas", &structure->gate_sigmas, {0.01, 100}, "of the angle of a pair");
  list->Add("max_partners", &structure->max_partners, {1, 100}, "of each kind that a line chooses");
  list->Add("huber", &structure->huber, {0.01, 1000},
            "sigmas; where the loss turns from square to linear");
  list->Add("max_iterations", &structure->max_iterations, {1, 1000}, "at most");
}

void ListFusion(FusionOptions* fusion, OptionLister* list) {
  list->Section("point_matcher", &fusion->point_matcher, ListPointMatcher);
  list->Section("line_matcher", &fusion->line_matcher, ListLineMatcher);
  list->Add("max_neighbours", &fusion->max_neighbours, {0, 1000},
            "keyframes searched for duplicates");
  list->Add("radius", &fusion->radius, {0.01, 1000}, "pixels between a landmark and its feature");
  list->Add("max_line_angle", &fusion->max_line_angle, {0.01, 90}, "degrees between duplicates");
  list->Add("max_line_offset", &fusion->max_line_offset, {1e-4, 10},
            "between duplicates, part of the depth");
}

void ListSelection(WindowSelectionOptions* selection, OptionLister* list) {
  list->Add("max_keyframes", &selection->max_keyframes, {1, 100}, "optimised together");
  list->Add("max_fixed_keyframes", &selection->max_fixed_keyframes, {0, 1000}, "that only observe");
  list->Add("min_shared", &selection->min_shared, {0, 10000},
            "landmarks with the current keyframe");
  list->Add("min_observations", &selection->min_observations, {1, 1000}, "of a landmark");
}

void ListLandmarkNoise(LandmarkNoiseOptions* noise, OptionLister* list) {
  list->Add("enabled", &noise->enabled, "whether every landmark has a noise of its own");
  list->Add("prior", &noise->prior, {0.001, 1e6}, "residuals that a noise of 1 counts as");
  list->Add("depth_offset_sigma", &noise->depth_offset_sigma, {1e-6, 10},
            "metres, of what depths of a line are off in all views alike");
}

void ListWindow(BundleAdjustmentOptions* window, OptionLister* list) {
  list->AddChoice("solver", &window->solver,
                  {"block-schur", "ceres-dense-schur", "ceres-suite-sparse", "ceres-eigen-sparse"},
                  "what minimises the window's sum; the first is the fastest");
  list->Add("analytic_jacobians", &window->analytic_jacobians,
            "of the Ceres solvers; off: automatic derivatives");
  list->Add("explicit_ordering", &window->explicit_ordering,
            "of the Ceres solvers; off: Ceres chooses what it eliminates first");
  ListTerms(window, list);
  list->Section("parallel", &window->parallel, ListTerm);
  list->Section("perpendicular", &window->perpendicular, ListTerm);
  list->Section("manhattan", &window->manhattan, ListTerm);
  list->Add("reject_chi2_1", &window->reject_chi2_1, {0.001, 10000},
            "chi-square limit of 1 residual");
  list->Add("line_endpoint_prior", &window->line_endpoint_prior,
            "whether end points are held along their line");
  list->Add("line_endpoint_prior_sigma", &window->line_endpoint_prior_sigma, {1e-6, 100},
            "metres, of the prior that keeps end points from sliding along their line");
  list->Section("landmark_noise", &window->landmark_noise, ListLandmarkNoise);
  list->Add("first_iterations", &window->first_iterations, {1, 100}, "with all observations");
  list->Add("second_iterations", &window->second_iterations, {1, 100}, "after rejection");
}

void ListPairs(StructuralPairOptions* pairs, OptionLister* list) {
  list->Add("parallel", &pairs->parallel, "whether parallel lines are bound; mode msc-vo only");
  list->Add("perpendicular", &pairs->perpendicular, "the same for perpendicular ones");
  list->Add("max_angle", &pairs->max_angle, {0.01, 44}, "degrees of a pair's angle from 0 or 90");
  list->Add("pair_sigma", &pairs->pair_sigma, {0.001, 90},
            "degrees, of the angle of what was built so");
  list->Add("gate_sigmas", &pairs->gate_sigmas, {0.01, 100}, "of the angle of a pair");
  list->Add("max_partners", &pairs->max_partners, {1, 100}, "of each kind that a line chooses");
}

void ListCoarseAxes(CoarseAxesOptions* coarse, OptionLister* list) {
  list->Add("max_angle", &coarse->max_angle, {0.01, 44}, "degrees, half angle of an axis' cone");
  list->Add("max_sigma", &coarse->max_sigma, {0.01, 90},
            "degrees; evidence known worse does not count");
  list->Add("first_bandwidth", &coarse->first_bandwidth, {0.01, 14.9},
            "degrees, of the mean shift's kernel");
  list->Add("last_bandwidth", &coarse->last_bandwidth, {0.01, 14.9},
            "degrees, of the mean shift's kernel");
  list->Add("min_explained_ratio", &coarse->min_explained_ratio, {0, 1},
            "of the evidence that axes must explain");
  list->Add("max_rival", &coarse->max_rival, {0.001, 1},
            "what other axes may explain, relative to the best");
  list->Add("min_axis_ratio", &coarse->min_axis_ratio, {0, 1},
            "of the evidence for one axis to count");
  list->Add("max_misfit", &coarse->max_misfit, {0.01, 90},
            "degrees, mean of an axis' evidence off it");
  list->Add("max_false_alarms", &coarse->max_false_alarms, {1e-30, 1e6},
            "axes expected in random evidence");
}

void ListAxisAssociation(AxisAssociationOptions* association, OptionLister* list) {
  list->Add("max_sigmas", &association->max_sigmas, {0.01, 100}, "between a line and its axis");
  list->Add("max_angle", &association->max_angle, {0.01, 44},
            "degrees between a line and its axis");
  list->Add("max_sigma", &association->max_sigma, {0.01, 90},
            "degrees; lines known worse have no axis");
}

void ListAxesRefinement(ManhattanAxesOptions* refinement, OptionLister* list) {
  list->Add("huber", &refinement->huber, {0.01, 1000},
            "sigmas; where the loss turns from square to linear");
  list->Add("reject_chi2_2", &refinement->reject_chi2_2, {0.001, 10000},
            "chi-square limit of 2 residuals");
  list->Add("num_rounds", &refinement->num_rounds, {1, 100},
            "of solving and classifying all views");
  list->Add("iterations_per_round", &refinement->iterations_per_round, {1, 100}, "at most");
  list->Add("min_inliers", &refinement->min_inliers, {2, 10000}, "views of lines that must agree");
}

void ListAxesEstimator(AxesEstimatorOptions* estimator, OptionLister* list) {
  list->Add("coarse_sigma", &estimator->coarse_sigma, {0.001, 90},
            "degrees, of axes from one keyframe");
  list->Add("min_keyframes", &estimator->min_keyframes, {1, 10000}, "in the map, for a refinement");
  list->Add("min_axis_lines", &estimator->min_axis_lines, {2, 10000},
            "in the map, for a refinement");
  list->Add("min_growth", &estimator->min_growth, {1.001, 100},
            "of the lines on axes, for the next refinement");
  list->Add("min_line_ratio", &estimator->min_line_ratio, {0, 1},
            "of lines on axes, or they are dropped");
  list->Add("max_correction", &estimator->max_correction, {0.01, 90},
            "degrees that a refinement may turn");
  list->Add("freeze_sigma", &estimator->freeze_sigma, {0, 90}, "degrees; axes known better stay");
}

void ListNoiseEstimator(NoiseEstimatorOptions* noise, OptionLister* list) {
  list->Add("enabled", &noise->enabled, "whether the sigmas of features are learnt from residuals");
  list->Add("prior", &noise->prior, {0.001, 1e9},
            "quarters of images that the initial sigmas count as");
  list->Add("memory", &noise->memory, {0.001, 1e9},
            "quarters of images that the estimate rests on");
  list->Add("max_scale", &noise->max_scale, {1, 100}, "how far sigmas may grow, and shrink");
}

void ListAxes(SceneAxesOptions* axes, OptionLister* list) {
  list->Add("enabled", &axes->enabled, "whether Manhattan axes are used; mode msc-vo only");
  list->Section("coarse", &axes->coarse, ListCoarseAxes);
  list->Section("association", &axes->association, ListAxisAssociation);
  list->Section("refinement", &axes->refinement, ListAxesRefinement);
  list->Section("estimator", &axes->estimator, ListAxesEstimator);
  list->Add("deviation", &axes->deviation, {0.001, 90},
            "degrees, of lines from the axes they were built along");
}

void ListCulling(CullingOptions* culling, OptionLister* list) {
  list->Add("probation_keyframes", &culling->probation_keyframes, {1, 1000}, "of a new landmark");
  list->Add("min_observations", &culling->min_observations, {1, 1000},
            "that a landmark must reach by then");
  list->Add("min_found_ratio", &culling->min_found_ratio, {0, 1},
            "frames that find it / should show it");
  list->Add("redundant_ratio", &culling->redundant_ratio, {0.001, 1},
            "of a keyframe's landmarks that others show as well");
  list->Add("redundant_observers", &culling->redundant_observers, {1, 1000}, "how many others");
}

}  // namespace

void ListMapping(MapperOptions* mapping, OptionLister* list) {
  list->AddChoice(
      "frame_structure", &mapping->frame_structure, {"without-pairs", "always", "never"},
      "when parallel and perpendicular lines of a keyframe refine each other's depth: where the "
      "map has no pairs (mode pl-vo-depth), always, or never (mode pl-vo)");
  list->Section("structure", &mapping->structure, ListFrameStructure);
  list->Section("fusion", &mapping->fusion, ListFusion);
  list->Section("selection", &mapping->selection, ListSelection);
  list->Section("noise", &mapping->noise, ListNoiseEstimator);
  list->Section("axes", &mapping->axes, ListAxes);
  list->Section("pairs", &mapping->pairs, ListPairs);
  list->Section("window", &mapping->window, ListWindow);
  list->Add("min_window_interval", &mapping->min_window_interval, {0, 3600},
            "seconds from a keyframe with a window to the next one, at least");
  list->Section("culling", &mapping->culling, ListCulling);
  list->Add("readout_time", &mapping->readout_time, {-0.99, 0.99},
            "seconds from the first row of an image to its last, 0: global shutter; learnt if not "
            "given");
}

}  // namespace msc_vo
