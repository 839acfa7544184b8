// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

// Learnt deviation of lines from structure.
void ListDeviation(DeviationOptions* deviation, OptionLister* list) {
  list->Add("prior", &deviation->prior, {0.021, 3.999, "degrees"},
            "Median deviation before the first measurement.");
  list->Add("memory", &deviation->memory, {1, 1e9, "angles"},
            "Number of angles that the estimate depends on.");
}

void ListFrameStructure(FrameStructureOptions* structure, OptionLister* list) {
  list->Add("max_angle", &structure->max_angle, {0.01, 44, "degrees"},
            "Largest deviation of a pair's angle from 0 or 90 degrees in a frame.");
  list->Add("pair_sigma", &structure->pair_sigma, {0.001, 90, "degrees"},
            "Standard deviation of the true angle of lines that were built parallel or "
            "perpendicular.");
  list->Add("gate_sigmas", &structure->gate_sigmas, {0.01, 100, "sigmas"},
            "Largest deviation of a pair's measured angle.");
  list->Add("huber", &structure->huber, {0.01, 1000, "sigmas"}, "Huber threshold of a pair.");
  list->Add("max_iterations", &structure->max_iterations, {1, 1000, "iterations"},
            "Largest number of iterations.");
}

void ListFusion(FusionOptions* fusion, OptionLister* list) {
  list->Add("max_neighbours", &fusion->max_neighbours, {0, 1000, "keyframes"},
            "Number of covisible keyframes that are searched for duplicate landmarks.");
  list->Add("radius", &fusion->radius, {0.01, 1000, "pixels"},
            "Search radius around the projection of a landmark.");
  list->Add("max_line_angle", &fusion->max_line_angle, {0.01, 90, "degrees"},
            "Largest angle between duplicate lines.");
  list->Add("max_line_offset", &fusion->max_line_offset, {1e-4, 10},
            "Largest distance between duplicate lines, as a fraction of the depth.");
}

void ListSelection(WindowSelectionOptions* selection, OptionLister* list) {
  list->Add("max_keyframes", &selection->max_keyframes, {1, 100, "keyframes"},
            "Largest number of keyframes that local bundle adjustment optimises.");
  list->Add("max_fixed_keyframes", &selection->max_fixed_keyframes, {0, 1000, "keyframes"},
            "Largest number of keyframes that observe its landmarks and are held fixed.");
  list->Add("min_shared", &selection->min_shared, {0, 10000, "landmarks"},
            "Smallest number of landmarks that a keyframe shares with the current one.");
  list->Add("min_observations", &selection->min_observations, {1, 1000, "observations"},
            "Smallest number of observations of a landmark in local bundle adjustment.");
}

void ListTerm(TermOptions* term, OptionLister* list) {
  list->Add("enabled", &term->enabled, "Use the factor in local bundle adjustment.");
  list->Add("huber", &term->huber, {0.01, 1000, "sigmas"}, "Huber threshold of the term.");
}

void ListLandmarkNoise(LandmarkNoiseOptions* noise, OptionLister* list) {
  list->Add("enabled", &noise->enabled, "Estimate a noise scale for each landmark.");
  list->Add("prior", &noise->prior, {0.001, 1e6, "residuals"},
            "Weight of the prior noise scale of 1.");
  list->Add("depth_offset_sigma", &noise->depth_offset_sigma, {1e-6, 10, "metres"},
            "Standard deviation of the depth error of a line that all views have in common.");
}

// The terms that pose optimisation has too use the same settings there.
void ListWindowTerms(BundleAdjustmentOptions* window, OptionLister* list) {
  list->Section("point_reprojection", &window->point_reprojection, ListTerm);
  list->Section("point_depth", &window->point_depth, ListTerm);
  list->Section("line_reprojection", &window->line_reprojection, ListTerm);
  list->Section("line_depth", &window->line_depth, ListTerm);
  list->Section("parallel", &window->parallel, ListTerm);
  list->Section("perpendicular", &window->perpendicular, ListTerm);
  list->Section("manhattan", &window->manhattan, ListTerm);
}

