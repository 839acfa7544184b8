// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/factors.h"

#include <stdexcept>
#include <utility>

#include <ceres/loss_function.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/garbage_collection.h"
#include "apps/python/python_cost_function.h"
#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/factors/direction_prior.h"
#include "msc_vo/factors/gravity_direction.h"
#include "msc_vo/factors/pose_prior.h"
#include "msc_vo/factors/relative_pose.h"
#include "msc_vo/factors/unit_vector_manifold.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

Matrix6d CovarianceArgument(const py::object& value) {
  const Matrix6d covariance = MatrixArgument(value, "covariance", 6, 6);
  if (const char* error = CovarianceError(covariance)) {
    throw std::invalid_argument(std::string("covariance: ") + error);
  }
  return covariance;
}

double SigmaArgument(double sigma) {
  if (!(sigma > 0.0)) throw std::invalid_argument("sigma: must be positive");
  return sigma;
}

Eigen::Vector3d DirectionArgument(const py::object& value) {
  const Eigen::Vector3d direction = VectorArgument(value, "direction", 3);
  if (!(direction.norm() > 0.0)) throw std::invalid_argument("direction: must not be zero");
  return direction;
}

std::shared_ptr<const ceres::LossFunction> HuberLoss(const std::optional<double>& huber) {
  if (!huber) return nullptr;
  if (!(*huber > 0.0)) throw std::invalid_argument("huber: must be positive, or None");
  return std::make_shared<ceres::HuberLoss>(*huber);
}

[[noreturn]] void RefuseItems(py::handle found, const std::string& name, const char* expected) {
  throw std::invalid_argument(name + ": expected " + expected + " objects, not " +
                              std::string(py::repr(found)));
}

// The items of an iterable; none of None.
py::list ItemsOf(py::handle items, const std::string& name, const char* expected) {
  if (items.is_none()) return py::list();
  if (!py::isinstance<py::iterable>(items)) RefuseItems(items, name, expected);
  return py::list(py::reinterpret_borrow<py::iterable>(items));
}

// Residuals and Jacobians at the given blocks, None where the cost function is not defined.
py::object EvaluateCost(const PyCost& self, const py::args& blocks) {
  const std::vector<int32_t>& sizes = self.cost->parameter_block_sizes();
  if (blocks.size() != sizes.size()) {
    throw std::invalid_argument("expected " + std::to_string(sizes.size()) + " blocks, not " +
                                std::to_string(blocks.size()));
  }
  std::vector<Eigen::VectorXd> values;
  std::vector<RowMajorMatrix> jacobians;
  for (size_t i = 0; i < sizes.size(); ++i) {
    values.push_back(VectorArgument(blocks[i], "block " + std::to_string(i), sizes[i]));
    jacobians.emplace_back(self.cost->num_residuals(), sizes[i]);
  }
  std::vector<const double*> parameters;
  std::vector<double*> derivatives;
  for (size_t i = 0; i < sizes.size(); ++i) {
    parameters.push_back(values[i].data());
    derivatives.push_back(jacobians[i].data());
  }
  Eigen::VectorXd residuals(self.cost->num_residuals());
  if (!self.cost->Evaluate(parameters.data(), residuals.data(), derivatives.data())) {
    return py::none();
  }
  return py::make_tuple(residuals, jacobians);
}

PyCost MakePythonCost(const py::function& callable, int num_residuals,
                      const std::vector<int>& block_sizes, bool numeric) {
  const SharedObject shared(callable);
  if (numeric) return {MakeNumericCostFunction(shared, num_residuals, block_sizes), shared};
  return {std::make_shared<PythonCostFunction>(shared, num_residuals, block_sizes), shared};
}

