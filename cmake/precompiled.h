// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Headers of other libraries that many source files include, to be compiled once
// (MscVoPrecompiledHeaders.cmake). No source file includes this one.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
// A target without OpenCV reads this file as text if its compiler rejects the precompiled one.
#if __has_include(<opencv2/core.hpp>)
#include <opencv2/core.hpp>
#endif
