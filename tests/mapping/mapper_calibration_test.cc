// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// How a mapper brings its maps up to date with another calibration.

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/simulated_camera.h"
#include <gtest/gtest.h>

#include "msc_vo/mapping/mapper.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

S::Vector With(S::Index index, double value) {
  S::Vector truth = S::Vector::Zero();
  truth(index) = value;
  return truth;
}

S::Vector UnregisteredWithAnotherFocalLength() {
  S::Vector truth = With(S::kDepthFocalLength, 0.06);
  truth(S::kFocalLength) = -0.04;
  return truth;
}

// All keyframes stay in the map.
MapperOptions Options() {
  MapperOptions options;
  options.culling.redundant_ratio = 1.0;
  options.readout_time = 0.0;
  return options;
}

// A mapper whose keyframes are those of a simulated camera. All frames have the given calibration.
class CalibratingMapper {
 public:
  explicit CalibratingMapper(const S::Vector& truth) : camera_(truth, 1), mapper_(Options()) {
    mapper_.BeginSelfCalibration(camera_.given(),
                                 [this](const Frame& frame, const RecordedImage& image,
                                        const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
                                   ++num_measured_[frame.id];
                                   return MeasureSimulatedDepth(frame, image.Depth(), intrinsics);
                                 });
  }

  // The packet of the next pose of the trajectory.
  KeyframePacket NextPacket() {
    const Image image = Record();
    KeyframePacket packet;
    packet.frame = image.frame;
    packet.image = image.image;
    packet.cam_from_reference = image.cam_from_world;
    Match(&packet);
    return packet;
  }
  // The same with images since the last packet, if there is one.
  KeyframePacket NextPacket(int num_images) {
    if (mapper_.map().keyframes().empty()) return NextPacket();
    std::vector<CalibrationImage> images;
    const KeyframeId reference = mapper_.Snapshot()->newest_keyframe;
    for (int i = 0; i < num_images; ++i) {
      const Image image = Record();
      images.push_back({image.frame, image.image, reference,
                        image.cam_from_world * mapper_.map().CamFromWorld(reference).Inverse()});
    }
    KeyframePacket packet = NextPacket();
    packet.calibration_images = std::move(images);
    return packet;
  }
  KeyframePacket NextPacketWithoutImage() {
    KeyframePacket packet = NextPacket();
    packet.image = nullptr;
    return packet;
  }

  MappingSummary Process(const KeyframePacket& packet) { return mapper_.Process(packet); }
  // Processes keyframes until the calibration changes, and returns the summary of the last one.
  MappingSummary ProcessUntilChange(int num_images) {
    MappingSummary summary;
    for (int i = 0; i < 20 && !summary.calibration; ++i) {
      summary = mapper_.Process(NextPacket(num_images));
    }
    EXPECT_TRUE(summary.calibration);
    return summary;
  }
  // Continues with another camera.
  void SetCamera(const S::Vector& truth) {
    camera_ = SimulatedCamera(truth, 1);
    images_.clear();
  }

  Mapper& mapper() { return mapper_; }
  const Frame& FrameOf(KeyframeId id) const {
    return *mapper_.atlas().FindSubMapOf(id)->map.FindKeyframe(id)->frame;
  }
  std::shared_ptr<const CameraIntrinsics> present() const {
    return mapper_.calibration().intrinsics()->present();
  }
  int NumMeasured(KeyframeId id) { return num_measured_[FrameOf(id).id]; }

 private:
  struct Image {
    std::shared_ptr<const Frame> frame;
    std::shared_ptr<const RecordedImage> image;
    Rigid3 cam_from_world;
  };