void ListWindow(BundleAdjustmentOptions* window, OptionLister* list) {
  list->AddChoice("solver", &window->solver, {"block-schur", "ceres", "ceres-suite-sparse"},
                  "Solver of local bundle adjustment.")
      .MakeBasic("Choose a Ceres solver for comparison; block-schur is the fastest.");
  list->Add("line_endpoint_prior", &window->line_endpoint_prior,
            "Prior on the end points of a line along its direction.");
  list->Add("line_endpoint_prior_sigma", &window->line_endpoint_prior_sigma, {1e-6, 100, "metres"},
            "Standard deviation of the end-point prior.");
  constexpr char kRejection[] = " of an outlier, in bundle adjustment and in pose optimisation.";
  list->Add("reject_chi2_1", &window->reject_chi2_1, {0.001, 10000},
            "Smallest chi-square with 1 degree of freedom of an outlier.");
  list->Add("reject_chi2_2", &window->reject_chi2_2, {0.001, 10000},
            std::string("Smallest chi-square with 2 degrees of freedom") + kRejection);
  list->Add("reject_chi2_3", &window->reject_chi2_3, {0.001, 10000},
            std::string("Smallest chi-square with 3 degrees of freedom") + kRejection);
  list->Add("reject_chi2_4", &window->reject_chi2_4, {0.001, 10000},
            std::string("Smallest chi-square with 4 degrees of freedom") + kRejection);
  list->Add("first_iterations", &window->first_iterations, {1, 100, "iterations"},
            "Iterations of the first solve, with all observations.");
  list->Add("second_iterations", &window->second_iterations, {1, 100, "iterations"},
            "Iterations of the second solve, without outliers.");
  ListWindowTerms(window, list);
  list->Section("landmark_noise", &window->landmark_noise, ListLandmarkNoise);
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
  list->Add("max_sigma", &pairs->max_sigma, {0.01, 90, "degrees"},
            "Largest standard deviation of the direction of a line in a pair.");
  list->Add("min_probability", &pairs->min_probability, {0, 1},
            "Smallest probability of a pair not to be one by chance.");
  list->Add("max_partners", &pairs->max_partners, {1, 100, "lines"},
            "Largest number of partners of each kind per line.");
  list->Section("deviation", &pairs->deviation, ListDeviation);
}

void ListCoarseAxes(CoarseAxesOptions* coarse, OptionLister* list) {
  list->Add("max_angle", &coarse->max_angle, {0.01, 44, "degrees"},
            "Half angle of the cone of an axis.");
  list->Add("max_sigma", &coarse->max_sigma, {0.01, 90, "degrees"},
            "Largest standard deviation of a direction that is used.");
  list->Add("first_bandwidth", &coarse->first_bandwidth, {0.01, 14.9, "degrees"},
            "Initial bandwidth of mean shift.");
  list->Add("last_bandwidth", &coarse->last_bandwidth, {0.01, 14.9, "degrees"},
            "Final bandwidth of mean shift.");
  list->Add("min_explained_ratio", &coarse->min_explained_ratio, {0, 1},
            "Smallest fraction of the directions that the axes explain.");
  list->Add("max_rival", &coarse->max_rival, {0.001, 1},
            "Largest support of other axes, as a fraction of that of the best axes.");
  list->Add("min_axis_ratio", &coarse->min_axis_ratio, {0, 1},
            "Smallest fraction of the directions in the cone of an axis with support.");
  list->Add("max_misfit", &coarse->max_misfit, {0.01, 90, "degrees"},
            "Largest angle between an axis and the mean of its directions.");
  list->Add("max_false_alarms", &coarse->max_false_alarms, {1e-30, 1e6},
            "Largest expected number of axes with as much support in random directions.");
}

void ListAxisAssociation(AxisAssociationOptions* association, OptionLister* list) {
  list->Add("max_sigmas", &association->max_sigmas, {0.01, 100, "sigmas"},
            "Largest angle between a line and its axis, relative to its standard deviation.");
  list->Add("max_angle", &association->max_angle, {0.01, 44, "degrees"},
            "Largest angle between a line and its axis.");
  list->Add("max_sigma", &association->max_sigma, {0.01, 90, "degrees"},
            "Largest standard deviation of the direction of a line on an axis.");
  list->Add("min_probability", &association->min_probability, {0, 1},
            "Smallest probability of a line near an axis not to be there by chance.");
}

void ListAxesRefinement(ManhattanAxesOptions* refinement, OptionLister* list) {
  list->Add("num_rounds", &refinement->num_rounds, {1, 100, "rounds"},
            "Rounds of optimisation and classification of all observations.");
  list->Add("iterations_per_round", &refinement->iterations_per_round, {1, 100, "iterations"},
            "Largest number of iterations of a round.");
  list->Add("min_inliers", &refinement->min_inliers, {2, 10000, "observations"},
            "Smallest number of inliers of refined axes.");
}

