// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_calibration.h"

#include <utility>

#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/self_calibration/keyframe_frames.h"

namespace msc_vo {

void MapCalibration::Begin(const std::shared_ptr<const CameraIntrinsics>& given,
                           DepthMeasurement measure_depth) {
  intrinsics_.emplace(given);
  measure_depth_ = std::move(measure_depth);
}

void MapCalibration::CompensateMap(Map* map) {
  readout_time_ = readout_.readout_time();
  CompensateKeyframes(readout_time_, map);
}

std::shared_ptr<const Frame> MapCalibration::BringUpToDate(const KeyframePacket& packet) const {
  std::shared_ptr<const Frame> frame = packet.frame;
  if (intrinsics_) frame = WithPresentIntrinsics(frame, packet.image.get());
  return UpdateCompensation(frame, readout_time_);
}

void MapCalibration::UpdateReadoutTime(const KeyframePacket& packet, const Map& map,
                                       KeyframeId newest) {
  readout_.Update(map, newest, packet.frame_interval);
}

bool MapCalibration::UpdateIntrinsics(const KeyframePacket& packet, const Map& map,
                                      KeyframeId newest) {
  if (!intrinsics_ || (packet.image == nullptr && !intrinsics_->IsSettled())) return false;
  intrinsics_->SetReadoutTime(readout_time_);
  return intrinsics_->Update(map, newest, packet.image, packet.calibration_images,
                             readout_.sigma());
}

void MapCalibration::ChangeMap(Map* map) const {
  ChangeKeyframeIntrinsics(
      [this, map](KeyframeId id, const std::shared_ptr<const Frame>& frame) {
        if (map->IsOfEarlierSession(id)) return ChangeCamera(frame, intrinsics_->present()->camera);
        return WithPresentIntrinsics(frame, intrinsics_->FindImage(id).get());
      },
      map);
}

void MapCalibration::Describe(MapSnapshot* snapshot) const {
  snapshot->readout_time = readout_time_;
  snapshot->calibration_is_doubted = IsDoubted();
  if (!intrinsics_) return;
  snapshot->intrinsics = intrinsics_->present();
  snapshot->calibration_is_settled = intrinsics_->IsSettled();
}

std::shared_ptr<const Frame> MapCalibration::WithPresentIntrinsics(
    const std::shared_ptr<const Frame>& frame, const RecordedImage* image) const {
  const std::shared_ptr<const CameraIntrinsics>& present = intrinsics_->present();
  const bool has_old_depths =
      frame->intrinsics && !HasSameRegistration(*frame->intrinsics, *present);
  return has_old_depths && image != nullptr ? measure_depth_(*frame, *image, present)
                                            : ChangeIntrinsics(frame, present);
}

}  // namespace msc_vo
