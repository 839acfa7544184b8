// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/rendered_frames.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

/// The command line of `msc_vo synthesize`.
struct SynthesizeArguments {
  std::string folder;
  std::string scene = "room";
  std::string depth_sensor = "exact";
  int frames = 0;  ///< 0: 260, or until the end of a walk
  int stride = 1;
  int height = 0;  ///< pixels; 0: three quarters of the width
  ColorEncoding encoding;
  bool overwrite = false;
  bool json = false;
  std::vector<std::string> specular;          ///< names of surfaces
  std::vector<double> depth_offset;           ///< pixels, of ICL-NUIM's noise; empty: none
  std::vector<double> rig;                    ///< focal length, x, y, roll; empty: registered depth
  std::string lens;                           ///< MODEL:COEFFICIENTS; empty: none
  double turn_rate = 0.0;                     ///< degrees/second; 0: that of the path
  double depth_bias = -1.0;                   ///< metres; negative: that of the sensor
  double light = 0.0;                         ///< fraction; 0: no photon noise
  bool untold = false;                        ///< rig and lens are not in camera.txt
  double focal_length_error = 0.0;            ///< of camera.txt, per cent
  std::vector<double> principal_point_error;  ///< of camera.txt, pixels; empty: none
  std::map<std::string, std::string> values;  ///< of the options that change files, by name
  SyntheticSequenceOptions options;           ///< as far as an option sets it directly
};

/// Declares the arguments of `command`.
void AddSynthesizeArguments(CLI::App* command, SynthesizeArguments* arguments);

/// Returns the sequence that the arguments describe. Throws UsageError if it is impossible.
SyntheticSequenceOptions SequenceOptions(const SynthesizeArguments& arguments);

}  // namespace msc_vo