void ListAxesEstimator(AxesEstimatorOptions* estimator, OptionLister* list) {
  list->Add("coarse_sigma", &estimator->coarse_sigma, {0.001, 90, "degrees"},
            "Standard deviation of axes from one keyframe.");
  list->Add("min_keyframes", &estimator->min_keyframes, {1, 10000, "keyframes"},
            "Smallest number of keyframes for a refinement.");
  list->Add("min_axis_lines", &estimator->min_axis_lines, {2, 10000, "lines"},
            "Smallest number of lines on axes for a refinement.");
  list->Add("min_growth", &estimator->min_growth, {1.001, 100},
            "Factor by which the number of lines on axes grows between refinements.");
  list->Add("min_line_ratio", &estimator->min_line_ratio, {0, 1},
            "Smallest fraction of the lines on axes; coarse axes below it are dropped.");
  list->Add("max_correction", &estimator->max_correction, {0.01, 90, "degrees"},
            "Largest rotation by a refinement.");
}

void ListNoiseEstimator(NoiseEstimatorOptions* noise, OptionLister* list) {
  list->Add("enabled", &noise->enabled, "Self-calibrate the sigmas of lines and depths.");
  list->Add("prior", &noise->prior, {0.001, 1e9, "image quadrants"},
            "Weight of the initial sigmas, as a number of observed image quadrants.");
  list->Add("memory", &noise->memory, {0.001, 1e9, "image quadrants"},
            "Number of observed image quadrants that the estimate depends on.");
  list->Add("max_scale", &noise->max_scale, {1, 100},
            "Largest factor by which sigmas increase or decrease.");
}

void ListAxes(SceneAxesOptions* axes, OptionLister* list) {
  list->Add("enabled", &axes->enabled,
            "Estimate Manhattan axes and align lines with them. Mode msc-vo only.")
      .MakeBasic("Disable for comparison.");
  list->Section("coarse", &axes->coarse, ListCoarseAxes);
  list->Section("association", &axes->association, ListAxisAssociation);
  list->Section("refinement", &axes->refinement, ListAxesRefinement);
  list->Section("estimator", &axes->estimator, ListAxesEstimator);
  list->Section("deviation", &axes->deviation, ListDeviation);
}

void ListCulling(CullingOptions* culling, OptionLister* list) {
  list->Add("probation_keyframes", &culling->probation_keyframes, {1, 1000, "keyframes"},
            "Keyframes during which a new landmark is on probation.");
  list->Add("min_observations", &culling->min_observations, {1, 1000, "observations"},
            "Smallest number of observations of a landmark after its probation.");
  list->Add("min_found_ratio", &culling->min_found_ratio, {0, 1},
            "Smallest ratio of frames that match a landmark on probation to frames in which it is "
            "predicted to be visible.");
  list->Add("redundant_ratio", &culling->redundant_ratio, {0.001, 1},
            "Fraction of its landmarks that others observe above which a keyframe is redundant.");
  list->Add("redundant_observers", &culling->redundant_observers, {1, 1000, "keyframes"},
            "Number of other keyframes that must observe such a landmark.");
}

void ListJoining(MapAlignmentOptions* joining, OptionLister* list) {
  list->Add("min_frames", &joining->min_frames, {1, 10, "keyframes"},
            "Keyframes that must be found in both maps and agree on their alignment.");
  list->Add("map_sigma", &joining->map_sigma, {1e-6, 10, "metres"},
            "Standard deviation of a position due to the errors of a map within one view.");
  list->Add("map_rotation_sigma", &joining->map_rotation_sigma, {1e-6, 90, "degrees"},
            "Standard deviation of an orientation due to the same errors.");
  list->Add("reject_chi2_6", &joining->reject_chi2_6, {0.001, 10000},
            "Squared Mahalanobis distance above which a keyframe disagrees with an alignment.");
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
  list->Section("fusion", &mapping->fusion, ListFusion);
  list->Section("selection", &mapping->selection, ListSelection);
  list->Section("noise", &mapping->noise, ListNoiseEstimator);
  list->Section("axes", &mapping->axes, ListAxes);
  list->Section("pairs", &mapping->pairs, ListPairs);
  list->Section("window", &mapping->window, ListWindow);
  list->Section("culling", &mapping->culling, ListCulling);
  list->Section("joining", &mapping->joining, ListJoining);
}

}  // namespace msc_vo
