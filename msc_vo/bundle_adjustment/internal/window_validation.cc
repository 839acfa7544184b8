// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_validation.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <ceres/manifold.h>

#include "msc_vo/bundle_adjustment/internal/window_terms.h"
#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/factors/plane_manifold.h"

namespace msc_vo {

namespace {

// Throws std::invalid_argument for a window that is not valid.
[[noreturn]] void ThrowInvalidWindow(const std::string& error) {
  throw std::invalid_argument("LocalBundleAdjustment: " + error);
}

// Positions of items by their ids.
class IdMap {
 public:
  // `kind`: of the items, for error messages; must outlive the map. Throws std::invalid_argument
  // on a repeated id.
  template <typename Item>
  IdMap(const char* kind, const std::vector<Item>& items) : kind_(kind) {
    positions_.reserve(items.size());
    for (size_t i = 0; i < items.size(); ++i) {
      positions_.emplace_back(items[i].id, static_cast<int>(i));
    }
    std::sort(positions_.begin(), positions_.end());
    for (size_t i = 1; i < positions_.size(); ++i) {
      if (positions_[i].first == positions_[i - 1].first) {
        ThrowInvalidWindow(Name(positions_[i].first) + ": the id is given twice");
      }
    }
  }

  // Throws std::invalid_argument on an unknown id. `role`: use of the id, for the error message.
  int At(int64_t id, const std::string& role = "observed") const {
    const auto it = std::lower_bound(positions_.begin(), positions_.end(), std::make_pair(id, 0));
    if (it == positions_.end() || it->first != id) {
      ThrowInvalidWindow(Name(id) + " is " + role + " but not in the window");
    }
    return it->second;
  }

 private:
  std::string Name(int64_t id) const { return std::string(kind_) + " " + std::to_string(id); }

