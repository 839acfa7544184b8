// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/bindings.h"
#include "apps/python/factors.h"
#include "apps/python/option_table.h"
#include "apps/python/value_fields.h"
#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/checkpoint/fields.h"
#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// A value has a state, a tuple of plain Python objects that it can be made from again, and a key,
// which equal values have in common.

template <typename T>
py::bytes Encode(const T& value) {
  ObjectJournal journal;
  BinaryWriter archive(&journal);
  FieldsOf(archive, const_cast<T&>(value));  // a writer changes nothing
  return archive.bytes();
}

template <typename T>
T Decode(const std::string& bytes) {
  ObjectJournal journal;
  BinaryReader archive(bytes, &journal);
  T value;
  FieldsOf(archive, value);
  archive.Finish();
  return value;
}

// The binary form of one version may be another one's of something else.
template <typename T>
py::tuple VersionedState(const T& value) {
  return py::make_tuple(kVersion, Encode(value));
}

void CheckVersion(const py::tuple& state) {
  const std::string version = state[0].cast<std::string>();
  if (version == kVersion) return;
  throw std::invalid_argument("pickled by msc_vo " + version + ", which this version, " + kVersion +
                              ", cannot read; read it with that version");
}

template <typename T>
T FromVersionedState(const py::tuple& state) {
  CheckVersion(state);
  return Decode<T>(state[1].cast<std::string>());
}

// Measured times differ between runs with the same results.
FrameResult WithoutTimes(FrameResult frame) {
  frame.times = {};
  return frame;
}

OdometryResult WithoutTimes(OdometryResult result) {
  for (FrameResult& frame : result.frames) frame.times = {};
  return result;
}

// Values that do not change have a hash.
enum class Hash { kOfKey, kNone };

template <typename T, typename Holder, typename State, typename FromState, typename Key>
void DefineValue(const py::module_& module, const char* name, Hash hash, State state,
                 FromState from_state, Key key) {
  py::class_<T, Holder> type(module.attr(name));
  type.def(py::pickle([state](const T& self) -> py::tuple { return state(self); },
                      [from_state](const py::tuple& tuple) -> T { return from_state(tuple); }))
      .def("__copy__", [](const T& self) { return T(self); })
      .def(
          "__deepcopy__", [](const T& self, const py::dict& /*memo*/) { return T(self); },
          py::arg("memo"))
      .def(
          "__eq__",
          [key](const T& self, const T& other) -> bool { return key(self).equal(key(other)); },
          py::is_operator());
  if (hash == Hash::kOfKey) {
    type.def("__hash__", [key](const T& self) { return py::hash(key(self)); });
  } else {
    type.attr("__hash__") = py::none();
  }
}

template <typename T, typename Holder = std::unique_ptr<T>>
void DefineBinaryValue(const py::module_& module, const char* name) {
  DefineValue<T, Holder>(module, name, Hash::kOfKey, &VersionedState<T>, &FromVersionedState<T>,
                         &Encode<T>);
}

// The states of these types are written by hand: a structured binding or CheckFieldCount() fails to
// compile if a member is added, so that none is left out.

py::tuple CameraState(const PinholeCamera& camera) {
  const auto& [fx, fy, cx, cy, width, height] = camera;
  return py::make_tuple(fx, fy, cx, cy, width, height);
}

PinholeCamera CameraFromState(const py::tuple& state) {
  return {state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(),
          state[3].cast<double>(), state[4].cast<int>(),    state[5].cast<int>()};
}

py::tuple LensState(const LensDistortion& lens) {
  CheckFieldCount<3>(lens);
  py::object recorded = py::none();
  if (lens.recorded) recorded = CameraState(*lens.recorded);
  return py::make_tuple(LensModelName(lens.model), py::tuple(py::cast(lens.Coefficients())),
                        recorded);
}

LensDistortion LensFromState(const py::tuple& state) {
  LensDistortion lens;
  lens.model = *LensModelFromName(state[0].cast<std::string>());
  const auto coefficients = state[1].cast<std::vector<double>>();
  std::copy(coefficients.begin(), coefficients.end(), lens.k.begin());
  if (!state[2].is_none()) lens.recorded = CameraFromState(state[2]);
  return lens;
}

template <typename Table>
py::dict ValuesOf(const Table& table) {
  py::dict values;
  for (const std::string& name : table.Names()) values[py::str(name)] = table.Get(name);
  return values;
}

template <typename Table>
void DefineTable(const py::module_& module, const char* name) {
  DefineValue<Table, std::unique_ptr<Table>>(
      module, name, Hash::kNone, [](const Table& table) { return py::make_tuple(ValuesOf(table)); },
      [](const py::tuple& state) {
        Table table;
        for (const auto& [option, value] : py::dict(state[0])) {
          table.Set(option.template cast<std::string>(), value);
        }
        return table;
      },
      [](const Table& table) -> py::object { return ValuesOf(table); });
}

py::tuple MatState(const cv::Mat& image) {
  const cv::Mat dense = image.isContinuous() ? image : image.clone();
  return py::make_tuple(
      dense.rows, dense.cols, dense.type(),
      py::bytes(dense.ptr<char>(), dense.total() * (dense.empty() ? 0 : dense.elemSize())));
}

cv::Mat MatFromState(const py::tuple& state) {
  cv::Mat image(state[0].cast<int>(), state[1].cast<int>(), state[2].cast<int>());
  const auto bytes = state[3].cast<std::string>();
  std::copy(bytes.begin(), bytes.end(), image.data);
  return image;
}

