// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/option_list.h"

#include <utility>

namespace msc_vo {

namespace {

class OptionLister {
 public:
  template <typename T>
  void Add(const std::string& name, T* value, const std::string& help) {
    options_.push_back({prefix_ + name, value, help});
  }

  // `names` in the order of the enumerators, which count from 0.
  template <typename Enum>
  void AddChoice(const std::string& name, Enum* value, std::vector<std::string> names,
                 const std::string& help) {
    Choice choice{std::move(names), [value] { return static_cast<int>(*value); },
                  [value](int index) { *value = static_cast<Enum>(index); }};
    options_.push_back({prefix_ + name, std::move(choice), help});
  }

  // What `list` adds goes into section `name`.
  template <typename T>
  void Section(const std::string& name, T* value, void (*list)(T*, OptionLister*)) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    list(value, this);
    prefix_ = outer;
  }

  std::vector<Option> Take() { return std::move(options_); }

 private:
  std::string prefix_;
  std::vector<Option> options_;
};

void ListCamera(CameraSettings* camera, OptionLister* list) {
  list->Add("preset", &camera->preset, "a built-in camera instead of the numbers below");
  list->Add("fx", &camera->fx, "pixels");
  list->Add("fy", &camera->fy, "pixels; negative where y points up (ICL-NUIM)");
  list->Add("cx", &camera->cx, "pixels");
  list->Add("cy", &camera->cy, "pixels");
  list->Add("width", &camera->width, "pixels; the size of the images if not given");
  list->Add("height", &camera->height, "pixels");
  list->Add("depth_scale", &camera->depth_scale, "raw depth units per metre");
  constexpr const char* kDistortion[] = {"k1", "k2", "p1", "p2", "k3"};
  for (size_t i = 0; i < camera->distortion.size(); ++i) {
    list->Add(kDistortion[i], &camera->distortion[i], "lens distortion, as in OpenCV");
  }
}

void ListPoints(PointExtractorOptions* points, OptionLister* list) {
  list->Add("num_points", &points->num_points, "per image, at most");
  list->Add("num_levels", &points->num_levels, "of the image pyramid");
  list->Add("fast_threshold", &points->fast_threshold, "grey values, of a FAST corner");
  list->Add("min_fast_threshold", &points->min_fast_threshold,
            "grey values, where there is no corner at fast_threshold");
}

void ListLines(LineExtractorOptions* lines, OptionLister* list) {
  list->AddChoice("detector", &lines->detector, {"lsd", "edge-drawing"},
                  "the paper's, or a several times faster one");
  list->Add("max_lines", &lines->max_lines, "per image, the longest are kept");
  list->Add("min_length", &lines->min_length, "of a line, as part of the image's shorter side");
}

void ListNoise(SensorNoiseOptions* noise, OptionLister* list) {
  list->Add("inverse_depth_sigma", &noise->inverse_depth_sigma,
            "1/metres, of the depth sensor, systematic part included");
  list->Add("inverse_depth_noise", &noise->inverse_depth_noise,
            "1/metres, its random part: tells outliers within one image");
  list->Add("point_sigma", &noise->point_sigma, "pixels, of a point on level 0");
  list->Add("line_sigma", &noise->line_sigma, "pixels, of a segment's end across the line");
}

void ListLineFit(LineFitOptions* fit, OptionLister* list) {
  list->Add("inlier_sigmas", &fit->inlier_sigmas, "a depth sample is an inlier below this");
  list->Add("max_iterations", &fit->max_iterations, "pairs of samples tried");
  list->Add("min_inlier_ratio", &fit->min_inlier_ratio, "below this the line stays 2-D");
  list->Add("min_inliers", &fit->min_inliers, "below this the line stays 2-D");
}

void ListFeatures(FrameBuilderOptions* features, OptionLister* list) {
  list->Section("points", &features->points, ListPoints);
  list->Section("lines", &features->lines, ListLines);
  list->Section("noise", &features->noise, ListNoise);
  list->Section("line_fit", &features->line_fit, ListLineFit);
  list->AddChoice("line_depth", &features->line_depth, {"robust-fit", "end-points"},
                  "how a line gets its depth; mode pl-vo always takes end-points");
  list->Add("min_depth", &features->min_depth, "metres; nearer measurements are not valid");
  list->Add("max_depth", &features->max_depth, "metres; farther measurements are not valid");
}

void ListNormals(SurfaceNormalOptions* normals, OptionLister* list) {
  list->Add("grid_step", &normals->grid_step, "pixels between normals");
  list->Add("min_depth", &normals->min_depth, "metres; nearer measurements are not valid");
  list->Add("max_depth", &normals->max_depth, "metres; farther measurements are not valid");
}

void ListPointMatcher(PointMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_distance", &matcher->max_distance, "bits between descriptors");
  list->Add("max_ratio", &matcher->max_ratio, "best over second best descriptor distance");
  list->Add("max_level_difference", &matcher->max_level_difference,
            "pyramid levels from the predicted one");
}

void ListLineMatcher(LineMatcherOptions* matcher, OptionLister* list) {
  list->Add("max_angle", &matcher->max_angle, "degrees between directions in the image");
  list->Add("min_overlap", &matcher->min_overlap, "part of the shorter segment");
  list->Add("max_distance", &matcher->max_distance, "bits between descriptors");
  list->Add("bits_per_pixel", &matcher->bits_per_pixel,
            "bits of descriptor distance that weigh as much as one pixel");
}

void ListTerm(TermOptions* term, OptionLister* list) {
  list->Add("enabled", &term->enabled, "whether the term takes part");
  list->Add("huber", &term->huber, "sigmas; where the loss turns from square to linear");
}

// The terms and thresholds that the pose and the window problem share.
template <typename ProblemOptions>
void ListTerms(ProblemOptions* problem, OptionLister* list) {
  list->Section("point_reprojection", &problem->point_reprojection, ListTerm);
  list->Section("point_depth", &problem->point_depth, ListTerm);
  list->Section("line_reprojection", &problem->line_reprojection, ListTerm);
  list->Section("line_depth", &problem->line_depth, ListTerm);
  list->Add("reject_chi2_2", &problem->reject_chi2_2, "chi-square limit of 2 residuals");
  list->Add("reject_chi2_3", &problem->reject_chi2_3, "chi-square limit of 3 residuals");
  list->Add("reject_chi2_4", &problem->reject_chi2_4, "chi-square limit of 4 residuals");
}

void ListConsensus(CellConsensusOptions* consensus, OptionLister* list) {
  list->Add("enabled", &consensus->enabled, "leave out what moves by itself");
  list->Add("columns", &consensus->columns, "of parts of the image that vote on a pose");
  list->Add("rows", &consensus->rows, "of parts of the image that vote on a pose");
  list->Add("reject_chi2_6", &consensus->reject_chi2_6,
            "chi-square of the common errors of a part, beyond which it votes against a pose");
  list->Add("unconfirmed_weight", &consensus->unconfirmed_weight,
            "of a vote of what no two keyframes have seen");
  list->Add("min_cells", &consensus->min_cells, "by which another pose must be better");
}

void ListPose(PoseOptions* pose, OptionLister* list) {
  ListTerms(pose, list);
  list->Add("num_rounds", &pose->num_rounds, "of solving and classifying all matches");
  list->Add("num_robust_rounds", &pose->num_robust_rounds, "the first ones, with the loss");
  list->Add("iterations_per_round", &pose->iterations_per_round, "at most");
  list->Add(
      "max_frame_noise", &pose->max_frame_noise,
      "how far chi-square limits grow, in sigmas, where all points of a frame are seen worse");
  list->Section("consensus", &pose->consensus, ListConsensus);
}

void ListKeyframePolicy(KeyframePolicyOptions* policy, OptionLister* list) {
  list->Add("min_tracked_ratio", &policy->min_tracked_ratio,
            "of tracked features, relative to what it was after the last keyframe");
  list->Add("min_interval", &policy->min_interval, "frames between keyframes");
  list->Add("max_interval", &policy->max_interval, "frames between keyframes");
  list->Add("close_relative_sigma", &policy->close_relative_sigma,
            "of the depth, below which a point is close");
}

void ListRelocalizer(RelocalizerOptions* relocalizer, OptionLister* list) {
  list->Add("max_distance", &relocalizer->max_distance, "bits between descriptors");
  list->Add("max_ratio", &relocalizer->max_ratio, "best over second best descriptor distance");
  list->Add("max_iterations", &relocalizer->max_iterations, "triples of matches tried");
  list->Add("min_inliers", &relocalizer->min_inliers, "matches that must agree");
  list->Add("inlier_sigmas", &relocalizer->inlier_sigmas, "reprojection of a match that agrees");
}

void ListTracking(TrackerOptions* tracking, OptionLister* list) {
  list->Section("point_matcher", &tracking->point_matcher, ListPointMatcher);
  list->Section("line_matcher", &tracking->line_matcher, ListLineMatcher);
  list->Section("pose", &tracking->pose, ListPose);
  list->Section("keyframes", &tracking->keyframes, ListKeyframePolicy);
  list->Section("relocalizer", &tracking->relocalizer, ListRelocalizer);
  list->Add("prediction_radius", &tracking->prediction_radius,
            "pixels, search around the predicted pose");
  list->Add("wide_radius", &tracking->wide_radius, "pixels, when that found too little");
  list->Add("local_map_radius", &tracking->local_map_radius, "pixels, around an estimated pose");
  list->Add("max_local_keyframes", &tracking->max_local_keyframes, "in the local map");
  list->Add("min_matches", &tracking->min_matches, "points and lines that a pose stands on");
  list->Add("min_inlier_ratio", &tracking->min_inlier_ratio, "of all matches of a pose");
  list->Add("weak_translation_sigma", &tracking->weak_translation_sigma,
            "metres; a pose known worse is weak");
  list->Add("weak_rotation_sigma", &tracking->weak_rotation_sigma,
            "degrees; a pose known worse is weak");
  list->Add("max_prediction", &tracking->max_prediction,
            "seconds that constant velocity may bridge");
  list->Add("relocalization_keyframes", &tracking->relocalization_keyframes,
            "tried per frame while the map is searched");
  list->Add("min_initial_features", &tracking->min_initial_features,
            "with depth, in the first frame");
}

void ListFrameStructure(FrameStructureOptions* structure, OptionLister* list) {
  list->Add("max_angle", &structure->max_angle, "degrees of a pair's angle from 0 or 90");
  list->Add("pair_sigma", &structure->pair_sigma, "degrees, of the angle of what was built so");
  list->Add("gate_sigmas", &structure->gate_sigmas, "of the angle of a pair");
  list->Add("max_partners", &structure->max_partners, "of each kind that a line chooses");
  list->Add("huber", &structure->huber, "sigmas; where the loss turns from square to linear");
  list->Add("max_iterations", &structure->max_iterations, "at most");
}

void ListFusion(FusionOptions* fusion, OptionLister* list) {
  list->Section("point_matcher", &fusion->point_matcher, ListPointMatcher);
  list->Section("line_matcher", &fusion->line_matcher, ListLineMatcher);
  list->Add("max_neighbours", &fusion->max_neighbours, "keyframes searched for duplicates");
  list->Add("radius", &fusion->radius, "pixels between a landmark and its feature");
  list->Add("max_line_angle", &fusion->max_line_angle, "degrees between duplicates");
  list->Add("max_line_offset", &fusion->max_line_offset, "between duplicates, part of the depth");
}

void ListSelection(WindowSelectionOptions* selection, OptionLister* list) {
  list->Add("max_keyframes", &selection->max_keyframes, "optimised together");
  list->Add("max_fixed_keyframes", &selection->max_fixed_keyframes, "that only observe");
  list->Add("min_shared", &selection->min_shared, "landmarks with the current keyframe");
  list->Add("min_observations", &selection->min_observations, "of a landmark");
}

void ListLandmarkNoise(LandmarkNoiseOptions* noise, OptionLister* list) {
  list->Add("enabled", &noise->enabled, "whether every landmark has a noise of its own");
  list->Add("prior", &noise->prior, "residuals that a noise of 1 counts as");
  list->Add("depth_offset_sigma", &noise->depth_offset_sigma,
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
  list->Add("reject_chi2_1", &window->reject_chi2_1, "chi-square limit of 1 residual");
  list->Add("line_endpoint_prior", &window->line_endpoint_prior,
            "whether end points are held along their line");
  list->Add("line_endpoint_prior_sigma", &window->line_endpoint_prior_sigma,
            "metres, of the prior that keeps end points from sliding along their line");
  list->Section("landmark_noise", &window->landmark_noise, ListLandmarkNoise);
  list->Add("first_iterations", &window->first_iterations, "with all observations");
  list->Add("second_iterations", &window->second_iterations, "after rejection");
}

void ListPairs(StructuralPairOptions* pairs, OptionLister* list) {
  list->Add("parallel", &pairs->parallel, "whether parallel lines are bound; mode msc-vo only");
  list->Add("perpendicular", &pairs->perpendicular, "the same for perpendicular ones");
  list->Add("max_angle", &pairs->max_angle, "degrees of a pair's angle from 0 or 90");
  list->Add("pair_sigma", &pairs->pair_sigma, "degrees, of the angle of what was built so");
  list->Add("gate_sigmas", &pairs->gate_sigmas, "of the angle of a pair");
  list->Add("max_partners", &pairs->max_partners, "of each kind that a line chooses");
}

void ListCoarseAxes(CoarseAxesOptions* coarse, OptionLister* list) {
  list->Add("max_angle", &coarse->max_angle, "radians, half angle of an axis' cone");
  list->Add("max_sigma", &coarse->max_sigma, "radians; evidence known worse does not count");
  list->Add("first_bandwidth", &coarse->first_bandwidth, "radians, of the mean shift's kernel");
  list->Add("last_bandwidth", &coarse->last_bandwidth, "radians, of the mean shift's kernel");
  list->Add("min_explained_ratio", &coarse->min_explained_ratio,
            "of the evidence that axes must explain");
  list->Add("max_rival", &coarse->max_rival, "what other axes may explain, relative to the best");
  list->Add("min_axis_ratio", &coarse->min_axis_ratio, "of the evidence for one axis to count");
  list->Add("max_misfit", &coarse->max_misfit, "radians, mean of an axis' evidence off it");
  list->Add("max_false_alarms", &coarse->max_false_alarms, "axes expected in random evidence");
}

void ListAxisAssignment(AxisAssociationOptions* association, OptionLister* list) {
  list->Add("max_sigmas", &association->max_sigmas, "between a line and its axis");
  list->Add("max_angle", &association->max_angle, "radians between a line and its axis");
  list->Add("max_sigma", &association->max_sigma, "radians; lines known worse have no axis");
}

void ListAxesRefinement(ManhattanAxesOptions* refinement, OptionLister* list) {
  list->Add("huber", &refinement->huber, "sigmas; where the loss turns from square to linear");
  list->Add("reject_chi2_2", &refinement->reject_chi2_2, "chi-square limit of 2 residuals");
  list->Add("num_rounds", &refinement->num_rounds, "of solving and classifying all views");
  list->Add("iterations_per_round", &refinement->iterations_per_round, "at most");
  list->Add("min_inliers", &refinement->min_inliers, "views of lines that must agree");
}

void ListAxesEstimator(AxesEstimatorOptions* estimator, OptionLister* list) {
  list->Add("coarse_sigma", &estimator->coarse_sigma, "radians, of axes from one keyframe");
  list->Add("min_keyframes", &estimator->min_keyframes, "in the map, for a refinement");
  list->Add("min_axis_lines", &estimator->min_axis_lines, "in the map, for a refinement");
  list->Add("min_growth", &estimator->min_growth, "of the lines on axes, for the next refinement");
  list->Add("min_line_ratio", &estimator->min_line_ratio, "of lines on axes, or they are dropped");
  list->Add("max_correction", &estimator->max_correction, "radians that a refinement may turn");
  list->Add("freeze_sigma", &estimator->freeze_sigma, "radians; axes known better stay");
}

void ListNoiseEstimator(NoiseEstimatorOptions* noise, OptionLister* list) {
  list->Add("enabled", &noise->enabled, "whether the sigmas of features are learnt from residuals");
  list->Add("prior", &noise->prior, "quarters of images that the initial sigmas count as");
  list->Add("memory", &noise->memory, "quarters of images that the estimate rests on");
  list->Add("max_scale", &noise->max_scale, "how far sigmas may grow, and shrink");
}

void ListAxes(SceneAxesOptions* axes, OptionLister* list) {
  list->Add("enabled", &axes->enabled, "whether Manhattan axes are used; mode msc-vo only");
  list->Section("coarse", &axes->coarse, ListCoarseAxes);
  list->Section("association", &axes->association, ListAxisAssignment);
  list->Section("refinement", &axes->refinement, ListAxesRefinement);
  list->Section("estimator", &axes->estimator, ListAxesEstimator);
  list->Add("deviation", &axes->deviation, "radians, of lines from the axes they were built along");
}

void ListCulling(CullingOptions* culling, OptionLister* list) {
  list->Add("probation_keyframes", &culling->probation_keyframes, "of a new landmark");
  list->Add("min_observations", &culling->min_observations, "that a landmark must reach by then");
  list->Add("min_found_ratio", &culling->min_found_ratio, "frames that find it / should show it");
  list->Add("redundant_ratio", &culling->redundant_ratio,
            "of a keyframe's landmarks that others show as well");
  list->Add("redundant_observers", &culling->redundant_observers, "how many others");
}

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
  list->Add("min_window_interval", &mapping->min_window_interval,
            "seconds from a keyframe with a window to the next one, at least");
  list->Section("culling", &mapping->culling, ListCulling);
  list->Add("readout_time", &mapping->readout_time,
            "seconds from the first row of an image to its last, 0: global shutter; learnt if not "
            "given");
}

}  // namespace

