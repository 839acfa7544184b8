// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListPoints(PointExtractorOptions* points, OptionLister* list) {
  list->Add("num_points", &points->num_points, {0, 20000, "points"},
            "Largest number of points per image.")
      .MakeBasic(
          "Increase for long trajectories or scenes with little texture, decrease to save time.");
  list->Add("num_levels", &points->num_levels, {1, 32, "levels"},
            "Number of levels of the image pyramid.");
  list->Add("fast_threshold", &points->fast_threshold, {1, 255, "grey values"},
            "Contrast threshold of FAST corners.");
  list->Add("min_fast_threshold", &points->min_fast_threshold, {1, 255, "grey values"},
            "Contrast threshold in image cells without a corner at fast_threshold.");
}

void ListLines(LineExtractorOptions* lines, OptionLister* list) {
  list->AddChoice("detector", &lines->detector, {"lsd", "edge-drawing"},
                  "Line segment detector: LSD, as in the paper, or edge drawing, which is several "
                  "times faster.")
      .MakeBasic("Choose lsd to reproduce the paper.");
  list->Add("max_lines", &lines->max_lines, {0, 10000, "lines"},
            "Largest number of lines per image; the longest are kept.")
      .MakeBasic("Decrease to save time.");
  list->Add("min_length", &lines->min_length, {0.001, 1},
            "Smallest length of a line, as a fraction of the image's shorter side.");
}

void ListNoise(SensorNoiseOptions* noise, OptionLister* list) {
  list->Add("inverse_depth_sigma", &noise->inverse_depth_sigma, {1e-6, 1, "per metre"},
            "Initial standard deviation of inverse depth, systematic errors included.")
      .MakeBasic("Set it for a depth sensor that is much better or worse than a Kinect.");
  list->Add("inverse_depth_noise", &noise->inverse_depth_noise, {1e-6, 1, "per metre"},
            "Standard deviation of the random part of inverse depth, for the detection of outliers "
            "and depth edges within one image.");
  list->Add("point_sigma", &noise->point_sigma, {0.001, 100, "pixels"},
            "Standard deviation of a point on pyramid level 0.")
      .MakeBasic("Increase for blurred or strongly compressed images.");
  list->Add("line_sigma", &noise->line_sigma, {0.001, 100, "pixels"},
            "Initial standard deviation of a segment's end point across the line.");
}

}  // namespace

void ListFeatures(FrameBuilderOptions* features, OptionLister* list) {
  // Below the largest depth that surface normals can be estimated at (NormalOptions).
  constexpr double kLargestMinDepth = 20.0;
  list->Add("min_depth", &features->min_depth, {0.001, kLargestMinDepth, "metres"},
            "Smallest valid depth.")
      .MakeBasic("Set it to the range of the depth sensor.");
  list->Add("max_depth", &features->max_depth, {0.001, 1000, "metres"}, "Largest valid depth.")
      .MakeBasic("Set it to the range of the depth sensor.");
  list->AddChoice("depth_sensor", &features->depth_sensor,
                  {"auto", "structured-light", "tof", "stereo", "lidar"},
                  "Depth sensor, whose noise and artefacts are modelled. auto: chosen from the "
                  "first depth images.")
      .MakeBasic("Set it if the log names another sensor than yours.");
  list->AddChoice("line_depth", &features->line_depth, {"robust-fit", "end-points"},
                  "Depth of a line: robust fit to all depth samples along it, or the depths of its "
                  "end points. Mode pl-vo always uses end-points.");
  list->Section("points", &features->points, ListPoints);
  list->Section("lines", &features->lines, ListLines);
  list->Section("noise", &features->noise, ListNoise);
}

}  // namespace msc_vo