void BindCosts(py::module_* module) {
  py::class_<PyCost>(*module, "CostFunction", CollectsGarbage<PyCost>(),
                     "A Ceres cost function. The Python callable gets the values of the parameter "
                     "blocks as arrays and returns (residuals, jacobians) with one Jacobian of "
                     "shape (num_residuals, block size) per block; with numeric=True residuals "
                     "only. It returns None where it is not defined; the solver then rejects its "
                     "step. Residuals are divided by their standard deviation. Poses are blocks of "
                     "7: quaternion x y z w and translation of cam_from_world.")
      .def(py::init(&MakePythonCost), py::arg("callable"), py::arg("num_residuals"),
           py::arg("block_sizes"), py::arg("numeric") = false)
      .def_property_readonly(
          "num_residuals", [](const PyCost& self) { return self.cost->num_residuals(); },
          "Number of residuals.")
      .def_property_readonly(
          "block_sizes", [](const PyCost& self) { return self.cost->parameter_block_sizes(); },
          "Number of values of each parameter block.")
      .def("evaluate", &EvaluateCost, "(residuals, jacobians) at the given blocks, or None.");
  module->def(
      "pose_prior",
      [](const py::object& cam_from_world, const py::object& covariance) {
        return PyCost{PosePrior::CreateShared(PoseArgument(cam_from_world, "cam_from_world"),
                                              CovarianceArgument(covariance))};
      },
      py::arg("cam_from_world"), py::arg("covariance"),
      "Prior on a pose (block 0). covariance: 6x6 of rotation vector in the camera frame "
      "(radians), then translation (metres).");
  module->def(
      "relative_pose",
      [](const py::object& b_from_a, const py::object& covariance) {
        return PyCost{RelativePose::CreateShared(PoseArgument(b_from_a, "b_from_a"),
                                                 CovarianceArgument(covariance))};
      },
      py::arg("b_from_a"), py::arg("covariance"),
      "Measured motion between the poses a (block 0) and b (block 1).");
  module->def(
      "scaled_relative_pose",
      [](const py::object& b_from_a, const py::object& covariance) {
        return PyCost{ScaledRelativePose::CreateShared(PoseArgument(b_from_a, "b_from_a"),
                                                       CovarianceArgument(covariance))};
      },
      py::arg("b_from_a"), py::arg("covariance"),
      "The same with an unknown scale of the translation: block 2, an extra block of size 1.");
  module->def(
      "gravity_direction",
      [](const py::object& direction, double sigma) {
        return PyCost{
            GravityDirection::CreateShared(DirectionArgument(direction), SigmaArgument(sigma))};
      },
      py::arg("direction"), py::arg("sigma"),
      "Measured vertical in the camera of a pose (block 0); the vertical in the world is block 1, "
      "an extra block with manifold 'sphere'. sigma: radians.");
  module->def(
      "direction_prior",
      [](const py::object& direction, double sigma) {
        return PyCost{
            DirectionPrior::CreateShared(DirectionArgument(direction), SigmaArgument(sigma))};
      },
      py::arg("direction"), py::arg("sigma"),
      "Prior on a unit vector (block 0), an extra block with manifold 'sphere'. sigma: radians.");
}

void BindBlocks(py::module_* module) {
  py::class_<BlockId>(*module, "BlockId", "A parameter block of a window by kind and id.")
      .def_static("pose", &BlockId::Pose, py::arg("keyframe"), "cam_from_world, size 7.")
      .def_static("point", &BlockId::Point, py::arg("point"), "Position, size 3.")
      .def_static("line", &BlockId::Line, py::arg("line"), "Both end points, size 6.")
      .def_static("axes", &BlockId::Axes, "Quaternion world_from_axes, size 4.")
      .def_static("extra", &BlockId::Extra, py::arg("id"), "An ExtraBlock.")
      .def("__repr__", [](const BlockId& self) {
        constexpr const char* kKinds[] = {"pose", "point", "line", "axes", "extra"};
        const std::string id = self.kind == BlockKind::kAxes ? "" : std::to_string(self.id);
        return "BlockId." + std::string(kKinds[static_cast<int>(self.kind)]) + "(" + id + ")";
      });
  py::class_<ExtraBlock>(*module, "ExtraBlock", "A parameter block of your own.")
      .def(py::init(&MakeExtraBlock), py::arg("id"), py::arg("value"),
           py::arg("manifold") = "euclidean", py::arg("fixed") = false,
           "manifold: 'euclidean', or 'sphere' for unit vectors of three numbers: ValueError on "
           "others. Covariances of a 'sphere' are 2x2, in radians^2.")
      .def_readonly("id", &ExtraBlock::id, "Id for BlockId.extra().")
      .def_property_readonly(
          "value", [](const ExtraBlock& self) { return self.value; }, "The initial value.")
      .def_property_readonly("manifold", &ManifoldName, "'euclidean' or 'sphere'.")
      .def_readonly("fixed", &ExtraBlock::fixed, "Whether the value is held constant.");
}

}  // namespace

