// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Records COUNT frames of the first camera of OpenNI2: oni_recorder FILE.oni COUNT

#include <cstdio>
#include <cstdlib>

#include <OpenNI.h>

namespace {

void Check(openni::Status status, const char* action) {
  if (status == openni::STATUS_OK) return;
  std::fprintf(stderr, "%s: %s\n", action, openni::OpenNI::getExtendedError());
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  Check(openni::OpenNI::initialize(), "initialize");
  openni::Device device;
  Check(device.open(openni::ANY_DEVICE), "open");
  device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  openni::VideoStream color, depth;
  Check(color.create(device, openni::SENSOR_COLOR), "color");
  Check(depth.create(device, openni::SENSOR_DEPTH), "depth");
  openni::Recorder recorder;
  Check(recorder.create(argv[1]), "create");
  Check(recorder.attach(color), "attach color");
  Check(recorder.attach(depth), "attach depth");
  Check(recorder.start(), "start");
  Check(color.start(), "start color");
  Check(depth.start(), "start depth");
  openni::VideoFrameRef frame;
  for (int i = 0; i < std::atoi(argv[2]); ++i) {
    Check(color.readFrame(&frame), "read color");
    Check(depth.readFrame(&frame), "read depth");
  }
  recorder.stop();
  recorder.destroy();
  frame.release();
  color.destroy();
  depth.destroy();
  device.close();
  openni::OpenNI::shutdown();
  return 0;
}
