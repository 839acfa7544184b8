// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdlib>
#include <random>
#include <vector>

#include "tests/support/rendered_images.h"

namespace msc_vo {

// A world, a camera, an odometry and faults that are drawn at random.
struct RandomWorld {
  SyntheticSequenceOptions sequence;
  OdometryOptions odometry;
  std::vector<RgbdImage> images;
};

template <typename T, size_t N>
T Choose(const T (&values)[N], std::mt19937* random) {
  return values[(*random)() % N];
}

// One image in ten has a fault.
inline void Disturb(std::mt19937* random, RgbdImage* image) {
  switch ((*random)() % 30) {
    case 0:
      return Cover(image);
    case 1:
      image->depth = cv::Mat(image->depth.rows, image->depth.cols, CV_32FC1, cv::Scalar(0));
      return;
    case 2:  // noise
      image->gray = image->gray.clone();
      for (int y = 0; y < image->gray.rows; ++y) {
        uint8_t* row = image->gray.ptr<uint8_t>(y);
        for (int x = 0; x < image->gray.cols; ++x) row[x] = static_cast<uint8_t>((*random)() >> 24);
      }
      return;
    default:
      return;
  }
}

inline RandomWorld DrawWorld(unsigned seed, int num_images) {
  std::mt19937 random(seed);
  RandomWorld world;
  SyntheticSequenceOptions& sequence = world.sequence;
  sequence.scene = Choose({SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kBare,
                           SceneKind::kSlanted, SceneKind::kHouse, SceneKind::kBox},
                          &random);
  sequence.seed = random() % 1000;
  sequence.width = Choose({160, 240, 320}, &random);
  sequence.height = sequence.width * 3 / 4;
  sequence.fps = Choose({2.0, 5.0, 15.0, 30.0}, &random);
  sequence.depth = Choose({SyntheticDepth::kExact, SyntheticDepth::kStructuredLight,
                           SyntheticDepth::kTimeOfFlight, SyntheticDepth::kStereo},
                          &random);
  sequence.readout_time = Choose({0.0, 0.02}, &random);
  sequence.image_sigma = Choose({0.0, 2.0, 6.0}, &random);
  sequence.path.shake = Choose({0.0, 1.0, 3.0}, &random);
  world.odometry.use_points = random() % 5 != 0;
  world.odometry.use_lines = !world.odometry.use_points || random() % 5 != 0;
  world.images = RenderImages(sequence, num_images);
  for (RgbdImage& image : world.images) Disturb(&random, &image);
  return world;
}

// A number of the environment for long runs.
inline unsigned NumberFromEnvironment(const char* name, unsigned in_a_short_run) {
  const char* number = std::getenv(name);
  return number == nullptr ? in_a_short_run : static_cast<unsigned>(std::atoi(number));
}

// The first world, the number of worlds, and the number of images of each:
// MSC_VO_FIRST_WORLD=241 MSC_VO_RANDOM_WORLDS=400 MSC_VO_RANDOM_IMAGES=90.
inline unsigned FirstRandomWorld() { return NumberFromEnvironment("MSC_VO_FIRST_WORLD", 1); }
inline unsigned NumRandomWorlds(unsigned in_a_short_run) {
  return NumberFromEnvironment("MSC_VO_RANDOM_WORLDS", in_a_short_run);
}
inline int NumRandomImages(unsigned in_a_short_run) {
  return static_cast<int>(NumberFromEnvironment("MSC_VO_RANDOM_IMAGES", in_a_short_run));
}

}  // namespace msc_vo
