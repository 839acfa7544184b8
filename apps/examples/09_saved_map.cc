// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A map that outlives a run. One camera builds and saves it; a second one walks back along the same
// path, finds itself in it and extends it; a third one finds itself in both, and changes nothing.
// Prints where the third one was found, and its largest error in the world of the map.

#include <algorithm>
#include <filesystem>
#include <string>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/odometry/localizer.h"

namespace {

constexpr int kNumImages = 60;

// The image that the second camera takes as its i-th one.
int Backwards(int i) { return kNumImages - 1 - i; }

msc_vo::RgbdImage GrabBackwards(const msc_vo::SimulatedCamera& camera, int i) {
  msc_vo::RgbdImage image = camera.Grab(Backwards(i));
  image.id = i;
  image.timestamp = i / 30.0;
  return image;
}

}  // namespace

int main() try {
  const msc_vo::SimulatedCamera camera(msc_vo::SceneKind::kRoom, kNumImages);
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const std::string path = (folder / "msc_vo_example.map").string();
  std::filesystem::remove(path);

  msc_vo::Odometry first({}, camera.camera(), {});
  for (int i = 0; i < kNumImages; ++i) first.Process(camera.Grab(i));
  if (auto maps = first.ShareMaps("first")) msc_vo::SaveMap(path, std::move(*maps));

  msc_vo::Odometry second({}, camera.camera(), {});
  second.SetMap(msc_vo::LoadMap(path));
  for (int i = 0; i < kNumImages; ++i) second.Process(GrabBackwards(camera, i));
  if (auto maps = second.ShareMaps("second")) msc_vo::SaveMap(path, std::move(*maps));

  msc_vo::Localizer third({}, camera.camera(), {}, msc_vo::LoadMap(path));
  std::filesystem::remove(path);
  int found = kNumImages;
  double largest = 0.0;
  for (int i = 0; i < kNumImages; ++i) {
    const msc_vo::FrameResult frame = third.Process(camera.Grab(i));
    if (!msc_vo::IsEstimated(frame.status)) continue;
    found = std::min(found, i);
    const Eigen::Vector3d difference =
        frame.cam_from_world.OriginInSource() - camera.CamFromWorld(i).OriginInSource();
    largest = std::max(largest, difference.norm());
  }
  if (found == kNumImages) {
    std::printf("never found in the map\n");
    return 1;
  }
  std::printf("found in the map at image %d, then at most %.1f mm from the truth\n", found,
              1000.0 * largest);
  return largest < 0.05 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
