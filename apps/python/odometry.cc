// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/checkpoint.h"
#include "apps/python/contexts.h"
#include "apps/python/factors.h"
#include "apps/python/fork_guard.h"
#include "apps/python/garbage_collection.h"
#include "apps/python/map.h"
#include "apps/python/option_table.h"
#include "apps/python/python_names.h"
#include "apps/python/shared_object.h"
#include "apps/python/tracked_image.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/sensor/byte_order.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// Throws std::invalid_argument if the bytes of raw depth, here in metres, are swapped.
void CheckByteOrder(const cv::Mat& depth, const py::object& depth_scale) {
  ByteOrder order;
  order.Add(depth, depth_scale.cast<double>());
  if (!order.IsSwapped()) return;
  throw std::invalid_argument(
      "depth: the two bytes of the values are swapped; give depth.byteswap(), or read the images "
      "with the high byte first");
}

// The odometry without the GIL, and the numbering of its images.
class PyOdometry {
 public:
  PyOdometry(const OptionsTable* options, const PinholeCamera& camera, const py::object& distortion)
      : PyOdometry(options ? options->values() : OdometryOptions(), camera,
                   LensArgument(distortion, "distortion")) {}
  // The mapper's thread, which is joined, may wait for the GIL. In a forked process there is none
  // to join, and what it was changing is not valid: the memory is left as it is.
  ~PyOdometry() {
    if (IsInherited()) {
      static_cast<void>(odometry_.release());
      return;
    }
    const py::gil_scoped_release release;
    odometry_.reset();
  }
  PyOdometry(const PyOdometry&) = delete;
  PyOdometry& operator=(const PyOdometry&) = delete;

  PyMap CopyOfMap() {
    return Alone([&] { return CopyMap(*odometry_->Map()); });
  }

  void Save(const py::object& folder) {
    const std::string path = PathArgument(folder);
    Alone([&] { checkpoint_.Save(path, odometry_.get()); });
  }

  void Restore(const py::object& folder) {
    const std::string path = PathArgument(folder);
    Alone([&] {
      if (!odometry_->frames().empty()) {
        throw std::invalid_argument("restore() must precede the first image");
      }
      is_usable_ = false;
      checkpoint_.Restore(path, odometry_.get());
      // The map of the checkpoint replaces that of load_map().
      if (num_worlds_) num_worlds_ = NumEarlierWorlds(odometry_->Finish());
      is_usable_ = true;
    });
  }

  void ReadMap(const py::object& file, bool only_localize) {
    Alone([&, path = PathArgument(file)] {
      MapContents map = LoadMap(path);
      const int num_worlds = static_cast<int>(map.submaps.size());
      if (only_localize && num_worlds == 0)
        throw std::invalid_argument(path + ": has no keyframes");
      odometry_->SetMap(std::move(map));
      if (only_localize) num_worlds_ = num_worlds;
    });
  }

  void WriteMap(const py::object& file, const std::string& session,
                const std::map<KeyframeId, py::bytes>& images) {
    const std::string path = PathArgument(file);
    const std::map<KeyframeId, std::string> jpegs(images.begin(), images.end());
    auto maps = Alone([&] { return odometry_->ShareMaps(session); });
    if (!maps) throw std::runtime_error(path + ": not written, since a keyframe step has failed");
    LeaveOutEmptySession(&*maps);
    if (maps->sessions.empty()) {
      throw std::invalid_argument(path +
                                  ": not written, since the map has no keyframes yet; save " +
                                  "it after the first image with a pose");
    }
    const py::gil_scoped_release release;
    SaveMap(path, std::move(*maps), [&jpegs](KeyframeId id) {
      const auto jpeg = jpegs.find(id);
      return jpeg != jpegs.end() ? jpeg->second : std::string();
    });
  }

  void SetTrackingObserver(const py::object& callback) {
    const SharedObject shared(callback);
    TrackingObserver observer;
    if (!callback.is_none()) observer = MakeTrackingObserver(shared);
    Alone([&] { odometry_->SetTrackingObserver(std::move(observer)); });
    tracking_observer_ = shared;
  }

