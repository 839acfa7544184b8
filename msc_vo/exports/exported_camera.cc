// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/exported_camera.h"

#include <algorithm>

namespace msc_vo {

ExportedCamera ExportCamera(const CameraIntrinsics& intrinsics) {
  const LensDistortion& lens = intrinsics.distortion;
  const PinholeCamera& recorded = lens.Recorded(intrinsics.camera);
  ExportedCamera camera;
  camera.width = recorded.width;
  camera.height = recorded.height;
  camera.parameters = {recorded.fx, recorded.fy, recorded.cx + 0.5, recorded.cy + 0.5};
  size_t num_coefficients = 0;
  if (lens.model == LensModel::kFisheye) {
    camera.model = "OPENCV_FISHEYE";
    camera.model_id = 5;
    num_coefficients = 4;
  } else if (std::any_of(lens.k.begin() + 4, lens.k.end(), [](double k) { return k != 0.0; })) {
    camera.model = "FULL_OPENCV";
    camera.model_id = 6;
    num_coefficients = 8;
  } else if (std::any_of(lens.k.begin(), lens.k.end(), [](double k) { return k != 0.0; })) {
    camera.model = "OPENCV";
    camera.model_id = 4;
    num_coefficients = 4;
  } else {
    camera.model = "PINHOLE";
    camera.model_id = 1;
  }
  camera.parameters.insert(camera.parameters.end(), lens.k.begin(),
                           lens.k.begin() + static_cast<long>(num_coefficients));
  return camera;
}

Eigen::Vector2d ExportPixel(const CameraIntrinsics& intrinsics, const Eigen::Vector2d& pixel) {
  return (intrinsics.distortion.Distort(intrinsics.camera, pixel).array() + 0.5).matrix();
}

}  // namespace msc_vo
