// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/python_cost_function.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <ceres/dynamic_numeric_diff_cost_function.h>

#include "apps/python/arrays.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// Calls with copies of the blocks: the callable may keep them.
py::object Call(const py::object& callable, const std::vector<int>& sizes,
                double const* const* parameters) {
  py::tuple blocks(sizes.size());
  for (size_t i = 0; i < sizes.size(); ++i) {
    blocks[i] = py::array_t<double>(sizes[i], parameters[i]);
  }
  return callable(*blocks);
}

// The functor of a cost function with numeric derivatives.
class NumericFunctor {
 public:
  NumericFunctor(SharedObject callable, int num_residuals, std::vector<int> sizes)
      : callable_(std::move(callable)), num_residuals_(num_residuals), sizes_(std::move(sizes)) {}

  bool operator()(double const* const* parameters, double* residuals) const {
    const py::gil_scoped_acquire gil;
    const py::object result = Call(callable_.get(), sizes_, parameters);
    if (result.is_none()) return false;
    CopyNumbers(result, "cost function: residuals", num_residuals_, -1, residuals);
    return true;
  }

 private:
  SharedObject callable_;
  int num_residuals_;
  std::vector<int> sizes_;
};

void CheckSizes(int num_residuals, const std::vector<int>& sizes) {
  const auto is_positive = [](int size) { return size > 0; };
  if (num_residuals < 1 || sizes.empty() || !std::all_of(sizes.begin(), sizes.end(), is_positive)) {
    throw std::invalid_argument(
        "cost function: num_residuals and every block size must be positive");
  }
}

}  // namespace

PythonCostFunction::PythonCostFunction(SharedObject callable, int num_residuals,
                                       const std::vector<int>& block_sizes)
    : callable_(std::move(callable)) {
  CheckSizes(num_residuals, block_sizes);
  set_num_residuals(num_residuals);
  *mutable_parameter_block_sizes() = {block_sizes.begin(), block_sizes.end()};
}

bool PythonCostFunction::Evaluate(double const* const* parameters, double* residuals,
                                  double** jacobians) const {
  const py::gil_scoped_acquire gil;
  const std::vector<int32_t>& sizes = parameter_block_sizes();
  const py::object result = Call(callable_.get(), {sizes.begin(), sizes.end()}, parameters);
  if (result.is_none()) return false;
  if (!py::isinstance<py::tuple>(result) || py::len(result) != 2) {
    throw std::invalid_argument(
        "cost function: expected the tuple (residuals, jacobians), or residuals alone with "
        "numeric=True");
  }
  const py::tuple pair = result;
  CopyNumbers(pair[0], "cost function: residuals", num_residuals(), -1, residuals);
  if (!py::isinstance<py::sequence>(pair[1])) {
    throw std::invalid_argument(
        "cost function: Jacobians: expected a list with one array per "
        "parameter block, not " +
        std::string(py::str(py::type::of(pair[1]))));
  }
  const py::sequence list = pair[1];
  if (list.size() != sizes.size()) {
    throw std::invalid_argument("cost function: expected " + std::to_string(sizes.size()) +
                                " Jacobians, one per parameter block, not " +
                                std::to_string(list.size()));
  }
  if (jacobians == nullptr) return true;
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (jacobians[i] == nullptr) continue;
    CopyNumbers(list[i], "cost function: Jacobian " + std::to_string(i), num_residuals(), sizes[i],
                jacobians[i]);
  }
  return true;
}

std::shared_ptr<const ceres::CostFunction> MakeNumericCostFunction(
    SharedObject callable, int num_residuals, const std::vector<int>& block_sizes) {
  CheckSizes(num_residuals, block_sizes);
  auto cost = std::make_shared<ceres::DynamicNumericDiffCostFunction<NumericFunctor>>(
      new NumericFunctor(std::move(callable), num_residuals, block_sizes));
  for (const int size : block_sizes) cost->AddParameterBlock(size);
  cost->SetNumResiduals(num_residuals);
  return cost;
}

}  // namespace msc_vo
