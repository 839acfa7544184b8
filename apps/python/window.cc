// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/factors.h"
#include "apps/python/option_table.h"
#include "apps/python/window_arrays.h"
#include "msc_vo/bundle_adjustment/window_covariance.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

BundleAdjustmentOptions OptionsOf(const WindowOptionsTable* options) {
  return options ? options->window() : BundleAdjustmentOptions();
}

// Solves a copy, so that other threads may read the window meanwhile.
BundleAdjustmentSummary Solve(const std::shared_ptr<WindowData>& window,
                              const WindowOptionsTable* options) {
  const BundleAdjustmentOptions values = OptionsOf(options);
  WindowData copy = *window;
  BundleAdjustmentSummary summary;
  {
    const py::gil_scoped_release release;
    summary = LocalBundleAdjustment(values, &copy);
  }
  *window = std::move(copy);
  return summary;
}

// Covariances by id; those that the window does not determine are None.
template <typename Matrix>
py::dict ById(const std::vector<int64_t>& ids,
              const std::vector<std::optional<Matrix>>& covariances) {
  py::dict dict;
  for (size_t i = 0; i < ids.size(); ++i) {
    dict[py::int_(ids[i])] =
        covariances[i] ? py::cast(RowMajorMatrix(*covariances[i])) : py::object(py::none());
  }
  return dict;
}

py::dict Covariances(const std::shared_ptr<WindowData>& window, const WindowOptionsTable* options,
                     const py::object& keyframes, const py::object& points, const py::object& lines,
                     const py::object& extra_blocks) {
  const CovarianceSelection selection{
      IdsArgument(keyframes, "keyframes", -1), IdsArgument(points, "points", -1),
      IdsArgument(lines, "lines", -1), IdsArgument(extra_blocks, "extra_blocks", -1)};
  const BundleAdjustmentOptions values = OptionsOf(options);
  const WindowData copy = *window;
  WindowCovariance covariance;
  {
    const py::gil_scoped_release release;
    covariance = EstimateCovariance(values, copy, selection);
  }
  py::dict result;
  result["keyframes"] = ById(selection.keyframes, covariance.keyframes);
  result["points"] = ById(selection.points, covariance.points);
  result["lines"] = ById(selection.lines, covariance.lines);
  result["extra_blocks"] = ById(selection.extra_blocks, covariance.extra_blocks);
  return result;
}

py::dict TermsOf(const BundleAdjustmentSummary& summary) {
  py::dict terms;
  for (const auto& [name, term] : summary.Terms()) {
    py::dict fields;
    fields["num_residual_blocks"] = term->num_residual_blocks;
    fields["num_rejected"] = term->num_rejected;
    fields["initial_cost"] = term->initial_cost;
    fields["final_cost"] = term->final_cost;
    terms[py::str(name)] = fields;
  }
  return terms;
}

void SetAxes(WindowData* window, const py::object& world_from_axes, bool fixed) {
  RowMajorMatrix pose = RowMajorMatrix::Identity(4, 4);
  pose.topLeftCorner<3, 3>() = MatrixArgument(world_from_axes, "world_from_axes", 3, 3);
  window->axes = {Eigen::Quaterniond(PoseArgument(py::cast(pose), "world_from_axes").rotation()),
                  fixed};
}

void AddFactors(WindowData* window, const py::object& items) {
  const FactorLists lists = FactorsArgument(items, "items");
  window->custom_factors.insert(window->custom_factors.end(), lists.factors.begin(),
                                lists.factors.end());
  window->extra_blocks.insert(window->extra_blocks.end(), lists.extra_blocks.begin(),
                              lists.extra_blocks.end());
}

void SetKeyframeFixed(WindowData* window, int64_t keyframe, bool fixed) {
  for (WindowData::Keyframe& candidate : window->keyframes) {
    if (candidate.id != keyframe) continue;
    candidate.fixed = fixed;
    return;
  }
  throw std::invalid_argument("keyframe: " + std::to_string(keyframe) + " is not in the window");
}

py::list PosePriorsOf(const WindowData& window) {
  py::list priors;
  for (const WindowData::PosePrior& prior : window.pose_priors) {
    py::dict fields;
    fields["keyframe"] = prior.keyframe;
    fields["cam_from_world"] = PoseMatrix(prior.cam_from_world);
    fields["covariance"] = RowMajorMatrix(prior.covariance);
    priors.append(fields);
  }
  return priors;
}