  void SkipClippedDepthSearch() {
    Alone([&] { odometry_->SkipClippedDepthSearch(); });
  }

  FrameResult Process(const py::object& timestamp, const py::object& gray, const py::object& depth,
                      const py::object& depth_scale, const py::object& depth_delay,
                      const py::object& mask) {
    RgbdImage image;
    image.id = NextId();
    image.timestamp = TimeArgument(timestamp, "timestamp");
    image.depth_delay = NumberArgument(depth_delay, "depth_delay");
    image.gray = GrayArgument(gray, "gray");
    image.depth = DepthArgument(depth, depth_scale, "depth");
    if (!mask.is_none()) image.mask = MaskArgument(mask, "mask");
    if (!depth_scale.is_none() && image.id < kNumChecked) CheckByteOrder(image.depth, depth_scale);
    return Alone([&] { return Reported(odometry_->Process(image)); });
  }

  FrameResult Drop(const py::object& timestamp, const std::string& status) {
    const double time = TimeArgument(timestamp, "timestamp");
    if (status != "dropped" && status != "unreadable") {
      throw std::invalid_argument("status: must be 'dropped' or 'unreadable', not '" + status +
                                  "'");
    }
    const TrackingStatus value =
        status == "dropped" ? TrackingStatus::kDropped : TrackingStatus::kUnreadable;
    const int64_t id = NextId();
    return Alone([&] { return Reported(odometry_->Drop(id, time, value)); });
  }

  bool MappingPending() {
    return Alone([&] { return odometry_->MappingPending(); });
  }

  bool RunMapping(const py::object& budget) {
    const double seconds = NumberArgument(budget, "budget");
    return Alone([&] { return odometry_->RunMapping(seconds); });
  }

  std::shared_ptr<OdometryResult> Finish() {
    return Alone([&] {
      return std::make_shared<OdometryResult>(odometry_->Finish(num_worlds_.has_value()));
    });
  }

  std::vector<FrameResult> Frames() {
    return Alone([&] {
      std::vector<FrameResult> frames = odometry_->frames();
      for (FrameResult& frame : frames) frame = Reported(frame);
      return frames;
    });
  }

  void SetWindowFactors(const py::object& callback) {
    const SharedObject shared(callback);
    WindowFactorCallback function;
    if (!callback.is_none()) {
      function = [this, shared](const WindowContext& window) -> WindowFactors {
        const CallbackGuard guard_of_callback(this);
        const py::gil_scoped_acquire gil;
        const auto context = std::make_shared<PyWindowContext>(window);
        struct Guard {  // Python may keep the context
          PyWindowContext* context;
          ~Guard() { context->context.data = nullptr; }
        } const guard{context.get()};
        FactorLists lists = FactorsArgument(shared.get()(context), "window factors");
        return {std::move(lists.extra_blocks), std::move(lists.factors)};
      };
    }
    Alone([&] { odometry_->SetWindowFactors(std::move(function)); });
    window_factors_ = shared;
  }

  void SetPoseFactors(const py::object& callback) {
    const SharedObject shared(callback);
    PoseFactorCallback function;
    if (!callback.is_none()) {
      function = [shared](const FrameContext& frame) -> std::vector<PoseFactor> {
        const py::gil_scoped_acquire gil;
        return PoseFactorsArgument(shared.get()(frame), "pose factors");
      };
    }
    Alone([&] { odometry_->SetPoseFactors(std::move(function)); });
    pose_factors_ = shared;
  }

  void SetWindowObserver(const py::object& callback) {
    const SharedObject shared(callback);
    WindowObserver function;
    if (!callback.is_none()) {
      function = [this, shared](KeyframeId keyframe, const BundleAdjustmentOptions& options,
                                const WindowData& window) {
        const CallbackGuard guard_of_callback(this);
        const py::gil_scoped_acquire gil;
        shared.get()(keyframe, std::make_shared<WindowData>(window), WindowOptionsTable(options));
      };
    }
    Alone([&] { odometry_->SetWindowObserver(std::move(function)); });
    window_observer_ = shared;
  }