  // The trajectory repeats.
  Image Record() {
    Image& known = images_[next_ % 12];
    if (!known.frame) {
      known.cam_from_world = SimulatedCamera::PoseOf(next_ % 12);
      const auto [simulated, depth] = camera_.Record(known.cam_from_world);
      const cv::Mat gray(depth.size(), CV_8UC1, cv::Scalar(128));  // without edges
      known.frame = simulated;
      known.image = std::make_shared<RecordedImage>(gray, depth, DepthSensor::kStructuredLight);
    }
    const auto frame = std::make_shared<Frame>(*known.frame);
    frame->id = next_;
    frame->timestamp = 0.2 * next_++;
    return {frame, known.image, known.cam_from_world};
  }
  // Descriptors of the simulated camera have no noise.
  void Match(KeyframePacket* packet) const {
    std::map<Descriptor, LandmarkId> landmarks;
    for (const auto& [id, point] : mapper_.map().points()) landmarks[point.descriptor] = id;
    for (size_t i = 0; i < packet->frame->points.size(); ++i) {
      const auto found = landmarks.find(packet->frame->points[i].descriptor);
      if (found == landmarks.end()) continue;
      packet->matches.points.push_back({static_cast<int>(i), found->second,
                                        mapper_.map().Find<PointLandmark>(found->second)->position,
                                        true});
    }
  }

  SimulatedCamera camera_;
  Mapper mapper_;
  int next_ = 0;
  std::map<int, Image> images_;
  std::map<int64_t, int> num_measured_;  // by frame
};

int CountDepths(const Frame& frame) {
  return static_cast<int>(
      std::count_if(frame.points.begin(), frame.points.end(),
                    [](const PointFeature& point) { return point.HasDepth(); }));
}

// The frame has other intrinsics, and its features are where these have them.
void ExpectUpToDate(const Frame& frame, const Frame& recorded,
                    const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  EXPECT_EQ(frame.intrinsics, intrinsics);
  EXPECT_EQ(frame.camera.fx, intrinsics->camera.fx);
  ASSERT_EQ(frame.points.size(), recorded.points.size());
  for (size_t i = 0; i < frame.points.size(); ++i) {
    const Eigen::Vector2d pixel =
        MovePixel(*recorded.intrinsics, *intrinsics, recorded.points[i].pixel);
    EXPECT_LT((frame.points[i].pixel - pixel).norm(), 1e-6);
  }
}

// Returns the largest displacement of a feature between two frames, pixels.
double LargestMove(const Frame& a, const Frame& b) {
  double largest = 0.0;
  for (size_t i = 0; i < a.points.size(); ++i) {
    largest = std::max(largest, (a.points[i].pixel - b.points[i].pixel).norm());
  }
  return largest;
}

void ExpectSameDepths(const Frame& a, const Frame& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].inverse_depth, b.points[i].inverse_depth);
    EXPECT_EQ(a.points[i].inverse_depth_sigma, b.points[i].inverse_depth_sigma);
  }
}

TEST(MapperCalibration, BringsPacketsThatAreOlderThanTheCalibrationUpToDate) {
  CalibratingMapper run(With(S::kK1, -0.1));
  run.ProcessUntilChange(3);
  const auto present = run.present();
  const KeyframePacket old = run.NextPacketWithoutImage();
  ASSERT_NE(old.frame->intrinsics, present);
  const MappingSummary summary = run.Process(old);
  const Frame& frame = run.FrameOf(summary.keyframe);
  ExpectUpToDate(frame, *old.frame, present);
  ExpectSameDepths(frame, *old.frame);
  EXPECT_GT(LargestMove(frame, *old.frame), 2.0);
}

void Insert(const KeyframePacket& packet, Mapper* mapper) {
  KeyframeTask task(packet);
  while (!task.IsInserted()) mapper->Advance(&task);
}

TEST(MapperCalibration, MeasuresDepthsOfOlderPacketsInTheirImages) {
  CalibratingMapper run(With(S::kDepthFocalLength, 0.1));
  run.ProcessUntilChange(3);
  ASSERT_TRUE(run.present()->registration);
  const KeyframePacket with_image = run.NextPacket();
  Insert(with_image, &run.mapper());
  const Frame& measured = run.FrameOf(run.mapper().Snapshot()->newest_keyframe);
  EXPECT_EQ(measured.intrinsics, run.present());
  ExpectSameDepths(measured, *MeasureSimulatedDepth(*with_image.frame, with_image.image->Depth(),
                                                    run.present()));
  const KeyframePacket without_image = run.NextPacketWithoutImage();
  Insert(without_image, &run.mapper());
  const Frame& unmeasured = run.FrameOf(run.mapper().Snapshot()->newest_keyframe);
  EXPECT_EQ(unmeasured.intrinsics, run.present());
  EXPECT_EQ(CountDepths(unmeasured), 0);  // they would be those of other pixels
}