  const char* kind_;
  std::vector<std::pair<int64_t, int>> positions_;
};

// Whether a custom factor may fix the gauge.
bool HasCustomPose(const WindowData& data) {
  for (const CustomFactor& factor : data.custom_factors) {
    for (const BlockId& block : factor.blocks) {
      if (block.kind == BlockId::Kind::kPose) return true;
    }
  }
  return false;
}

// Calls report(error, kind, id) for every keyframe and landmark; `error` is null for valid ones.
template <typename Report>
void CheckState(const WindowData& data, const Report& report) {
  for (const WindowData::Keyframe& k : data.keyframes) {
    report(PoseError(k.cam_from_world), "keyframe", k.id);
  }
  for (const WindowData::Point& p : data.points) {
    report(PositionError(p.position), "point", p.id);
    report(NoiseError(p.noise), "point", p.id);
  }
  for (const WindowData::Line& l : data.lines) {
    report(MapLineError(l.segment), "line", l.id);
    report(NoiseError(l.noise), "line", l.id);
    report(DepthOffsetError(l.depth_offset), "line", l.id);
  }
}

std::string DescribeItem(const char* error, const char* kind, int64_t id) {
  return std::string(kind) + " " + std::to_string(id) + ": " + error;
}

void CheckGauge(const WindowData& data) {
  const bool any_fixed = std::any_of(data.keyframes.begin(), data.keyframes.end(),
                                     [](const WindowData::Keyframe& k) { return k.fixed; });
  if (!any_fixed && data.pose_priors.empty() && !HasCustomPose(data)) {
    ThrowInvalidWindow("no keyframe is fixed or has a prior or custom factor: the gauge is free");
  }
}

std::vector<WindowIndex::Pair> ResolvePairs(const std::vector<WindowData::LinePair>& pairs,
                                            const char* kind, const IdMap& lines) {
  std::vector<WindowIndex::Pair> resolved;
  resolved.reserve(pairs.size());
  const std::string role = std::string("part of a ") + kind + " pair";
  for (const WindowData::LinePair& p : pairs) {
    if (const char* error = LinePairError(p)) {
      ThrowInvalidWindow(std::string(kind) + " pair of line " + std::to_string(p.a) + " and line " +
                         std::to_string(p.b) + ": " + error);
    }
    resolved.push_back({lines.At(p.a, role), lines.At(p.b, role)});
  }
  return resolved;
}

std::vector<std::array<int, 1>> ResolveAlignments(
    const std::vector<WindowData::AxisAlignment>& alignments, const IdMap& lines) {
  std::vector<std::array<int, 1>> resolved;
  resolved.reserve(alignments.size());
  for (const WindowData::AxisAlignment& a : alignments) {
    if (const char* error = AxisAlignmentError(a)) {
      ThrowInvalidWindow("alignment of line " + std::to_string(a.line) + ": " + error);
    }
    resolved.push_back({lines.At(a.line, "aligned with an axis")});
  }
  return resolved;
}

std::vector<int> ResolvePriors(const std::vector<WindowData::PosePrior>& priors,
                               const IdMap& keyframes) {
  std::vector<int> resolved;
  resolved.reserve(priors.size());
  for (const WindowData::PosePrior& p : priors) {
    const char* error = PoseError(p.cam_from_world);
    if (error == nullptr) error = CovarianceError(p.covariance);
    if (error != nullptr)
      ThrowInvalidWindow("prior of keyframe " + std::to_string(p.keyframe) + ": " + error);
    resolved.push_back(keyframes.At(p.keyframe, "constrained by a prior"));
  }
  return resolved;
}

std::string NameOf(const BlockId& block) {
  const std::string id = " " + std::to_string(block.id);
  switch (block.kind) {
    case BlockId::Kind::kPose:
      return "the pose of keyframe" + id;
    case BlockId::Kind::kPoint:
      return "point" + id;
    case BlockId::Kind::kLine:
      return "line" + id;
    case BlockId::Kind::kAxes:
      return "the Manhattan axes";
    case BlockId::Kind::kExtra:
      break;
  }
  return "extra block" + id;
}

// Whether the first three numbers of a block are a unit vector.
bool BeginsWithUnitVector(const ceres::Manifold* manifold) {
  return dynamic_cast<const UnitVectorManifold*>(manifold) != nullptr ||
         dynamic_cast<const PlaneManifold*>(manifold) != nullptr;
}

void CheckExtraBlocks(const WindowData& data) {
  for (const ExtraBlock& extra : data.extra_blocks) {
    const auto fail = [&extra](const std::string& error) {
      ThrowInvalidWindow(NameOf(BlockId::Extra(extra.id)) + ": " + error);
    };
    if (extra.value.size() == 0) fail("it has no value");
    if (!extra.value.allFinite()) fail("the value is not finite");
    if (extra.manifold && extra.manifold->AmbientSize() != extra.value.size()) {
      fail("the value has size " + std::to_string(extra.value.size()) + ", but its manifold has " +
           std::to_string(extra.manifold->AmbientSize()));
    }
    if (!BeginsWithUnitVector(extra.manifold.get())) continue;
    if (const char* error = UnitVectorError(extra.value.head<3>())) {
      fail(std::string("the value is ") + error + ", as its manifold needs");
    }
  }
  if (!data.axes) return;
  const char* error = PoseError(Rigid3(data.axes->world_from_axes, Eigen::Vector3d::Zero()));
  if (error != nullptr) ThrowInvalidWindow(NameOf(BlockId::Axes()) + ": " + error);
}

// Resolves the parameter blocks of factors and validates the factors.
class FactorResolver {
 public:
  FactorResolver(const WindowData& data, const IdMap& keyframes, const IdMap& points,
                 const IdMap& lines)
      : data_(data),
        keyframes_(keyframes),
        points_(points),
        lines_(lines),
        extra_("extra block", data.extra_blocks),
        state_(data) {}

  std::vector<StateBlock> Resolve(const CustomFactor& factor) const {
    WindowTerm<CustomFactor>::Block block{&factor, {}};
    std::vector<std::string> names;
    for (size_t i = 0; i < factor.blocks.size(); ++i) {
      block.parameters.push_back(ResolveBlock(factor, i));
      names.push_back(NameOf(factor.blocks[i]));
    }
    std::vector<CustomParameter> parameters = ParametersOf(block, state_);
    for (size_t i = 0; i < parameters.size(); ++i) {
      parameters[i].variable = !IsFixed(data_, block.parameters[i]);
    }
    const std::string error =
        CustomFactorError(factor.cost.get(), factor.loss.get(), parameters, names);
    if (!error.empty()) Fail(factor, error);
    return block.parameters;
  }

 private:
  [[noreturn]] static void Fail(const CustomFactor& factor, const std::string& error) {
    ThrowInvalidWindow("custom factor '" + factor.name + "': " + error);
  }

