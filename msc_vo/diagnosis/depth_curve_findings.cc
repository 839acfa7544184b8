// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cstddef>
#include <iterator>
#include <string>

#include "msc_vo/diagnosis/depth_curve.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

struct CurveText {
  const char* name;  // a format; %.0f: the value at distance 0, raw units
  const char* fix;   // follows kWriteAgain
};

constexpr char kWriteAgain[] = "write the depth images again, with depth along the optical axis: ";
constexpr char kDecode[] = "the inverse function of what they were encoded with, times depth_scale";

// In the order of DepthCurve; depth itself has no finding.
constexpr CurveText kCurveTexts[] = {
    {"depth", ""},
    {"inverse depth (disparity)",
     "focal length (px) times baseline (m) divided by disparity (px), times depth_scale; "
     "for a depth buffer, invert the projection of the renderer"},
    {"inverted depth (about %.0f minus depth, in raw units)",
     "the value at distance 0 minus each value, 0 where nothing was measured"},
    {"compressed depth (its square root or logarithm)", kDecode},
    {"stretched depth (its square)", kDecode},
    {"the distance from the camera (the length of the viewing ray)",
     "each value divided by sqrt(1 + x^2 + y^2), with x = (u - cx) / fx and y = (v - cy) / fy"},
};
static_assert(std::size(kCurveTexts) == static_cast<size_t>(DepthCurve::kRayLength) + 1);

}  // namespace

void AddDepthCurveFindings(const DepthCurveTest& test, Findings* findings) {
  const std::string check = DepthCurveTest::kCheck;
  const DepthCurveTest::Votes best = test.Best();
  if (best.ProveCurve()) {
    const bool may_be_lens = best.may_be_lens;
    const CurveText& curve = kCurveTexts[static_cast<size_t>(best.curve)];
    const std::string name = FormatText(curve.name, best.origin * test.depth_scale());
    const std::string text = FormatText(
        "the depth images hold %s, %s: as such, %d surfaces are plane, as depth %d", name.c_str(),
        may_be_lens ? "or the lens is not described" : "not depth", best.num_curve, best.num_depth);
    const Measurement ratio{static_cast<double>(best.num_depth) / best.num_curve, "ratio"};
    const std::string fix = std::string(kWriteAgain) + curve.fix;
    findings->push_back(
        may_be_lens ? Warning(check, text, "give the distortion of the lens, or " + fix, ratio)
                    : Error(check, text, fix, ratio));
    return;
  }
  const DepthCurveTest::Votes inverse = test.OfInverse();
  findings->push_back(Good(
      check,
      inverse.ProveDepth()
          ? FormatText("no disparity: %d inclined surfaces are plane as depth, %d as inverse depth",
                       inverse.num_depth, inverse.num_curve)
          : "depth against its inverse: not tested, too few inclined planes"));
}

}  // namespace msc_vo