// The registration changes twice. A keyframe that was recorded between both has no image.
TEST(MapperCalibration, KeepsRegisteredDepthsOfKeyframesWithoutImages) {
  CalibratingMapper run(UnregisteredWithAnotherFocalLength());
  const KeyframeId unregistered = run.Process(run.NextPacketWithoutImage()).keyframe;
  const KeyframeId with_image = run.Process(run.NextPacket()).keyframe;
  run.ProcessUntilChange(7);
  ASSERT_TRUE(run.present()->registration);
  EXPECT_EQ(CountDepths(run.FrameOf(unregistered)), 0);
  EXPECT_EQ(run.NumMeasured(with_image), 1);
  KeyframePacket packet = run.NextPacket();
  packet.frame = MeasureSimulatedDepth(*packet.frame, packet.image->Depth(), run.present());
  packet.image = nullptr;
  const KeyframeId registered = run.Process(packet).keyframe;
  const auto before = run.present();
  run.ProcessUntilChange(7);
  const auto present = run.present();
  ASSERT_FALSE(HasSameRegistration(*before, *present));
  ExpectUpToDate(run.FrameOf(registered), *packet.frame, present);
  ExpectSameDepths(run.FrameOf(registered), *packet.frame);
  EXPECT_GT(CountDepths(run.FrameOf(registered)), 100);
  EXPECT_EQ(run.NumMeasured(registered), 0);
  EXPECT_EQ(run.NumMeasured(with_image), 2);
  EXPECT_EQ(run.FrameOf(unregistered).intrinsics, present);
  EXPECT_EQ(CountDepths(run.FrameOf(unregistered)), 0);
}

// Points of a map are where their first observations with a depth measure them.
void ExpectPointsAtMeasurements(const Map& map) {
  for (const auto& [id, point] : map.points()) {
    for (const Observation& observation : point.observations) {
      const Keyframe& keyframe = *map.FindKeyframe(observation.keyframe);
      if (!keyframe.frame->points[observation.feature].HasDepth()) continue;
      const Eigen::Vector3d measured =
          keyframe.cam_from_world.Inverse() * keyframe.frame->PointInCamera(observation.feature);
      EXPECT_LT((point.position - measured).norm(), 1e-9);
      break;
    }
  }
}

TEST(MapperCalibration, BringsInactiveMapsUpToDate) {
  CalibratingMapper run(With(S::kK1, -0.1));
  const std::vector<KeyframePacket> packets = {run.NextPacketWithoutImage(),
                                               run.NextPacketWithoutImage()};
  for (const KeyframePacket& packet : packets) run.Process(packet);
  KeyframePacket first = run.NextPacket();
  first.begins_map = true;
  first.matches = {};
  run.Process(first);
  const MapSnapshotPtr before = run.mapper().Snapshot();
  ASSERT_EQ(before->inactive_maps.size(), 1u);
  const MappingSummary summary = run.ProcessUntilChange(3);
  const MapSnapshotPtr after = run.mapper().Snapshot();
  ASSERT_EQ(after->inactive_maps.size(), 1u);
  const Map& map = *after->inactive_maps[0];
  const Map& old_map = *before->inactive_maps[0];
  ASSERT_EQ(map.keyframes().size(), 2u);
  ASSERT_GT(map.points().size(), 100u);
  for (KeyframeId id = 0; id < 2; ++id) {
    const Frame& recorded = *packets[id].frame;
    const Frame& frame = *map.FindKeyframe(id)->frame;
    ExpectUpToDate(frame, recorded, run.present());
    ExpectSameDepths(frame, recorded);
    EXPECT_GT(LargestMove(frame, recorded), 2.0);
    EXPECT_EQ(map.CamFromWorld(id).params, old_map.CamFromWorld(id).params);
    EXPECT_EQ(old_map.FindKeyframe(id)->frame->intrinsics, recorded.intrinsics);
  }
  ExpectPointsAtMeasurements(map);
  const InactiveMaps& maps_before = summary.calibration->maps_before;
  ASSERT_EQ(maps_before.size(), 2u);
  EXPECT_EQ(maps_before[0], before->inactive_maps[0]);
  EXPECT_EQ(maps_before[1]->FindKeyframe(2)->frame->intrinsics, packets[0].frame->intrinsics);
}