  template <typename Action>
  void ForEachSharedObject(const Action& action) {
    action(&window_factors_);
    action(&pose_factors_);
    action(&window_observer_);
    action(&tracking_observer_);
  }

 private:
  PyOdometry(const OdometryOptions& options, const PinholeCamera& camera,
             const LensDistortion& distortion)
      : odometry_(std::make_unique<Odometry>(options, camera, distortion)),
        checkpoint_(options, camera, distortion),
        has_threads_(options.threads > 1) {}

  // While a callback runs on this thread, which may be the mapper's: a call would wait for itself.
  class CallbackGuard {
   public:
    explicit CallbackGuard(const PyOdometry* odometry)
        : before_(std::exchange(calling_, odometry)) {}
    ~CallbackGuard() { calling_ = before_; }
    CallbackGuard(const CallbackGuard&) = delete;
    CallbackGuard& operator=(const CallbackGuard&) = delete;

   private:
    const PyOdometry* before_;
  };
  static inline thread_local const PyOdometry* calling_ = nullptr;

  bool IsInherited() const { return has_threads_ && process_.IsInherited(); }

  // Calls `action` without the GIL and while nobody else uses the odometry.
  template <typename Action>
  auto Alone(const Action& action) -> decltype(action()) {
    if (IsInherited()) {
      throw std::runtime_error(
          "the odometry was made before this process was forked, and its threads stay in the "
          "parent: "
          "make it in this process, or with threads=1");
    }
    if (!is_usable_) {
      throw std::runtime_error("restore() has failed: make another Odometry to continue");
    }
    if (calling_ == this || busy_.exchange(true)) {
      throw std::runtime_error(
          "the odometry is in use: neither a second thread nor a callback may call it");
    }
    const py::gil_scoped_release release;
    struct Guard {
      std::atomic<bool>* busy;
      ~Guard() { *busy = false; }
    } const guard{&busy_};
    return WithPythonNames(action);
  }

  // The position of the next image in the sequence.
  int64_t NextId() {
    return Alone([&] { return static_cast<int64_t>(odometry_->frames().size()); });
  }

  // The frame as a run that is only localised reports it; other runs: as it is.
  FrameResult Reported(const FrameResult& frame) const {
    return num_worlds_ ? KeepLocalizedPose(*num_worlds_, frame) : frame;
  }

  static constexpr int64_t kNumChecked = 4;  // images whose byte order is checked

  SharedObject window_factors_, pose_factors_, window_observer_, tracking_observer_;
  std::unique_ptr<Odometry> odometry_;
  RunCheckpoint checkpoint_;
  ForkGuard process_;
  std::optional<int> num_worlds_;  // of the map, if the run is only localised in it
  bool has_threads_;
  bool is_usable_ = true;  // a checkpoint has not been read in part
  std::atomic<bool> busy_ = false;
};

// Maps and checkpoints in files.
void BindStorage(py::class_<PyOdometry>* odometry) {
  (*odometry)
      .def("load_map", &PyOdometry::ReadMap, py::arg("file"), py::kw_only(),
           py::arg("only_localize") = false,
           "Begins with the map of earlier sessions. only_localize: frames that are not in its "
           "world are lost (Localizer). ValueError after the first image.")
      .def(
          "save_map", &PyOdometry::WriteMap, py::arg("file"), py::arg("session") = "",
          py::kw_only(), py::arg("images") = py::dict(),
          "Waits for local mapping and replaces a file by the map of this and earlier sessions. "
          "images: dict from the id of a keyframe to the bytes of a JPEG file of at most 64 KB; "
          "ValueError on other bytes. The file keeps the images of keyframes that are still in the "
          "map and whose session has a name. ValueError, and nothing is written, without "
          "keyframes.")
      .def(
          "save", &PyOdometry::Save, py::arg("folder"),
          "Waits for local mapping and writes a checkpoint of the run, which replaces an earlier "
          "one in the folder. An Odometry that restores it continues with the same results, bit by "
          "bit. Callbacks are not part of it.")
      .def("restore", &PyOdometry::Restore, py::arg("folder"),
           "Continues the run of a checkpoint, before the first image, with the same options (but "
           "threads and external_mapping), camera and lens: ValueError on others, RuntimeError on "
           "files that are missing or damaged. After an error, only another Odometry can be used.");
}

}  // namespace

