// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_track.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "msc_vo/diagnosis/quantile.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/sensor/depth_alignment.h"

namespace msc_vo {

namespace {

constexpr int kStretches = 4;
// Search radii from image to image and between the images of a pair, as fractions of the width.
constexpr double kSearchRadii[] = {0.05, 0.12};
constexpr double kPairRadius = 0.04;
// Pairs: times in seconds, angles in radians.
constexpr double kMinPairTime = 0.25, kMaxPairTime = 1.5, kMaxPairAngle = 0.45;
constexpr int kMaxPairs = 80;
// About as many images keep their depth: a bound of the memory.
constexpr size_t kDepthImages = 80;

// Indices of the images to track; stretches begin where the index jumps.
std::vector<int> Stretches(int size, int max_images) {
  std::vector<int> indices;
  if (size <= max_images) {
    for (int i = 0; i < size; ++i) indices.push_back(i);
    return indices;
  }
  const int length = max_images / kStretches;
  for (int s = 0; s < kStretches; ++s) {
    const auto begin =
        static_cast<int>(static_cast<int64_t>(s) * (size - length) / (kStretches - 1));
    for (int i = 0; i < length; ++i) {
      if (indices.empty() || begin + i > indices.back()) indices.push_back(begin + i);
    }
  }
  return indices;
}

class MotionTracker {
 public:
  // The depth of every `depth_step`-th image is kept.
  MotionTracker(const RgbdDecoder& decoder, const FrameBuilderOptions& features, size_t depth_step)
      : decoder_(decoder),
        depth_step_(depth_step),
        builder_(features, decoder.calibration().camera, decoder.calibration().distortion) {}

  void Add(int index) {
    MotionImage image;
    std::optional<Frame> frame = Build(index, &image);
    if (!frame) return;
    image.timestamp = frame->timestamp;
    image.frame = std::make_shared<const Frame>(*std::move(frame));
    if (!track_.images.empty() && index == last_index_ + 1) {
      ++track_.num_pairs;
      Link(track_.images.back(), &image);
      if (image.linked) ++track_.num_linked;
    }
    if (!image.linked) {
      image.segment = track_.images.empty() ? 0 : track_.images.back().segment + 1;
      velocity_ = Rigid3();
      interval_ = 0.0;
    }
    last_index_ = index;
    track_.images.push_back(std::move(image));
  }

  MotionTrack Finish() {
    AddVelocities();
    AddPairs();
    return std::move(track_);
  }

 private:
  std::optional<Frame> Build(int index, MotionImage* image) {
    try {
      RgbdImage rgbd = decoder_.Decode(index);
      image->edges = AlignEdges(rgbd.gray, rgbd.depth, false);
      image->depth_delay = rgbd.depth_delay;
      if (rgbd.depth_delay != 0.0 && interval_ > 0.0) {
        rgbd.depth = AlignDepth(decoder_.calibration().camera, rgbd.depth,
                                Fraction(rgbd.depth_delay / interval_));
      }
      Frame frame = builder_.Build(rgbd);
      if (track_.images.size() % depth_step_ == 0) {
        const FrameBuilderOptions options;
        image->depth = std::make_shared<const InverseDepthImage>(rgbd.depth, options.min_depth,
                                                                 options.max_depth);
      }
      return frame;
    } catch (const std::exception&) {
      return std::nullopt;  // reported by the check of the images
    }
  }

  // A fraction of the last motion.
  Rigid3 Fraction(double fraction) const {
    const Eigen::Vector3d rotation = LogSO3(Eigen::Quaterniond(velocity_.rotation()));
    return {ExpSO3(fraction * rotation), fraction * velocity_.translation()};
  }