py::dict ExtraBlocksOfWindow(const WindowData& window) {
  py::dict blocks;
  for (const ExtraBlock& block : window.extra_blocks) blocks[py::int_(block.id)] = block.value;
  return blocks;
}

std::string DescribeWindow(const WindowData& window) {
  return FormatText("<WindowData: %zu keyframes, %zu points, %zu lines>", window.keyframes.size(),
                    window.points.size(), window.lines.size());
}

using WindowClass = py::class_<WindowData, std::shared_ptr<WindowData>>;

void BindAdders(WindowClass* window) {
  const py::none none;
  window->def("add_keyframes", &AddKeyframes, py::arg("ids"), py::arg("cam_from_world"),
              py::arg("fixed") = none, "cam_from_world: (N, 4, 4). fixed: held constant.");
  window->def("add_points", &AddPoints, py::arg("ids"), py::arg("positions"),
              py::arg("fixed") = none, py::arg("noise") = 1.0,
              "positions: (N, 3), metres, world. noise: factor on the sigmas of its observations, "
              "one number or N.");
  window->def("add_lines", &AddLines, py::arg("ids"), py::arg("segments"), py::arg("fixed") = none,
              py::arg("noise") = 1.0, py::arg("depth_offsets") = 0.0,
              "segments: (N, 6), start and end, metres, world. noise: as for points. "
              "depth_offsets: measured minus true depth in all observations of a line, metres.");
  window->def("add_point_observations", &AddPointObservations, py::arg("keyframes"),
              py::arg("points"), py::arg("pixels"), py::arg("sigmas") = 1.0,
              py::arg("inverse_depths") = 0.0, py::arg("inverse_depth_sigmas") = 0.0,
              "pixels: (N, 2), undistorted. sigmas: pixels. inverse_depths: 1/metres, 0: not "
              "measured. Sigmas and depths: one number or N.");
  window->def("add_line_observations", &AddLineObservations, py::arg("keyframes"), py::arg("lines"),
              py::arg("segments"), py::arg("sigmas") = 1.0, py::arg("inverse_depths") = none,
              py::arg("depth_covariances") = none,
              "segments: (N, 4), undistorted end points. inverse_depths: (N, 2) at the end points, "
              "with covariances (N, 2, 2); rows of nan: not measured.");
  window->def(
      "add_parallel_pairs",
      [](WindowData* self, const py::object& a, const py::object& b, const py::object& sigmas,
         const py::object& counts) { AddLinePairs(&self->parallel_pairs, a, b, sigmas, counts); },
      py::arg("a"), py::arg("b"), py::arg("sigmas") = 0.03, py::arg("counts") = none,
      "Pairs of lines; sigmas of the angle in radians; counts: keyframes that observe both.");
  window->def(
      "add_perpendicular_pairs",
      [](WindowData* self, const py::object& a, const py::object& b, const py::object& sigmas,
         const py::object& counts) {
        AddLinePairs(&self->perpendicular_pairs, a, b, sigmas, counts);
      },
      py::arg("a"), py::arg("b"), py::arg("sigmas") = 0.03, py::arg("counts") = none,
      "The same for perpendicular lines.");
  window->def("add_axis_alignments", &AddAxisAlignments, py::arg("lines"), py::arg("axes"),
              py::arg("sigmas") = 0.03, "axes: (N, 3) unit vectors, world. sigmas: radians.");
  window->def("add_pose_prior", &AddPosePrior, py::arg("keyframe"), py::arg("cam_from_world"),
              py::arg("covariance"),
              "covariance: 6x6 of rotation vector (radians, camera frame), translation (metres).");
  window->def("set_axes", &SetAxes, py::arg("world_from_axes"), py::arg("fixed") = true,
              "The Manhattan axes, a block of custom factors: 3x3 rotation.");
  window->def("add", &AddFactors, py::arg("items"), "CustomFactor and ExtraBlock objects.");
}

