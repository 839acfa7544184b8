// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

namespace ceres {
class CostFunction;
class LossFunction;
}  // namespace ceres

namespace msc_vo {

/// A residual block of the caller's own over the pose of a frame: any Ceres cost function
/// (automatic, analytic or numeric derivatives) with one parameter block of size 7, cam_from_world
/// as in Rigid3 (unit quaternion x, y, z, w, then translation, metres). Its residual must be
/// whitened, i.e. divided by its standard deviation.
struct PoseFactor {
  std::string name;  ///< for error messages
  std::shared_ptr<const ceres::CostFunction> cost;
  std::shared_ptr<const ceres::LossFunction> loss;  ///< null: none
};

}  // namespace msc_vo
