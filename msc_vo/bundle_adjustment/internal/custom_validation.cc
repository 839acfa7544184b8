// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/custom_validation.h"

#include <algorithm>
#include <string>

#include <ceres/manifold.h>

#include "msc_vo/bundle_adjustment/internal/window_terms.h"
#include "msc_vo/bundle_adjustment/validation.h"

namespace msc_vo {

namespace {

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

}  // namespace

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

}  // namespace msc_vo
