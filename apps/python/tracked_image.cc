// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/tracked_image.h"

#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <pybind11/eigen.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/map.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// A tracked image during the call of its observer. Its properties are copies.
struct PyTrackedImage {
  const TrackedImage* image;  // null after the call

  const TrackedImage& Get() const {
    if (image != nullptr) return *image;
    throw std::runtime_error(
        "a TrackedImage can be read during the call of the tracking observer only; copy what you "
        "need");
  }
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

RowMajorMatrix FeaturePoints(const PyTrackedImage& self) {
  return Rows(self.Get().features.points, 2,
              [](const PointFeature& point, auto row) { row = point.pixel.transpose(); });
}

py::array PointDepthsOf(const PyTrackedImage& self) {
  return Column<double>(self.Get().features.points, [](const PointFeature& point) {
    return point.HasDepth() ? 1.0 / point.inverse_depth : kNone;
  });
}

RowMajorMatrix FeatureLines(const PyTrackedImage& self) {
  return Rows(self.Get().features.lines, 4,
              [](const LineFeature& line, auto row) { FillEndPoints(line.segment, row); });
}

RowMajorMatrix LineDepthsOf(const PyTrackedImage& self) {
  return Rows(self.Get().features.lines, 2, [](const LineFeature& line, auto row) {
    row.setConstant(kNone);
    if (line.depth) row << 1.0 / line.depth->start, 1.0 / line.depth->end;
  });
}

// The landmark that each feature is matched with.
template <typename Match>
py::array_t<int64_t> LandmarksOf(const std::vector<Match>& matches, size_t num_features) {
  py::array_t<int64_t> landmarks(static_cast<py::ssize_t>(num_features));
  for (size_t i = 0; i < num_features; ++i) landmarks.mutable_at(i) = kNoId;
  for (const Match& match : matches) {
    if (match.inlier) landmarks.mutable_at(match.feature) = match.id;
  }
  return landmarks;
}

}  // namespace

TrackingObserver MakeTrackingObserver(const SharedObject& callback) {
  return [callback](const TrackedImage& image) {
    const py::gil_scoped_acquire gil;
    const auto view = std::make_shared<PyTrackedImage>(PyTrackedImage{&image});
    struct Guard {
      PyTrackedImage* view;
      ~Guard() { view->image = nullptr; }
    } const guard{view.get()};
    callback.get()(view);
  };
}

void BindTrackedImage(py::module_* module) {
  using Image = PyTrackedImage;
  py::class_<Image, std::shared_ptr<Image>>(
      *module, "TrackedImage",
      "A frame that has just been tracked, for display; can be read during the call of the "
      "tracking observer. Pixels are undistorted. All arrays are copies.")
      .def_property_readonly(
          "frame", [](const Image& self) { return FrameResult(self.Get().result); },
          "The FrameResult.")
      .def_property_readonly(
          "gray", [](const Image& self) { return ImageArray<uint8_t>(self.Get().image.gray); },
          "(height, width) uint8, as given to process().")
      .def_property_readonly(
          "depth", [](const Image& self) { return ImageArray<float>(self.Get().image.depth); },
          "(height, width) float32, metres, as given to process().")
      .def_property_readonly("points", &FeaturePoints, "(N, 2) pixels of the point features.")
      .def_property_readonly("point_depths", &PointDepthsOf, "(N,) metres, nan: not measured.")
      .def_property_readonly(
          "point_landmarks",
          [](const Image& self) {
            const TrackedImage& image = self.Get();
            return LandmarksOf(image.tracked.matches.points, image.features.points.size());
          },
          "(N,) ids in the map of the landmarks that the points observe; -1: none.")
      .def_property_readonly("lines", &FeatureLines,
                             "(M, 4) pixels, both ends of the line features.")
      .def_property_readonly("line_depths", &LineDepthsOf,
                             "(M, 2) metres at both ends, nan: not measured.")
      .def_property_readonly(
          "line_landmarks",
          [](const Image& self) {
            const TrackedImage& image = self.Get();
            return LandmarksOf(image.tracked.matches.lines, image.features.lines.size());
          },
          "(M,) ids in the map of the landmarks that the lines observe; -1: none.")
      .def_property_readonly(
          "map", [](const Image& self) { return CopyMap(self.Get().map); },
          "A copy of the Map that the frame was tracked in.");
}

}  // namespace msc_vo
