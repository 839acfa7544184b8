// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_track.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <utility>

#include "msc_vo/datasets/rgbd_source.h"
#include "msc_vo/diagnosis/calibration_views.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"

namespace msc_vo {

namespace {

constexpr int kStretches = 4;
// Pairs: times in seconds, angles in radians.
constexpr double kMinPairTime = 0.25, kMaxPairTime = 1.5, kMaxPairAngle = 0.45;
constexpr int kMaxPairs = 80;
// Map points that two images must share for a median motion.
constexpr size_t kMinPoints = 10;

struct Stretch {
  int begin = 0;
  int end = 0;
};

std::vector<Stretch> Stretches(int size, int max_images) {
  if (size <= max_images) return {{0, size}};
  const int length = max_images / kStretches;
  std::vector<Stretch> stretches;
  for (int s = 0; s < kStretches; ++s) {
    const auto begin =
        static_cast<int>(static_cast<int64_t>(s) * (size - length) / (kStretches - 1));
    stretches.push_back({begin, begin + length});
  }
  return stretches;
}

// Pixels of the map points in an image.
using Observations = std::map<LandmarkId, Eigen::Vector2d>;

Observations ObservationsOf(const TrackedImage& image) {
  Observations observations;
  for (const PointMatch& match : image.tracked.matches.points) {
    observations[match.id] = image.features.points[match.feature].pixel;
  }
  return observations;
}

// Sets displacement and velocity since the image before, `seconds` ago.
void MeasureFlow(const Observations& before, const Observations& now, double seconds,
                 MotionImage* image) {
  std::vector<double> x, y, lengths;
  for (const auto& [id, pixel] : now) {
    const auto other = before.find(id);
    if (other == before.end()) continue;
    const Eigen::Vector2d flow = pixel - other->second;
    x.push_back(flow.x());
    y.push_back(flow.y());
    lengths.push_back(flow.norm());
  }
  image->linked = lengths.size() >= kMinPoints;
  if (!image->linked) return;
  image->displacement = Median(std::move(lengths));
  image->velocity = Eigen::Vector2d(Median(std::move(x)), Median(std::move(y))) / seconds;
}

class MotionTracker {
 public:
  MotionTracker(const RgbdDecoder& decoder, const OdometryOptions& options, size_t max_views)
      : decoder_(decoder), options_(options), max_views_(max_views) {}

  void Add(const Stretch& stretch) {
    const Calibration& calibration = decoder_.calibration();
    Odometry odometry(options_, calibration.camera, calibration.distortion);
    odometry.SkipClippedDepthSearch();
    std::map<int64_t, MotionImage> images;  // by FrameResult::id
    Observations before, now;
    odometry.SetTrackingObserver([&now](const TrackedImage& i) { now = ObservationsOf(i); });
    RgbdSource source(decoder_, stretch.begin, stretch.end);
    for (;;) {
      try {
        RgbdImage rgbd;
        if (!source.Next(&rgbd)) break;
        const FrameResult frame = odometry.Process(rgbd);
        MotionImage image;
        image.timestamp = frame.timestamp;
        image.depth_delay = rgbd.depth_delay;
        image.edges = AlignEdges(rgbd.gray, rgbd.depth, /*with_fine=*/false);
        const auto last = images.find(frame.id - 1);
        if (last != images.end()) {
          MeasureFlow(before, now, frame.timestamp - last->second.timestamp, &image);
        }
        images.emplace(frame.id, std::move(image));
        before = std::exchange(now, {});
      } catch (const std::exception&) {
        continue;
      }
    }
    track_.num_images += static_cast<int>(images.size());
    AddResult(odometry.Finish(), &images);
    AddCalibration(odometry);
  }

  MotionTrack Finish() {
    AddPairs();
    return std::move(track_);
  }

 private:
  // The tracked images.
  void AddResult(const OdometryResult& result, std::map<int64_t, MotionImage>* images) {
    track_.noise_scales.push_back(result.noise_scale);
    const int first_segment = track_.images.empty() ? 0 : track_.images.back().segment + 1;
    bool was_added = false;
    for (const FrameResult& frame : result.frames) {
      const auto found = images->find(frame.id);
      const bool has_image = found != images->end();
      if (has_image && frame.status == TrackingStatus::kWeak) ++track_.num_weak;
      const bool is_added = has_image && frame.status == TrackingStatus::kTracked;
      if (is_added) {
        MotionImage& image = found->second;
        image.cam_from_world = frame.cam_from_world;
        image.segment = first_segment + frame.segment;
        image.linked &= was_added && track_.images.back().segment == image.segment;
        track_.images.push_back(std::move(image));
      }
      was_added = is_added;
    }
    track_.views.push_back(MakeCalibrationViews(decoder_, options_.features, result, max_views_));
  }

  void AddCalibration(Odometry& odometry) {
    const Calibration& calibration = decoder_.calibration();
    const auto of_map =
        SelfCalibratingBundleAdjustment({calibration.camera, calibration.distortion},
                                        odometry.Map()->map, SensorCorrection::Vector::Zero());
    if (of_map) track_.of_maps += *of_map;
  }

  // The later image of the pair that begins with `from`: the one with the largest rotation.
  std::optional<int> Partner(int from) const {
    const std::vector<MotionImage>& images = track_.images;
    std::optional<int> best;
    double best_angle = -1.0;
    for (int to = from + 1; to < static_cast<int>(images.size()); ++to) {
      const double seconds = images[to].timestamp - images[from].timestamp;
      if (images[to].segment != images[from].segment || seconds > kMaxPairTime) break;
      const double angle = LogSO3(track_.MotionOf({from, to}).rotation()).norm();
      if (seconds < kMinPairTime || angle > kMaxPairAngle || angle <= best_angle) continue;
      best = to;
      best_angle = angle;
    }
    return best;
  }

  void AddPairs() {
    const int size = static_cast<int>(track_.images.size());
    const int step = std::max(1, size / kMaxPairs);
    for (int from = 0; from < size; from += step) {
      const std::optional<int> to = Partner(from);
      if (to) track_.pairs.push_back({from, *to});
    }
  }

  const RgbdDecoder& decoder_;
  OdometryOptions options_;
  size_t max_views_;  // of a stretch
  MotionTrack track_;
};

// The calibration is estimated afterwards, from all images at once.
OdometryOptions WithGivenCalibration(OdometryOptions options, const Calibration& calibration) {
  options.mapping.self_calibration = false;
  if (!options.mapping.readout_time) options.mapping.readout_time = calibration.readout_time;
  return options;
}

}  // namespace

MotionTrack TrackMotion(const RgbdDecoder& decoder, const OdometryOptions& options,
                        int max_images) {
  const std::vector<Stretch> stretches = Stretches(decoder.size(), max_images);
  MotionTracker tracker(decoder, WithGivenCalibration(options, decoder.calibration()),
                        kMaxCalibrationViews / stretches.size());
  for (const Stretch& stretch : stretches) tracker.Add(stretch);
  return tracker.Finish();
}

}  // namespace msc_vo