  StateBlock ResolveBlock(const CustomFactor& factor, size_t i) const {
    const BlockId& block = factor.blocks[i];
    const auto end = factor.blocks.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(factor.blocks.begin(), end, block) != end) {
      Fail(factor, NameOf(block) + " is given twice");
    }
    const std::string role = "a parameter block of custom factor '" + factor.name + "'";
    switch (block.kind) {
      case BlockId::Kind::kPose:
        return {BlockKind::kPose, keyframes_.At(block.id, role)};
      case BlockId::Kind::kPoint:
        return {BlockKind::kPoint, points_.At(block.id, role)};
      case BlockId::Kind::kLine:
        return {BlockKind::kLine, lines_.At(block.id, role)};
      case BlockId::Kind::kExtra:
        return {BlockKind::kExtra, extra_.At(block.id, role)};
      case BlockId::Kind::kAxes:
        break;
    }
    if (!data_.axes) Fail(factor, "the window has no Manhattan axes");
    return {BlockKind::kExtra, static_cast<int>(data_.extra_blocks.size())};
  }

  const WindowData& data_;
  const IdMap &keyframes_, &points_, &lines_;
  IdMap extra_;
  WindowState state_;
};

// Validates the extra blocks, the Manhattan axes and the custom factors of a window, and evaluates
// each factor at the initial values, which must otherwise be valid. Returns the parameter blocks of
// each factor.
std::vector<std::vector<StateBlock>> ResolveCustomFactors(const WindowData& data,
                                                          const IdMap& keyframes,
                                                          const IdMap& points, const IdMap& lines) {
  std::vector<std::vector<StateBlock>> resolved;
  if (data.custom_factors.empty() && data.extra_blocks.empty() && !data.axes) return resolved;
  CheckExtraBlocks(data);
  const FactorResolver resolver(data, keyframes, points, lines);
  for (const CustomFactor& factor : data.custom_factors) {
    resolved.push_back(resolver.Resolve(factor));
  }
  return resolved;
}

}  // namespace

bool HasValidState(const WindowData& data, std::string* error) {
  bool is_valid = true;
  CheckState(data, [&](const char* what, const char* kind, int64_t id) {
    if (what == nullptr || !is_valid) return;
    is_valid = false;
    *error = "the result is not valid: " + DescribeItem(what, kind, id);
  });
  return is_valid;
}

WindowIndex ValidateWindow(const BundleAdjustmentOptions& options, const WindowData& data) {
  if (data.keyframes.empty()) ThrowInvalidWindow("the window is empty: it has no keyframe");
  std::string error;
  if (!options.IsValid(&error) || !data.camera.IsValid(&error)) ThrowInvalidWindow(error);
  CheckState(data, [](const char* what, const char* kind, int64_t id) {
    if (what != nullptr) ThrowInvalidWindow(DescribeItem(what, kind, id));
  });
  CheckGauge(data);

  const IdMap keyframes("keyframe", data.keyframes);
  const IdMap points("point", data.points);
  const IdMap lines("line", data.lines);
  const auto check = [](const char* what, const char* kind, int64_t landmark, int64_t keyframe) {
    if (what == nullptr) return;
    ThrowInvalidWindow(std::string("observation of ") + kind + " " + std::to_string(landmark) +
                       " in keyframe " + std::to_string(keyframe) + ": " + what);
  };
  WindowIndex index;
  index.points.reserve(data.point_observations.size());
  for (const WindowData::PointObservation& o : data.point_observations) {
    check(PointObservationError(o.pixel, o.sigma, o.inverse_depth, o.inverse_depth_sigma), "point",
          o.point, o.keyframe);
    index.points.push_back({keyframes.At(o.keyframe), points.At(o.point)});
  }
  index.lines.reserve(data.line_observations.size());
  for (const WindowData::LineObservation& o : data.line_observations) {
    check(LineObservationError(o.segment, o.sigma, o.has_depth, o.depth), "line", o.line,
          o.keyframe);
    index.lines.push_back({keyframes.At(o.keyframe), lines.At(o.line)});
  }
  index.parallel = ResolvePairs(data.parallel_pairs, "parallel", lines);
  index.perpendicular = ResolvePairs(data.perpendicular_pairs, "perpendicular", lines);
  index.alignments = ResolveAlignments(data.axis_alignments, lines);
  index.priors = ResolvePriors(data.pose_priors, keyframes);
  index.custom_factors = ResolveCustomFactors(data, keyframes, points, lines);
  return index;
}

}  // namespace msc_vo