ExtraBlock MakeExtraBlock(int64_t id, const py::object& value, const std::string& manifold,
                          bool fixed) {
  ExtraBlock block{id, VectorArgument(value, "value", -1), nullptr, fixed};
  if (manifold == "sphere") {
    if (block.value.size() != 3) {
      throw std::invalid_argument("value: manifold 'sphere' is for unit vectors of three numbers");
    }
    if (const char* error = UnitVectorError(block.value)) {
      throw std::invalid_argument(std::string("value: ") + error +
                                  ", as manifold 'sphere' needs: divide it by its length");
    }
    block.manifold = std::make_shared<UnitVectorManifold>();
  } else if (manifold != "euclidean") {
    throw std::invalid_argument("manifold: must be 'euclidean' or 'sphere', not '" + manifold +
                                "'");
  }
  return block;
}

const char* ManifoldName(const ExtraBlock& block) {
  return block.manifold == nullptr ? "euclidean" : "sphere";
}

FactorLists FactorsArgument(py::handle items, const std::string& name) {
  FactorLists lists;
  for (const py::handle item : ItemsOf(items, name, "CustomFactor and ExtraBlock")) {
    if (py::isinstance<CustomFactor>(item)) {
      lists.factors.push_back(item.cast<CustomFactor>());
    } else if (py::isinstance<ExtraBlock>(item)) {
      lists.extra_blocks.push_back(item.cast<ExtraBlock>());
    } else {
      RefuseItems(item, name, "CustomFactor and ExtraBlock");
    }
  }
  return lists;
}

std::vector<PoseFactor> PoseFactorsArgument(py::handle items, const std::string& name) {
  std::vector<PoseFactor> factors;
  for (const py::handle item : ItemsOf(items, name, "PoseFactor")) {
    if (!py::isinstance<PoseFactor>(item)) RefuseItems(item, name, "PoseFactor");
    factors.push_back(item.cast<PoseFactor>());
  }
  return factors;
}

void BindFactors(py::module_* module) {
  BindCosts(module);
  BindBlocks(module);
  py::class_<CustomFactor>(*module, "CustomFactor", "A cost function over blocks of a window.")
      .def(py::init([](const PyCost& cost, std::vector<BlockId> blocks,
                       const std::optional<double>& huber, const std::string& name) {
             return CustomFactor{name, cost.cost, HuberLoss(huber), std::move(blocks)};
           }),
           py::arg("cost"), py::arg("blocks"), py::arg("huber") = py::none(),
           py::arg("name") = "factor",
           "huber: threshold of a Huber loss in standard deviations; None: no loss. name: for "
           "error messages.")
      .def_readonly("name", &CustomFactor::name, "Name for error messages.")
      .def_readonly("blocks", &CustomFactor::blocks,
                    "The blocks of the window, one per parameter block of the cost function.");
  py::class_<PoseFactor>(*module, "PoseFactor", "A cost function over the pose of one frame.")
      .def(py::init(
               [](const PyCost& cost, const std::optional<double>& huber, const std::string& name) {
                 return PoseFactor{name, cost.cost, HuberLoss(huber)};
               }),
           py::arg("cost"), py::arg("huber") = py::none(), py::arg("name") = "factor",
           "cost: over one block, the pose. huber, name: as for CustomFactor.")
      .def_readonly("name", &PoseFactor::name, "Name for error messages.");
}

}  // namespace msc_vo
