// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <string>

#include "msc_vo/diagnosis/depth_curve.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

std::string NameOf(const DepthCurveTest::Votes& votes, double depth_scale) {
  switch (votes.curve) {
    case DepthCurve::kDepth:
      return "depth";
    case DepthCurve::kInverse:
      return "inverse depth (disparity)";
    case DepthCurve::kInverted:
      return FormatText("inverted depth (about %.0f minus depth, in raw units)",
                        votes.origin * depth_scale);
    case DepthCurve::kCompressed:
      return "compressed depth (its square root or logarithm)";
    case DepthCurve::kStretched:
      return "stretched depth (its square)";
    case DepthCurve::kRayLength:
      return "the distance from the camera (the length of the viewing ray)";
  }
  return "";
}

std::string FixOf(DepthCurve curve) {
  const std::string write = "write the depth images again, with depth along the optical axis: ";
  switch (curve) {
    case DepthCurve::kDepth:
      return "";
    case DepthCurve::kInverse:
      return write +
             "focal length (px) times baseline (m) divided by disparity (px), times depth_scale; "
             "for a depth buffer, invert the projection of the renderer";
    case DepthCurve::kInverted:
      return write + "the value at distance 0 minus each value, 0 where nothing was measured";
    case DepthCurve::kCompressed:
    case DepthCurve::kStretched:
      return write + "the inverse function of what they were encoded with, times depth_scale";
    case DepthCurve::kRayLength:
      return write +
             "each value divided by sqrt(1 + x^2 + y^2), with x = (u - cx) / fx and y = (v - cy) / "
             "fy";
  }
  return "";
}

}  // namespace

void AddDepthCurveFindings(const DepthCurveTest& test, Findings* findings) {
  const std::string check = DepthCurveTest::kCheck;
  const DepthCurveTest::Votes best = test.Best();
  if (best.ProveCurve()) {
    const bool may_be_lens = best.may_be_lens;
    const std::string text = FormatText(
        "the depth images hold %s, %s: as such, %d surfaces are plane, as depth %d",
        NameOf(best, test.depth_scale()).c_str(),
        may_be_lens ? "or the lens is not described" : "not depth", best.num_curve, best.num_depth);
    const Measurement ratio{static_cast<double>(best.num_depth) / best.num_curve, "ratio"};
    const std::string fix = FixOf(best.curve);
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
