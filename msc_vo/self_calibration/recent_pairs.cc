// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/recent_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/self_calibration/pair_view.h"
#include "msc_vo/self_calibration/surface_plane.h"

namespace msc_vo {

namespace {

// Bounds of memory and of computing time.
constexpr size_t kMaxViews = 24;
constexpr size_t kMaxPairs = 160;
constexpr size_t kMaxSamples = 200;
constexpr size_t kMaxPoints = 60;
// Fewest points that make a pair worth its time.
constexpr size_t kMinPoints = 40;
// Search radius, pixels, as for recorded sequences.
constexpr double kSearchRadius = 30.0;
// Displacement, pixels, from which on a point tells no more about the calibration.
constexpr double kMaxDisplacement = 80.0;
// Smallest mean displacement of the points of a pair, pixels.
constexpr double kMinDisplacement = 20.0;
// Seconds; as for the compensation of keyframes.
constexpr double kMinReadoutChange = 0.001;
constexpr double kLargeReadoutChange = 0.005;
// Distance of the linearisation point that calls for a new one, standard deviations.
constexpr double kMaxDistance = 0.5;

double InSigmas(const SensorCorrection::Vector& difference, const SensorCorrection::Vector& sigma) {
  return difference.cwiseQuotient(sigma).cwiseAbs().maxCoeff();
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
          {image.frame.get(), image.depth,
           image.cam_from_reference * map.CamFromWorld(image.reference)},
          at);
}

void RecentPairs::AddKeyframe(const Map& map, KeyframeId id, const cv::Mat& depth,
                              const SensorCorrection::Vector& at) {
  const Keyframe& keyframe = *map.FindKeyframe(id);
  const Frame& frame = *keyframe.frame;
  AddPair(map, {&frame, depth, keyframe.cam_from_world}, at);
  KeyframeView view{id, {}, SquaredShiftRate(frame)};
  const size_t step = std::max<size_t>(1, frame.points.size() / kMaxSamples);
  for (size_t i = 0; i < frame.points.size(); i += step) {
    const PointFeature& point = frame.points[i];
    if (point.dynamic || !point.HasDepth()) continue;
    Sample sample{static_cast<int>(i), MakeView(frame, point)};
    const auto surface = FindSurface(camera_, depth, sample.view.recorded_pixel, at);
    if (!surface) continue;
    sample.view.surface = *surface;
    view.samples.push_back(sample);
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
  // Sum of the displacements of the points that both images show.
  std::vector<std::pair<double, const KeyframeView*>> ranked;
  for (const KeyframeView& view : views_) {
    const Keyframe* keyframe = map.FindKeyframe(view.id);
    if (keyframe == nullptr) continue;
    const Frame& frame = *keyframe->frame;
    const Rigid3 b_from_a = partner.cam_from_world * keyframe->cam_from_world.Inverse();
    double sum = 0.0;
    size_t count = 0;
    for (const Sample& sample : view.samples) {
      const Eigen::Vector3d in_b = b_from_a * frame.PointInCamera(sample.feature);
      if (in_b.z() < 0.1) continue;
      const Eigen::Vector2d pixel = frame.camera.Project(in_b);
      if (!frame.camera.IsInside(pixel)) continue;
      sum += std::min((pixel - frame.points[sample.feature].pixel).norm(), kMaxDisplacement);
      ++count;
    }
    if (count >= kMinPoints && sum > kMinDisplacement * static_cast<double>(count)) {
      ranked.emplace_back(-sum, &view);
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [score, view] : ranked) {
    std::optional<Pair> pair = MakePair(map, *view, partner, at);
    if (!pair) continue;
    Linearize(at, &*pair);
    pairs_.push_back(std::move(*pair));
    if (pairs_.size() > kMaxPairs) pairs_.pop_front();
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
  const auto matches = MatchPoints({}, to, candidates, kSearchRadius, {});
  const size_t step = std::max<size_t>(1, matches.size() / kMaxPoints);
  for (size_t i = 0; i < matches.size(); i += step) {
    const Sample& sample = view.samples[matches[i].id];
    const PointFeature& in_a = from.points[sample.feature];
    const PointFeature& in_b = to.points[matches[i].feature];
    CalibrationPoint point{sample.view, MakeView(to, in_b), in_a.inverse_depth,
                           in_a.sigma * in_a.sigma + in_b.sigma * in_b.sigma};
    const auto surface = FindSurface(camera_, partner.depth, point.b.recorded_pixel, at);
    if (!surface) continue;
    point.b.surface = *surface;
    pair.points.push_back(point);
  }
  if (pair.points.size() < kMinPoints) return std::nullopt;
  pair.b_from_a = partner.cam_from_world * world_from_cam;
  pair.squared_shift_rate = view.squared_shift_rate + SquaredShiftRate(to);
  return pair;
}

void RecentPairs::Linearize(const SensorCorrection::Vector& at, Pair* pair) const {
  pair->at = at;
  pair->readout_time = readout_time_;
  pair->information = LinearizePair(camera_, pair->points, at, &pair->b_from_a);
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

CalibrationInformation RecentPairs::Sum(double readout_sigma) const {
  CalibrationInformation sum;
  for (const Pair& pair : pairs_) {
    if (!pair.information) continue;
    sum += WithCommonError(*pair.information,
                           CommonVariance(pair.squared_shift_rate, readout_time_, readout_sigma));
  }
  return sum;
}

}  // namespace msc_vo
