// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A control loop of 50 Hz with one thread, which places local mapping in the gaps between images:
//
//   07_mapping_in_gaps              a short simulated sequence
//   07_mapping_in_gaps FOLDER [N]   a sequence in any layout that msc_vo reads, N images: longer
//                                   than the sequence, it is played back and forth
//
// Prints the median and the 99th percentile of the processor time of Process() plus RunMapping()
// in a slot of 20 ms, and checks that the poses are those of a run that maps where it must wait.

#include <algorithm>
#include <ctime>
#include <functional>
#include <string>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence.h"

namespace {

constexpr double kSlot = 0.020;  // seconds between two images

double ProcessorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Input {
  msc_vo::PinholeCamera camera;
  msc_vo::LensDistortion distortion;
  int num_images = 0;
  std::function<msc_vo::RgbdImage(int)> grab;
};

// The image of each slot: forwards, backwards, forwards, ...
int BackAndForth(int slot, int num_images) {
  const int period = std::max(1, 2 * (num_images - 1));
  const int i = slot % period;
  return i < num_images ? i : period - i;
}

Input OpenFolder(const std::string& folder, int num_slots) {
  const msc_vo::SequenceIndex index = msc_vo::OpenSequence(folder);
  if (!index.calibration) throw std::runtime_error(folder + ": no calibration");
  const auto decoder = std::make_shared<msc_vo::RgbdDecoder>(index, *index.calibration);
  Input input;
  input.camera = decoder->calibration().camera;
  input.distortion = decoder->calibration().distortion;
  input.num_images = num_slots > 0 ? num_slots : decoder->size();
  input.grab = [decoder](int slot) { return decoder->Decode(BackAndForth(slot, decoder->size())); };
  return input;
}

struct Run {
  std::vector<double> slots;  // processor time, milliseconds
  msc_vo::OdometryResult result;
};

// `in_gaps`: maps in what is left of each slot; otherwise only where Process() has to wait.
Run Replay(const Input& input, bool in_gaps) {
  msc_vo::OdometryOptions options;
  options.threads = 1;
  options.external_mapping = true;
  msc_vo::Odometry odometry(options, input.camera, input.distortion);
  Run run;
  for (int i = 0; i < input.num_images; ++i) {
    msc_vo::RgbdImage image = input.grab(i);
    image.id = i;
    image.timestamp = kSlot * i;
    const double begin = ProcessorTime();
    odometry.Process(image);
    // A loop with other work takes the time that this work leaves.
    if (in_gaps) odometry.RunMapping(std::max(0.0, kSlot - (ProcessorTime() - begin)));
    run.slots.push_back(1000.0 * (ProcessorTime() - begin));
  }
  run.result = odometry.Finish();
  return run;
}

double Quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1))];
}

void Print(const char* name, const std::vector<double>& slots) {
  std::printf("%-28s median %5.1f ms, 99 %% %5.1f ms, longest %5.1f ms\n", name,
              Quantile(slots, 0.5), Quantile(slots, 0.99), Quantile(slots, 1.0));
  std::fflush(stdout);
}

bool HaveSamePoses(const msc_vo::OdometryResult& a, const msc_vo::OdometryResult& b) {
  for (size_t i = 0; i < a.frames.size(); ++i) {
    if (a.frames[i].cam_from_world.params != b.frames[i].cam_from_world.params) return false;
  }
  return a.frames.size() == b.frames.size();
}

}  // namespace

int main(int argc, char** argv) try {
  const msc_vo::SimulatedCamera simulated(msc_vo::SceneKind::kRoom, 60);
  Input input{simulated.camera(), {}, simulated.num_images(), [&simulated](int i) {
                return simulated.Grab(i);
              }};
  if (argc > 1) input = OpenFolder(argv[1], argc > 2 ? std::stoi(argv[2]) : 0);
  std::printf("%d images at 50 Hz\n", input.num_images);
  const Run in_gaps = Replay(input, true);
  Print("mapping in the gaps:", in_gaps.slots);
  const Run waiting = Replay(input, false);
  Print("mapping where it must wait:", waiting.slots);
  if (HaveSamePoses(waiting.result, in_gaps.result)) return 0;
  std::printf("the poses differ\n");
  return 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