// The first three keyframes are found in the map of the earlier session, which has the right
// calibration, before that of the run is corrected.
TEST(MapperCalibration, KeepsTheAxesOfTheEarlierSessionThatTheMapWasJoinedWith) {
  CalibratingMapper earlier(S::Vector::Zero());
  for (int i = 0; i < 3; ++i) earlier.Process(earlier.NextPacketWithoutImage());
  std::vector<SavedSubMap> saved = earlier.mapper().ShareSubMaps();
  saved[0].axes = AxesEstimate{Eigen::Quaterniond::Identity(), 0.001, 0.002};
  const Rigid3 reference = saved[0].map.CamFromWorld(0);
  CalibratingMapper run(With(S::kK1, -0.1));
  run.mapper().BeginWith(std::move(saved), {}, run.present()->camera);
  for (int i = 0; i < 3; ++i) {
    KeyframePacket packet = run.NextPacketWithoutImage();
    packet.covariance = 1e-3 * PoseCovariance::Identity();
    packet.revisit = Revisit{
        0, packet.cam_from_reference * reference.Inverse(), 1e-3 * PoseCovariance::Identity(), {}};
    run.Process(packet);
  }
  ASSERT_EQ(run.mapper().atlas().current().id, 0);
  run.ProcessUntilChange(3);
  const std::optional<AxesEstimate> axes = run.mapper().ShareSubMaps().at(0).axes;
  ASSERT_TRUE(axes);
  EXPECT_TRUE(axes->world_from_axes.isApprox(Eigen::Quaterniond::Identity(), 1e-3));
}

TEST(MapperCalibration, MeasuresDepthsOfInactiveMapsIfTheirImagesAreKept) {
  CalibratingMapper run(With(S::kDepthFocalLength, 0.1));
  const KeyframePacket with_image = run.NextPacket();
  run.Process(with_image);
  run.Process(run.NextPacketWithoutImage());
  KeyframePacket first = run.NextPacket();
  first.begins_map = true;
  first.matches = {};
  run.Process(first);
  run.ProcessUntilChange(3);
  ASSERT_EQ(run.mapper().atlas().inactive_maps().size(), 1u);
  ExpectSameDepths(
      run.FrameOf(0),
      *MeasureSimulatedDepth(*with_image.frame, with_image.image->Depth(), run.present()));
  EXPECT_EQ(CountDepths(run.FrameOf(1)), 0);
}

// Once the calibration has settled, a run continues without images.
TEST(MapperCalibration, CorrectsASettledCalibrationWithoutImages) {
  S::Vector truth = UnregisteredWithAnotherFocalLength();
  CalibratingMapper run(truth);
  for (int i = 0; i < 25 && !run.mapper().Snapshot()->calibration_is_settled; ++i) {
    run.Process(run.NextPacket(i < 3 ? 0 : 10));
  }
  ASSERT_TRUE(run.mapper().Snapshot()->calibration_is_settled);
  const auto settled = run.present();
  ASSERT_TRUE(settled->registration);
  const KeyframeId last = run.mapper().Snapshot()->newest_keyframe;
  const Frame before = run.FrameOf(last);
  const int num_measured = run.NumMeasured(last);

  truth(S::kFocalLength) = -0.02;  // the lens has got warm
  run.SetCamera(truth);
  int num_changes = 0;
  for (int i = 0; i < 6; ++i) {
    KeyframePacket packet = run.NextPacket();
    packet.frame = MeasureSimulatedDepth(*packet.frame, packet.image->Depth(), run.present());
    packet.image = nullptr;
    packet.begins_map = i == 0;
    if (packet.begins_map) packet.matches = {};
    num_changes += run.Process(packet).calibration ? 1 : 0;
  }
  EXPECT_GE(num_changes, 1);
  EXPECT_GT(run.present()->camera.fx, settled->camera.fx + 1.0);
  EXPECT_TRUE(HasSameRegistration(*run.present(), *settled));
  EXPECT_EQ(run.FrameOf(last).intrinsics, run.present());
  ExpectSameDepths(run.FrameOf(last), before);
  EXPECT_EQ(run.NumMeasured(last), num_measured);
}

}  // namespace
}  // namespace msc_vo