void BindState(WindowClass* window) {
  (*window)
      .def_readonly("camera", &WindowData::camera, "Camera of all keyframes.")
      .def_property_readonly("keyframe_ids",
                             ColumnGetter(&WindowData::keyframes, &WindowData::Keyframe::id),
                             "(N,) ids in the order of the other arrays of keyframes.")
      .def_property_readonly("cam_from_world", &PosesOf, "(N, 4, 4) poses of the keyframes.")
      .def_property_readonly("keyframe_fixed",
                             ColumnGetter(&WindowData::keyframes, &WindowData::Keyframe::fixed),
                             "(N,) whether each keyframe is held constant.")
      .def("set_keyframe_fixed", &SetKeyframeFixed, py::arg("keyframe"), py::arg("fixed") = true,
           "Holds a keyframe constant, or not.")
      .def_property_readonly("point_ids", ColumnGetter(&WindowData::points, &WindowData::Point::id),
                             "(N,) ids in the order of points.")
      .def_property_readonly("points", &PointsOf, "(N, 3) metres, world.")
      .def_property_readonly("point_fixed",
                             ColumnGetter(&WindowData::points, &WindowData::Point::fixed),
                             "(N,) whether each point is held constant.")
      .def_property_readonly("point_noise",
                             ColumnGetter(&WindowData::points, &WindowData::Point::noise),
                             "(N,) factors on the sigmas of the observations of each point.")
      .def_property_readonly("line_ids", ColumnGetter(&WindowData::lines, &WindowData::Line::id),
                             "(N,) ids in the order of lines.")
      .def_property_readonly("lines", &LinesOf, "(N, 6) start and end, metres, world.")
      .def_property_readonly("line_fixed",
                             ColumnGetter(&WindowData::lines, &WindowData::Line::fixed),
                             "(N,) whether each line is held constant.")
      .def_property_readonly("line_noise",
                             ColumnGetter(&WindowData::lines, &WindowData::Line::noise),
                             "(N,) factors on the sigmas of the observations of each line.")
      .def_property_readonly(
          "line_depth_offsets", ColumnGetter(&WindowData::lines, &WindowData::Line::depth_offset),
          "(N,) metres, measured minus true depth in all observations of each line.")
      .def_property_readonly(
          "world_from_axes",
          [](const WindowData& self) -> std::optional<Eigen::Matrix3d> {
            if (!self.axes) return std::nullopt;
            return self.axes->world_from_axes.toRotationMatrix();
          },
          "3x3 rotation of set_axes(); None without.")
      .def_property_readonly("extra_blocks", &ExtraBlocksOfWindow,
                             "Values of the extra blocks by id.");
}

void BindMeasurements(WindowClass* window) {
  (*window)
      .def_property_readonly(
          "point_observations",
          [](const WindowData& self) { return PointObservationArrays(self.point_observations); },
          "The arguments of add_point_observations() as a dict of arrays.")
      .def_property_readonly(
          "line_observations",
          [](const WindowData& self) { return LineObservationArrays(self.line_observations); },
          "The arguments of add_line_observations() as a dict of arrays; depths that are not "
          "measured are nan.")
      .def_property_readonly(
          "parallel_pairs",
          [](const WindowData& self) { return LinePairArrays(self.parallel_pairs); },
          "The arguments of add_parallel_pairs() as a dict of arrays.")
      .def_property_readonly(
          "perpendicular_pairs",
          [](const WindowData& self) { return LinePairArrays(self.perpendicular_pairs); },
          "The arguments of add_perpendicular_pairs() as a dict of arrays.")
      .def_property_readonly(
          "axis_alignments",
          [](const WindowData& self) { return AxisAlignmentArrays(self.axis_alignments); },
          "The arguments of add_axis_alignments() as a dict of arrays.")
      .def_property_readonly("pose_priors", &PosePriorsOf,
                             "A dict with the arguments of add_pose_prior() for each prior.")
      .def_property_readonly(
          "point_observation_rejected",
          ColumnGetter(&WindowData::point_observations, &WindowData::PointObservation::rejected),
          "Whether the solver took each observation for an outlier.")
      .def_property_readonly(
          "point_depth_rejected",
          ColumnGetter(&WindowData::point_observations,
                       &WindowData::PointObservation::depth_rejected),
          "Whether the solver took only the depth of each observation for an outlier.")
      .def_property_readonly(
          "line_observation_rejected",
          ColumnGetter(&WindowData::line_observations, &WindowData::LineObservation::rejected),
          "point_observation_rejected for the observations of lines.")
      .def_property_readonly("line_depth_rejected",
                             ColumnGetter(&WindowData::line_observations,
                                          &WindowData::LineObservation::depth_rejected),
                             "point_depth_rejected for the observations of lines.")
      .def_property_readonly(
          "parallel_rejected",
          ColumnGetter(&WindowData::parallel_pairs, &WindowData::LinePair::rejected),
          "Whether the solver took each pair of parallel lines for an outlier.")
      .def_property_readonly(
          "perpendicular_rejected",
          ColumnGetter(&WindowData::perpendicular_pairs, &WindowData::LinePair::rejected),
          "The same for pairs of perpendicular lines.")
      .def_property_readonly(
          "axis_alignment_rejected",
          ColumnGetter(&WindowData::axis_alignments, &WindowData::AxisAlignment::rejected),
          "The same for lines along an axis.");
}