std::vector<Option> ListOptions(Configuration* configuration) {
  OptionLister list;
  OdometryOptions& odometry = configuration->odometry;
  list.Section("camera", &configuration->camera, ListCamera);
  list.AddChoice("mode", &odometry.mode, {"pl-vo", "pl-vo-depth", "msc-vo"},
                 "what of the method is used; each adds to the one before");
  list.Add("use_points", &odometry.use_points, "off: lines alone");
  list.Add("use_lines", &odometry.use_lines, "off: points alone");
  list.Add("align_depth", &odometry.align_depth,
           "move depth images to the time of their colour image where the two stamps differ");
  list.Add("threads", &odometry.threads,
           "processors to make use of; the result is the same for any number");
  list.Add("realtime", &odometry.snapshots.realtime,
           "no frame waits for a map that is late; runs repeat as long as none is");
  list.Section("features", &odometry.features, ListFeatures);
  list.Section("normals", &odometry.normals, ListNormals);
  list.Section("tracking", &odometry.tracking, ListTracking);
  list.Add("mapping.insertion_latency_frames", &odometry.snapshots.insertion_latency_frames,
           "frames from a keyframe to the first that sees its new landmarks");
  list.Add("mapping.latency_frames", &odometry.snapshots.latency_frames,
           "frames from a keyframe to the first that sees the map refined with it");
  list.Section("mapping", &odometry.mapping, ListMapping);
  return list.Take();
}

}  // namespace msc_vo
