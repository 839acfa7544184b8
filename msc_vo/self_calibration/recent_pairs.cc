// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/recent_pairs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "msc_vo/camera/image_scale.h"
#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/self_calibration/keyframe_frames.h"
#include "msc_vo/self_calibration/pair_view.h"
#include "msc_vo/self_calibration/surface_plane.h"

namespace msc_vo {

namespace {

// Bounds of memory and of computing time.
constexpr size_t kMaxViews = 16;
constexpr size_t kMaxPairs = 160;
constexpr size_t kMaxTries = 3;  // keyframes that an image is matched with
constexpr size_t kMaxSamples = 300;
// Between the samples by which keyframes are ranked. Chosen by measurement, see
// docs/lab/self_calibration.md.
constexpr size_t kRankingStep = 2;
constexpr size_t kMaxMatches = 100;
constexpr size_t kMaxPoints = 60;  // with surfaces
// Displacement, radians, from which on a point tells no more about the calibration.
constexpr double kMaxDisplacement = 0.15;
// Smallest mean displacement of the points of a pair, radians.
constexpr double kMinDisplacement = 0.04;
constexpr double kLargeReadoutChange = 0.005;  // seconds
// Distance of the linearisation point that calls for a new one, standard deviations.
constexpr double kMaxDistance = 0.5;
// Pairs whose images are kept: a bound of the memory.
constexpr size_t kMaxImages = 48;
// Displacement of the depth image, pixels of an image that is 640 wide, by which a surface leaves
// the window that it was fitted to.
constexpr double kMaxSurfaceShift = 2.0;
// Inverse depths at which displacements are measured, 1/metres.
constexpr double kNear = 1.0;
constexpr double kFar = 0.2;

double InSigmas(const SensorCorrection::Vector& difference, const SensorCorrection::Vector& sigma) {
  return difference.cwiseQuotient(sigma).cwiseAbs().maxCoeff();
}

bool HasSurfaces(const CalibrationPoint& point) {
  return point.a.surface.inverse_depth > 0.0 && point.b.surface.inverse_depth > 0.0;
}

// The points with surfaces, or an even choice of them.
std::vector<CalibrationPoint> WithSurfaces(const std::vector<CalibrationPoint>& points) {
  std::vector<CalibrationPoint> found;
  std::copy_if(points.begin(), points.end(), std::back_inserter(found), HasSurfaces);
  const size_t count = std::min(found.size(), kMaxPoints);
  for (size_t i = 0; i < count; ++i) found[i] = found[i * found.size() / count];
  found.resize(count);
  return found;
}

Eigen::Vector2d DepthPixel(const CorrectedCamera& camera,
                           const SensorCorrection::Vector& correction, const Eigen::Vector2d& pixel,
                           double inverse_depth) {
  Eigen::Vector2d at_infinity, parallax;
  camera.DepthPixel(pixel, correction.data(), &at_infinity, &parallax);
  return at_infinity + inverse_depth * parallax;
}

// Largest displacement (pixels) of what the corners of the colour image show in the depth image.
double LargestDepthShift(const CorrectedCamera& camera, const SensorCorrection::Vector& from,
                         const SensorCorrection::Vector& to) {
  double shift = 0.0;
  for (const double w : {kNear, kFar}) {
    for (const int x : {0, camera.camera().width}) {
      for (const int y : {0, camera.camera().height}) {
        const Eigen::Vector2d pixel(x, y);
        shift = std::max(
            shift, (DepthPixel(camera, from, pixel, w) - DepthPixel(camera, to, pixel, w)).norm());
      }
    }
  }
  return shift;
}

void Compensate(double readout_time, RgbdPairReprojection::View* view) {
  view->pixel = view->recorded_pixel + readout_time * view->pixel_rate;
}

}  // namespace

RecentPairs::RecentPairs(const CameraIntrinsics& given) : camera_(given.camera, given.distortion) {}

void RecentPairs::AddImage(const Map& map, const CalibrationImage& image,
                           const SensorCorrection::Vector& at) {
  if (!map.KnowsKeyframe(image.reference)) return;
  AddPair(map,
          {image.frame.get(), image.image,
           image.cam_from_reference * map.CamFromWorld(image.reference)},
          at);
}

void RecentPairs::AddKeyframe(const Map& map, KeyframeId id,
                              const std::shared_ptr<const RecordedImage>& image,
                              const SensorCorrection::Vector& at) {
  const Keyframe& keyframe = *map.FindKeyframe(id);
  const Frame& frame = *keyframe.frame;
  AddPair(map, {&frame, image, keyframe.cam_from_world}, at);
  KeyframeView view{id, {}, SquaredShiftRate(frame), image};
  const size_t step = std::max<size_t>(1, frame.points.size() / kMaxSamples);
  for (size_t i = 0; i < frame.points.size(); i += step) {
    const PointFeature& point = frame.points[i];
    if (point.dynamic || !point.HasDepth()) continue;
    view.samples.push_back({static_cast<int>(i), MakeView(frame, point)});
  }
  views_.push_back(std::move(view));
  if (views_.size() > kMaxViews) views_.pop_front();
}

void RecentPairs::SetReadoutTime(double readout_time) {
  if (std::abs(readout_time - readout_time_) < kMinReadoutChange) return;
  readout_time_ = readout_time;
  for (KeyframeView& view : views_) {
    for (Sample& sample : view.samples) Compensate(readout_time, &sample.view);
  }
  for (Pair& pair : pairs_) {
    for (CalibrationPoint& point : pair.points) {
      Compensate(readout_time, &point.a);
      Compensate(readout_time, &point.b);
    }
    if (std::abs(readout_time - pair.readout_time) > kLargeReadoutChange) Linearize(pair.at, &pair);
  }
}

RgbdPairReprojection::View RecentPairs::MakeView(const Frame& frame,
                                                 const PointFeature& point) const {
  RgbdPairReprojection::View view = MakePairView(frame.intrinsics->distortion, frame, point);
  Compensate(readout_time_, &view);
  return view;
}

void RecentPairs::AddPair(const Map& map, const Partner& partner,
                          const SensorCorrection::Vector& at) {
  const double focal_length = camera_.camera().FocalLength();
  // Sum of the displacements of the points that both images show.
  std::vector<std::pair<double, const KeyframeView*>> ranked;
  for (const KeyframeView& view : views_) {
    const Keyframe* keyframe = map.FindKeyframe(view.id);
    if (keyframe == nullptr) continue;
    const Frame& frame = *keyframe->frame;
    const Rigid3 b_from_a = partner.cam_from_world * keyframe->cam_from_world.Inverse();
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < view.samples.size(); i += kRankingStep) {
      const Sample& sample = view.samples[i];
      if (!frame.points[sample.feature].HasDepth()) continue;
      const Eigen::Vector3d in_b = b_from_a * frame.PointInCamera(sample.feature);
      if (in_b.z() < kMinCameraDepth) continue;
      const Eigen::Vector2d pixel = frame.camera.Project(in_b);
      if (!frame.camera.IsInside(pixel)) continue;
      const double pixels = (pixel - frame.points[sample.feature].pixel).norm();
      sum += std::min(pixels / focal_length, kMaxDisplacement);
      ++count;
    }
    if (kRankingStep * count >= kMinPairPoints &&
        sum > kMinDisplacement * static_cast<double>(count)) {
      ranked.emplace_back(-sum, &view);
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (ranked.size() > kMaxTries) ranked.resize(kMaxTries);
  for (const auto& [score, view] : ranked) {
    std::optional<Pair> pair = MakePair(map, *view, partner, at);
    if (!pair) continue;
    Linearize(at, &*pair);
    pairs_.push_back(std::move(*pair));
    ++num_added_;
    if (pairs_.size() > kMaxPairs) pairs_.pop_front();
    if (pairs_.size() > kMaxImages) {
      Pair& old = pairs_[pairs_.size() - kMaxImages - 1];
      old.image_a = old.image_b = nullptr;
      old.points = WithSurfaces(old.points);
    }
    return;
  }
}

std::optional<RecentPairs::Pair> RecentPairs::MakePair(const Map& map, const KeyframeView& view,
                                                       const Partner& partner,
                                                       const SensorCorrection::Vector& at) const {
  const Keyframe& keyframe = *map.FindKeyframe(view.id);
  const Frame& from = *keyframe.frame;
  const Frame& to = *partner.frame;
  const Rigid3 world_from_cam = keyframe.cam_from_world.Inverse();
  std::vector<PointCandidate> candidates;
  for (size_t i = 0; i < view.samples.size(); ++i) {
    const int feature = view.samples[i].feature;
    if (!from.points[feature].HasDepth()) continue;  // not where depth is registered otherwise
    PointCandidate candidate;
    candidate.id = static_cast<LandmarkId>(i);
    candidate.position = world_from_cam * from.PointInCamera(feature);
    candidate.descriptor = from.points[feature].descriptor;
    candidate.level = from.points[feature].level;
    if (ProjectCandidate(to.camera, partner.cam_from_world, &candidate)) {
      candidates.push_back(candidate);
    }
  }
  Pair pair;
  const double radius = kPairSearchRadius * to.camera.FocalLength();
  const auto matches = MatchPoints({}, to, candidates, radius, {});
  const size_t step = std::max<size_t>(1, matches.size() / kMaxMatches);
  for (size_t i = 0; i < matches.size(); i += step) {
    const Sample& sample = view.samples[matches[i].id];
    const PointFeature& in_a = from.points[sample.feature];
    const PointFeature& in_b = to.points[matches[i].feature];
    pair.points.push_back({sample.view, MakeView(to, in_b), in_a.inverse_depth,
                           in_a.sigma * in_a.sigma + in_b.sigma * in_b.sigma});
  }
  pair.image_a = view.image;
  pair.image_b = partner.image;
  FindSurfaces(at, &pair);
  if (WithSurfaces(pair.points).size() < kMinPairPoints) return std::nullopt;
  pair.b_from_a = partner.cam_from_world * world_from_cam;
  pair.squared_shift_rate = view.squared_shift_rate + SquaredShiftRate(to);
  return pair;
}

void RecentPairs::FindSurfaces(const SensorCorrection::Vector& at, Pair* pair) const {
  const LinearizedCamera camera(camera_, at);
  const auto find = [&](const RecordedImage& image, RgbdPairReprojection::View* view) {
    view->surface = FindSurface(camera, image, view->recorded_pixel).value_or(InverseDepthPlane());
  };
  for (CalibrationPoint& point : pair->points) {
    find(*pair->image_a, &point.a);
    find(*pair->image_b, &point.b);
  }
  pair->surfaces_at = at;
}

void RecentPairs::Linearize(const SensorCorrection::Vector& at, Pair* pair) const {
  pair->at = at;
  pair->readout_time = readout_time_;
  pair->information.reset();
  const double max_shift = kMaxSurfaceShift * ImageScale(camera_.camera().width);
  if (LargestDepthShift(camera_, pair->surfaces_at, at) > max_shift) {
    if (!pair->image_a) return;
    FindSurfaces(at, pair);
  }
  pair->information = LinearizePair(camera_, WithSurfaces(pair->points), at, &pair->b_from_a);
}

double RecentPairs::Distance(const Pair& pair, const SensorCorrection::Vector& at,
                             const SensorCorrection::Vector& sigma) const {
  return std::max(InSigmas(at - pair.at, sigma) / kMaxDistance,
                  std::abs(readout_time_ - pair.readout_time) / kMinReadoutChange);
}

void RecentPairs::Relinearize(const SensorCorrection::Vector& at,
                              const SensorCorrection::Vector& sigma, size_t max_pairs) {
  std::vector<std::pair<double, Pair*>> stale;
  for (Pair& pair : pairs_) {
    const double distance = Distance(pair, at, sigma);
    if (distance > 1.0) stale.emplace_back(-distance, &pair);
  }
  std::stable_sort(stale.begin(), stale.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (size_t i = 0; i < std::min(stale.size(), max_pairs); ++i) Linearize(at, stale[i].second);
}

void RecentPairs::Close(double readout_sigma) {
  closed_ = Sum(readout_sigma);
  views_.clear();
  pairs_.clear();
}

CalibrationInformation RecentPairs::Sum(double readout_sigma) const {
  if (closed_) return *closed_;
  CalibrationInformation sum;
  for (const Pair& pair : pairs_) {
    if (!pair.information) continue;
    sum += WithCommonError(
        *pair.information,
        CommonVariance(camera_.camera(), pair.squared_shift_rate, readout_time_, readout_sigma));
  }
  return sum;
}

}  // namespace msc_vo