void BindSummary(py::module_* module) {
  py::class_<BundleAdjustmentSummary>(*module, "WindowSummary", "What solve_window did.")
      .def_readonly("usable", &BundleAdjustmentSummary::usable,
                    "False: the solver failed and the window is unchanged.")
      .def_readonly("num_iterations", &BundleAdjustmentSummary::num_iterations,
                    "Steps of both solves.")
      .def_readonly("num_accepted", &BundleAdjustmentSummary::num_accepted,
                    "Steps that were taken, because they decreased the cost.")
      .def_readonly("initial_cost", &BundleAdjustmentSummary::initial_cost,
                    "Half the sum of robust squares before the first solve.")
      .def_readonly("final_cost", &BundleAdjustmentSummary::final_cost,
                    "The same after the second solve, without outliers.")
      .def_readonly("undetermined_keyframes", &BundleAdjustmentSummary::undetermined_keyframes,
                    "Ids of keyframes that the inliers do not determine, with consensus.enabled.")
      .def_readonly("undetermined_points", &BundleAdjustmentSummary::undetermined_points,
                    "The same for points.")
      .def_readonly("undetermined_lines", &BundleAdjustmentSummary::undetermined_lines,
                    "The same for lines.")
      .def_readonly("message", &BundleAdjustmentSummary::message, "Why the solver ended.")
      .def_property_readonly("terms", &TermsOf,
                             "Residual blocks, rejections and costs of every term.")
      .def("report", &BundleAdjustmentSummary::BriefReport, "Text of several lines.")
      .def("__repr__", [](const BundleAdjustmentSummary& self) {
        return FormatText("<WindowSummary: cost %.6g -> %.6g in %d iterations%s>",
                          self.initial_cost, self.final_cost, self.num_iterations,
                          self.usable ? "" : ", failed");
      });
}

void BindFiles(py::module_* module) {
  module->def(
      "read_window",
      [](const py::object& path) {
        RecordedWindow window = ReadWindow(PathArgument(path));
        return py::make_tuple(std::make_shared<WindowData>(std::move(window.data)),
                              WindowOptionsTable(window.options));
      },
      py::arg("path"), "The window and the options of a window file (docs/window_file.md).");
  module->def(
      "write_window",
      [](const py::object& path, const WindowData& window, const WindowOptionsTable* options) {
        WriteWindow(PathArgument(path), OptionsOf(options), window);
      },
      py::arg("path"), py::arg("window"), py::arg("options") = py::none(),
      "Writes a window file, without custom factors.");
}

}  // namespace

void BindWindow(py::module_* module) {
  WindowClass window(*module, "WindowData",
                     "Input and output of local bundle adjustment. Ids are your own.");
  window.def(py::init([](const PinholeCamera& camera) {
               auto data = std::make_shared<WindowData>();
               data->camera = camera;
               return data;
             }),
             py::arg("camera"), "A window without keyframes.");
  window.def("__repr__", &DescribeWindow);
  BindAdders(&window);
  BindState(&window);
  BindMeasurements(&window);
  BindSummary(module);
  BindFiles(module);
  module->def(
      "solve_window", &Solve, py::arg("window").none(false), py::arg("options") = py::none(),
      "Local bundle adjustment: refines the window in place. Raises ValueError that names "
      "the offending item, and exceptions of cost functions as they are; the window is then "
      "unchanged.");
  module->def("window_covariance", &Covariances, py::arg("window").none(false),
              py::arg("options") = py::none(), py::kw_only(), py::arg("keyframes") = py::tuple(),
              py::arg("points") = py::tuple(), py::arg("lines") = py::tuple(),
              py::arg("extra_blocks") = py::tuple(),
              "Covariances of a solved window for the given ids, as dictionaries by kind and id; "
              "None where the window does not determine an item.");
}

}  // namespace msc_vo
