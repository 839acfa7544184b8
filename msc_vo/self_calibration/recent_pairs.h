// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/map/map.h"
#include "msc_vo/self_calibration/pair_linearization.h"
#include "msc_vo/sensor/recorded_image.h"

namespace msc_vo {

/// A tracked image for self-calibration.
struct CalibrationImage {
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const RecordedImage> image;
  /// Its pose relative to a keyframe.
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
};

/// Points that recent images have in common with keyframes, for self-calibration during a run. They
/// refer to the recorded images, so that they stay valid when the calibration changes.
class RecentPairs {
 public:
  /// `given`: the calibration that corrections refer to.
  explicit RecentPairs(const CameraIntrinsics& given);

  /// Forms a pair of the image with the most informative keyframe for the calibration. All frames
  /// must know their intrinsics.
  void AddImage(const Map& map, const CalibrationImage& image, const SensorCorrection::Vector& at);
  /// The same for a keyframe of the map, with which later images form pairs.
  void AddKeyframe(const Map& map, KeyframeId id, const std::shared_ptr<const RecordedImage>& image,
                   const SensorCorrection::Vector& at);
  /// Compensates the rolling shutter with another readout time (seconds), if it differs by more
  /// than a millisecond, as for keyframes. Pairs are linearised again at once if it differs by more
  /// than five, and by Relinearize() otherwise.
  void SetReadoutTime(double readout_time);

  /// Linearises those pairs again that were linearised farthest from `at`, in units of `sigma`, or
  /// from the readout time, at most `max_pairs`, and only if they were linearised half a sigma or a
  /// millisecond away.
  void Relinearize(const SensorCorrection::Vector& at, const SensorCorrection::Vector& sigma,
                   size_t max_pairs);
  /// Sum over all pairs. `readout_sigma` (seconds): uncertainty of the readout time of a rolling
  /// shutter.
  CalibrationInformation Sum(double readout_sigma) const;
  /// Keeps the sum alone from now on, and frees the memory of pairs and images.
  void Close(double readout_sigma);
  bool is_closed() const { return closed_.has_value(); }
  size_t size() const { return pairs_.size(); }
  /// Number of pairs so far; old ones are forgotten.
  size_t num_added() const { return num_added_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [camera, readout_time, views, pairs, num_added, closed] = *this;  // all members
    archive(readout_time, views, pairs, num_added, closed);
  }

 private:
  // A point of a keyframe, without its surface.
  struct Sample {
    int feature = 0;
    RgbdPairReprojection::View view;
  };
  struct KeyframeView {
    KeyframeId id = kNoId;
    std::vector<Sample> samples;
    double squared_shift_rate = 0.0;
    std::shared_ptr<const RecordedImage> image;
  };
  struct Pair {
    std::vector<CalibrationPoint> points;  // some have no surface
    Rigid3 b_from_a;
    double squared_shift_rate = 0.0;  // sum over both images
    // Null once the pair is old: surfaces are not looked for again, and points have one.
    std::shared_ptr<const RecordedImage> image_a, image_b;
    SensorCorrection::Vector surfaces_at = SensorCorrection::Vector::Zero();
    SensorCorrection::Vector at = SensorCorrection::Vector::Zero();  // of the linearisation
    double readout_time = 0.0;                                       // the same
    std::optional<CalibrationInformation> information;
  };
  // The image that pairs are formed with.
  struct Partner {
    const Frame* frame;
    std::shared_ptr<const RecordedImage> image;
    Rigid3 cam_from_world;
  };

  // The pixels of a point with the readout time in use.
  RgbdPairReprojection::View MakeView(const Frame& frame, const PointFeature& point) const;
  // Adds the pair of the image with the best keyframe.
  void AddPair(const Map& map, const Partner& partner, const SensorCorrection::Vector& at);
  std::optional<Pair> MakePair(const Map& map, const KeyframeView& view, const Partner& partner,
                               const SensorCorrection::Vector& at) const;
  // Looks for the surfaces of all points where the correction says that they are.
  void FindSurfaces(const SensorCorrection::Vector& at, Pair* pair) const;
  void Linearize(const SensorCorrection::Vector& at, Pair* pair) const;
  // How far from `at` and from the readout time the pair was linearised; above 1: too far.
  double Distance(const Pair& pair, const SensorCorrection::Vector& at,
                  const SensorCorrection::Vector& sigma) const;

  CorrectedCamera camera_;
  double readout_time_ = 0.0;
  std::deque<KeyframeView> views_;
  std::deque<Pair> pairs_;
  size_t num_added_ = 0;
  std::optional<CalibrationInformation> closed_;  // the last sum
};

}  // namespace msc_vo