  void Link(const MotionImage& before, MotionImage* image) {
    for (const double fraction : kSearchRadii) {
      for (const Rigid3& guess : {velocity_, Rigid3()}) {
        const std::optional<FrameMotion> motion = EstimateFrameMotion(
            *before.frame, *image->frame, guess, fraction * decoder_.calibration().camera.width);
        if (!motion) continue;
        velocity_ = motion->to_from_from;
        interval_ = image->timestamp - before.timestamp;
        image->linked = true;
        image->segment = before.segment;
        image->cam_from_origin = motion->to_from_from * before.cam_from_origin;
        MeasureFlow(*motion, image->timestamp - before.timestamp, image);
        return;
      }
    }
  }

  static void MeasureFlow(const FrameMotion& motion, double seconds, MotionImage* image) {
    std::vector<double> x, y, lengths;
    for (const PointPair& pair : motion.points) {
      const Eigen::Vector2d flow = pair.to.pixel - pair.from.pixel;
      x.push_back(flow.x());
      y.push_back(flow.y());
      lengths.push_back(flow.norm());
    }
    image->displacement = Median(std::move(lengths));
    if (seconds <= 0.0) return;
    image->velocity = Eigen::Vector2d(Median(std::move(x)), Median(std::move(y))) / seconds;
  }

  // Central differences; the ends of a segment take the one side that there is.
  void AddVelocities() {
    const int size = static_cast<int>(track_.images.size());
    for (int i = 0; i < size; ++i) {
      const int segment = track_.images[i].segment;
      const int from = i > 0 && track_.images[i - 1].segment == segment ? i - 1 : i;
      const int to = i + 1 < size && track_.images[i + 1].segment == segment ? i + 1 : i;
      const double seconds = track_.images[to].timestamp - track_.images[from].timestamp;
      if (seconds <= 0.0) continue;
      const Rigid3 motion = Between(from, to);
      track_.images[i].camera_velocity = {LogSO3(Eigen::Quaterniond(motion.rotation())) / seconds,
                                          motion.translation() / seconds};
    }
  }

  Rigid3 Between(int from, int to) const {
    return track_.images[to].cam_from_origin * track_.images[from].cam_from_origin.Inverse();
  }

  // The later image of the pair that begins with `from`: the one with the largest rotation.
  std::optional<int> Partner(int from) const {
    const std::vector<MotionImage>& images = track_.images;
    std::optional<int> best;
    double best_angle = -1.0;
    for (int to = from + 1; to < static_cast<int>(images.size()); ++to) {
      const double seconds = images[to].timestamp - images[from].timestamp;
      if (images[to].segment != images[from].segment || seconds > kMaxPairTime) break;
      const double angle = LogSO3(Eigen::Quaterniond(Between(from, to).rotation())).norm();
      if (seconds < kMinPairTime || angle > kMaxPairAngle || angle <= best_angle) continue;
      best = to;
      best_angle = angle;
    }
    return best;
  }

  void AddPairs() {
    const int size = static_cast<int>(track_.images.size());
    const int step = std::max(1, size / kMaxPairs);
    const double radius = kPairRadius * decoder_.calibration().camera.width;
    for (int from = 0; from < size; from += step) {
      const std::optional<int> to = Partner(from);
      if (!to) continue;
      std::optional<FrameMotion> motion = EstimateFrameMotion(
          *track_.images[from].frame, *track_.images[*to].frame, Between(from, *to), radius);
      if (motion) track_.pairs.push_back({from, *to, *std::move(motion)});
    }
  }

  const RgbdDecoder& decoder_;
  size_t depth_step_;
  FrameBuilder builder_;
  MotionTrack track_;
  Rigid3 velocity_;        // motion from the image before the last one to the last one
  double interval_ = 0.0;  // seconds between these; 0: unknown
  int last_index_ = -2;
};

}  // namespace

MotionTrack TrackMotion(const RgbdDecoder& decoder, const FrameBuilderOptions& features,
                        int max_images) {
  const std::vector<int> indices = Stretches(decoder.size(), max_images);
  MotionTracker tracker(decoder, features, std::max<size_t>(1, indices.size() / kDepthImages));
  for (const int index : indices) tracker.Add(index);
  return tracker.Finish();
}

}  // namespace msc_vo
