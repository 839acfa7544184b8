// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// Items of a window as dictionaries of arrays whose names are the arguments of the function of
// WindowData that adds them: window.add_point_observations(**other.point_observations).

pybind11::dict PointObservationArrays(const std::vector<WindowData::PointObservation>& items);
/// Depths that are not measured are nan.
pybind11::dict LineObservationArrays(const std::vector<WindowData::LineObservation>& items);
pybind11::dict LinePairArrays(const std::vector<WindowData::LinePair>& items);
pybind11::dict AxisAlignmentArrays(const std::vector<WindowData::AxisAlignment>& items);

}  // namespace msc_vo
