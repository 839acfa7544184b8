// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <pybind11/numpy.h>

#include "apps/python/arrays.h"
#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// Items of a window from and to arrays; the arguments are those of WindowData in __init__.pyi.
// Throw std::invalid_argument on arrays of the wrong shape; values and ids are checked by the
// solver.

void AddKeyframes(WindowData* window, pybind11::handle ids, pybind11::handle cam_from_world,
                  pybind11::handle fixed);
void AddPoints(WindowData* window, pybind11::handle ids, pybind11::handle positions,
               pybind11::handle fixed, pybind11::handle noise);
void AddLines(WindowData* window, pybind11::handle ids, pybind11::handle segments,
              pybind11::handle fixed, pybind11::handle noise, pybind11::handle depth_offsets);
void AddPointObservations(WindowData* window, pybind11::handle keyframes, pybind11::handle points,
                          pybind11::handle pixels, pybind11::handle sigmas,
                          pybind11::handle inverse_depths, pybind11::handle inverse_depth_sigmas);
void AddLineObservations(WindowData* window, pybind11::handle keyframes, pybind11::handle lines,
                         pybind11::handle segments, pybind11::handle sigmas,
                         pybind11::handle inverse_depths, pybind11::handle depth_covariances);
void AddLinePairs(std::vector<WindowData::LinePair>* pairs, pybind11::handle a, pybind11::handle b,
                  pybind11::handle sigmas, pybind11::handle counts);
void AddAxisAlignments(WindowData* window, pybind11::handle lines, pybind11::handle axes,
                       pybind11::handle sigmas);
void AddPosePrior(WindowData* window, int64_t keyframe, pybind11::handle cam_from_world,
                  pybind11::handle covariance);

/// (N, 4, 4), (N, 3) and (N, 6) copies of the states.
pybind11::array_t<double> PosesOf(const WindowData& window);
RowMajorMatrix PointsOf(const WindowData& window);
RowMajorMatrix LinesOf(const WindowData& window);

// Items of a window as dictionaries of arrays whose names are the arguments of the function of
// WindowData that adds them: window.add_point_observations(**other.point_observations).

pybind11::dict PointObservationArrays(const std::vector<WindowData::PointObservation>& items);
/// Depths that are not measured are nan.
pybind11::dict LineObservationArrays(const std::vector<WindowData::LineObservation>& items);
pybind11::dict LinePairArrays(const std::vector<WindowData::LinePair>& items);
pybind11::dict AxisAlignmentArrays(const std::vector<WindowData::AxisAlignment>& items);

}  // namespace msc_vo