py::tuple ImageState(const RgbdImage& image) {
  const auto& [id, timestamp, gray, depth, depth_delay, depth_velocity, recorded_depth, mask] =
      image;
  return py::make_tuple(id, timestamp, depth_delay, MatState(gray), MatState(depth),
                        MatState(recorded_depth), Encode(depth_velocity), MatState(mask));
}

RgbdImage ImageFromState(const py::tuple& state) {
  RgbdImage image;
  image.id = state[0].cast<int64_t>();
  image.timestamp = state[1].cast<double>();
  image.depth_delay = state[2].cast<double>();
  image.gray = MatFromState(state[3]);
  image.depth = MatFromState(state[4]);
  image.recorded_depth = MatFromState(state[5]);
  image.depth_velocity = Decode<std::optional<CameraVelocity>>(state[6].cast<std::string>());
  image.mask = MatFromState(state[7]);
  return image;
}

py::tuple BlockState(const ExtraBlock& block) {
  CheckFieldCount<4>(block);
  return py::make_tuple(block.id, py::tuple(py::cast(block.value).attr("tolist")()),
                        ManifoldName(block), block.fixed);
}

ExtraBlock BlockFromState(const py::tuple& state) {
  return MakeExtraBlock(state[0].cast<int64_t>(), state[1], state[2].cast<std::string>(),
                        state[3].cast<bool>());
}

py::list BlockStates(const WindowData& window) {
  py::list states;
  for (const ExtraBlock& block : window.extra_blocks) states.append(BlockState(block));
  return states;
}

py::tuple WindowState(const WindowData& window) {
  if (!window.custom_factors.empty()) {
    throw py::type_error(
        "cannot pickle a WindowData with custom factors: pickle it before they "
        "are added");
  }
  return py::make_tuple(kVersion, Encode(window), BlockStates(window));
}

WindowData WindowFromState(const py::tuple& state) {
  auto window = FromVersionedState<WindowData>(state);
  for (const py::handle block : py::list(state[2])) {
    window.extra_blocks.push_back(BlockFromState(py::reinterpret_borrow<py::tuple>(block)));
  }
  return window;
}

// Custom factors are equal if they share the cost function.
py::object WindowKey(const WindowData& window) {
  py::list factors;
  for (const CustomFactor& factor : window.custom_factors) {
    CheckFieldCount<4>(factor);
    factors.append(py::make_tuple(factor.name, reinterpret_cast<uintptr_t>(factor.cost.get()),
                                  reinterpret_cast<uintptr_t>(factor.loss.get()), factor.blocks));
  }
  return py::make_tuple(Encode(window), BlockStates(window), factors);
}

void DefineInputs(const py::module_& module) {
  DefineValue<PinholeCamera, std::unique_ptr<PinholeCamera>>(
      module, "Camera", Hash::kOfKey, &CameraState, &CameraFromState, &CameraState);
  DefineValue<LensDistortion, std::unique_ptr<LensDistortion>>(
      module, "Lens", Hash::kOfKey, &LensState, &LensFromState, &LensState);
  DefineBinaryValue<DepthCamera>(module, "DepthCamera");
  DefineTable<OptionsTable>(module, "Options");
  DefineTable<WindowOptionsTable>(module, "WindowOptions");
  DefineValue<RgbdImage, std::shared_ptr<RgbdImage>>(module, "RgbdImage", Hash::kOfKey, &ImageState,
                                                     &ImageFromState, &ImageState);
  const auto block_id = [](const BlockId& id) {
    CheckFieldCount<2>(id);
    return py::make_tuple(static_cast<int>(id.kind), id.id);
  };
  DefineValue<BlockId, std::unique_ptr<BlockId>>(
      module, "BlockId", Hash::kOfKey, block_id,
      [](const py::tuple& state) {
        return BlockId{static_cast<BlockKind>(state[0].cast<int>()), state[1].cast<int64_t>()};
      },
      block_id);
  DefineValue<ExtraBlock, std::unique_ptr<ExtraBlock>>(module, "ExtraBlock", Hash::kOfKey,
                                                       &BlockState, &BlockFromState, &BlockState);
  DefineValue<WindowData, std::shared_ptr<WindowData>>(module, "WindowData", Hash::kNone,
                                                       &WindowState, &WindowFromState, &WindowKey);
}

void DefineResults(const py::module_& module) {
  DefineValue<FrameResult, std::unique_ptr<FrameResult>>(
      module, "FrameResult", Hash::kOfKey, &VersionedState<FrameResult>,
      &FromVersionedState<FrameResult>,
      [](const FrameResult& self) { return Encode(WithoutTimes(self)); });
  DefineValue<OdometryResult, std::shared_ptr<OdometryResult>>(
      module, "Result", Hash::kOfKey, &VersionedState<OdometryResult>,
      &FromVersionedState<OdometryResult>,
      [](const OdometryResult& self) { return Encode(WithoutTimes(self)); });
  DefineBinaryValue<CorrectionEstimate>(module, "CalibrationEstimate");
  DefineBinaryValue<ErrorStatistics>(module, "ErrorStatistics");
  DefineBinaryValue<RelativeError>(module, "RelativeError");
  DefineBinaryValue<TrajectoryError>(module, "TrajectoryError");
  DefineBinaryValue<BundleAdjustmentSummary>(module, "WindowSummary");
  DefineBinaryValue<WindowContext::Keyframe>(module, "WindowKeyframe");
  DefineBinaryValue<FrameContext>(module, "FrameContext");
}

}  // namespace

void BindValues(py::module_* module) {
  DefineInputs(*module);
  DefineResults(*module);
}

}  // namespace msc_vo
