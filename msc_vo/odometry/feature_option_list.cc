// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListPoints(PointExtractorOptions* points, OptionLister* list) {
  list->Add("num_points", &points->num_points, {0, 20000}, "per image, at most");
  list->Add("num_levels", &points->num_levels, {1, 32}, "of the image pyramid");
  list->Add("fast_threshold", &points->fast_threshold, {1, 255}, "grey values, of a FAST corner");
  list->Add("min_fast_threshold", &points->min_fast_threshold, {1, 255},
            "grey values, where there is no corner at fast_threshold");
}

void ListLines(LineExtractorOptions* lines, OptionLister* list) {
  list->AddChoice("detector", &lines->detector, {"lsd", "edge-drawing"},
                  "the paper's, or a several times faster one");
  list->Add("max_lines", &lines->max_lines, {0, 10000}, "per image, the longest are kept");
  list->Add("min_length", &lines->min_length, {0.001, 1},
            "of a line, as part of the image's shorter side");
}

void ListNoise(SensorNoiseOptions* noise, OptionLister* list) {
  list->Add("inverse_depth_sigma", &noise->inverse_depth_sigma, {1e-6, 1},
            "1/metres, of the depth sensor, systematic part included");
  list->Add("inverse_depth_noise", &noise->inverse_depth_noise, {1e-6, 1},
            "1/metres, its random part: tells outliers within one image");
  list->Add("point_sigma", &noise->point_sigma, {0.001, 100}, "pixels, of a point on level 0");
  list->Add("line_sigma", &noise->line_sigma, {0.001, 100},
            "pixels, of a segment's end across the line");
}

void ListLineFit(LineFitOptions* fit, OptionLister* list) {
  list->Add("inlier_sigmas", &fit->inlier_sigmas, {0.01, 100},
            "a depth sample is an inlier below this");
  list->Add("max_iterations", &fit->max_iterations, {1, 10000}, "pairs of samples tried");
  list->Add("min_inlier_ratio", &fit->min_inlier_ratio, {0, 1}, "below this the line stays 2-D");
  list->Add("min_inliers", &fit->min_inliers, {2, 10000}, "below this the line stays 2-D");
}

}  // namespace

void ListFeatures(FrameBuilderOptions* features, OptionLister* list) {
  list->Section("points", &features->points, ListPoints);
  list->Section("lines", &features->lines, ListLines);
  list->Section("noise", &features->noise, ListNoise);
  list->Section("line_fit", &features->line_fit, ListLineFit);
  list->AddChoice("line_depth", &features->line_depth, {"robust-fit", "end-points"},
                  "how a line gets its depth; mode pl-vo always takes end-points");
  list->Add("min_depth", &features->min_depth, {0.001, 1000},
            "metres; nearer measurements are not valid");
  list->Add("max_depth", &features->max_depth, {0.001, 1000},
            "metres; farther measurements are not valid");
}

void ListNormals(SurfaceNormalOptions* normals, OptionLister* list) {
  list->Add("grid_step", &normals->grid_step, {8, 1000}, "pixels between normals");
  list->Add("min_depth", &normals->min_depth, {0.001, 25},
            "metres; nearer measurements are not valid");
  list->Add("max_depth", &normals->max_depth, {0.001, 25},
            "metres; farther measurements are not valid");
}

}  // namespace msc_vo
