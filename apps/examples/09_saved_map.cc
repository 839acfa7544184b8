// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A map that outlives a run: the first camera builds and saves it, the second one walks back along
// the same path and finds itself in it. Prints where, and its largest error in the world of the
// map.

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/odometry/localization.h"

namespace {

constexpr int kNumImages = 60;

// The image that the second camera takes as its i-th one.
int Backwards(int i) { return kNumImages - 1 - i; }

}  // namespace

int main() try {
  const msc_vo::SimulatedCamera camera(msc_vo::SceneKind::kRoom, kNumImages);
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "msc_vo_example.map";
  std::filesystem::remove(path);

  msc_vo::Odometry first({}, camera.camera(), {});
  for (int i = 0; i < kNumImages; ++i) first.Process(camera.Grab(i));
  if (auto maps = first.ShareMaps("first")) msc_vo::SaveMap(path.string(), std::move(*maps));

  msc_vo::Odometry second({}, camera.camera(), {});
  second.SetMap(msc_vo::LoadMap(path.string()));
  for (int i = 0; i < kNumImages; ++i) {
    msc_vo::RgbdImage image = camera.Grab(Backwards(i));
    image.id = i;
    image.timestamp = i / 30.0;
    second.Process(image);
  }
  const msc_vo::OdometryResult now = second.Finish();
  std::filesystem::remove(path);
  const std::optional<int> found = msc_vo::FirstLocalizedFrame(now);
  if (!found) {
    std::printf("never found in the map\n");
    return 1;
  }
  double largest = 0.0;
  for (int i = *found; i < kNumImages; ++i) {
    const Eigen::Vector3d difference = now.frames[i].cam_from_world.OriginInSource() -
                                       camera.CamFromWorld(Backwards(i)).OriginInSource();
    largest = std::max(largest, difference.norm());
  }
  std::printf("found in the map at image %d, then at most %.1f mm from the truth\n", *found,
              1000.0 * largest);
  return largest < 0.05 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