void BindOdometry(py::module_* module) {
  BindContexts(module);
  py::class_<PyOdometry> odometry(
      *module, "Odometry",
      "RGB-D visual odometry. process() every image, then finish(). The same images give the same "
      "poses, bit by bit. The GIL is released meanwhile.",
      CollectsGarbage<PyOdometry>());
  odometry
      .def(py::init<const OptionsTable*, const PinholeCamera&, const py::object&>(),
           py::arg("options"), py::arg("camera"), py::arg("distortion") = py::none(),
           "options: None for the defaults. distortion: k1 k2 p1 p2 [k3] in OpenCV's order, or a "
           "Lens. Raises ValueError on options or a camera that are not valid.")
      .def("process", &PyOdometry::Process, py::arg("timestamp"), py::arg("gray"), py::arg("depth"),
           py::kw_only(), py::arg("depth_scale") = py::none(), py::arg("depth_delay") = 0.0,
           py::arg("mask") = py::none(),
           "Tracks one image. timestamp: seconds, ascending. gray: uint8 (height, width), or RGB "
           "(height, width, 3). depth: float32 in metres, or uint16 with depth_scale units per "
           "metre, 10 to 100000; 0 or masked: not measured. Arrays must be C-contiguous; those in "
           "the byte order of the machine are not copied. depth_delay: seconds from the colour "
           "image to the depth image. mask: uint8 (height, width), not 0: left out, None: all "
           "pixels are used. Raises ValueError on "
           "arrays that do not fit, which leave no frame. Exceptions of callbacks and of local "
           "mapping come after the frame is complete: it is in `frames`.")
      .def("drop", &PyOdometry::Drop, py::arg("timestamp"), py::arg("status") = "dropped",
           "Records a frame without an image: 'dropped' or 'unreadable'.")
      .def_property_readonly("mapping_pending", &PyOdometry::MappingPending,
                             "Whether run_mapping() has work to do.")
      .def("run_mapping", &PyOdometry::RunMapping, py::arg("budget"),
           "With Options(external_mapping=True): runs local mapping in this thread for about "
           "`budget` seconds and returns mapping_pending. Results do not depend on the budget.")
      .def("finish", &PyOdometry::Finish,
           "Waits for local mapping and returns the Result. May be called at any time.")
      .def_property_readonly("frames", &PyOdometry::Frames,
                             "FrameResult objects so far, with the poses as process() gave them.")
      .def("set_window_factors", &PyOdometry::SetWindowFactors, py::arg("callback"),
           "callback(WindowContext) returns CustomFactor and ExtraBlock objects for every window "
           "of local bundle adjustment. Runs on the mapper's thread if there is one. ValueError "
           "after the first image.")
      .def(
          "set_pose_factors", &PyOdometry::SetPoseFactors, py::arg("callback"),
          "callback(FrameContext) returns PoseFactor objects for every frame. ValueError after the "
          "first image.")
      .def("set_window_observer", &PyOdometry::SetWindowObserver, py::arg("callback"),
           "callback(keyframe, WindowData, WindowOptions) is called with a copy of every window "
           "before it is solved. ValueError after the first image.")
      .def("set_tracking_observer", &PyOdometry::SetTrackingObserver, py::arg("callback"),
           "callback(TrackedImage) is called with every frame that process() has tracked, for "
           "display. ValueError after the first image.")
      .def("skip_clipped_depth_search", &PyOdometry::SkipClippedDepthSearch,
           "Disables the search for clipped depth. For images of a Sequence, which leaves out "
           "clipped depth itself. ValueError after the first image.")
      .def("map", &PyOdometry::CopyOfMap,
           "Waits for local mapping and returns a copy of the present Map.");
  BindStorage(&odometry);
}

}  // namespace msc_vo
