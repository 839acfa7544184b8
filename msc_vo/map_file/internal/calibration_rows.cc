// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/calibration_rows.h"

#include <optional>
#include <utility>

#include "msc_vo/map_file/internal/blob.h"
#include "msc_vo/map_file/internal/row.h"

namespace msc_vo {

namespace {

// Blobs of a row; the last two are empty if there is no such value.
struct IntrinsicsBlobs {
  std::string coefficients;
  std::string recorded;
  std::string registration;
};

std::string Encode(const PinholeCamera& camera) {
  BlobWriter blob;
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) blob.F64(value);
  blob.U16(static_cast<uint16_t>(camera.width));
  blob.U16(static_cast<uint16_t>(camera.height));
  return blob.bytes();
}

IntrinsicsBlobs Encode(const CameraIntrinsics& intrinsics) {
  IntrinsicsBlobs blobs;
  BlobWriter coefficients, registration;
  for (const double k : intrinsics.distortion.k) coefficients.F64(k);
  blobs.coefficients = coefficients.bytes();
  if (intrinsics.distortion.recorded) blobs.recorded = Encode(*intrinsics.distortion.recorded);
  if (intrinsics.registration) {
    for (const double value : *intrinsics.registration) registration.F64(value);
  }
  blobs.registration = registration.bytes();
  return blobs;
}

std::string Key(const Frame& frame) {
  std::string key = Encode(frame.camera);
  if (!frame.intrinsics) return key;
  const IntrinsicsBlobs blobs = Encode(*frame.intrinsics);
  return key + LensModelName(frame.intrinsics->distortion.model) + blobs.coefficients + "," +
         blobs.recorded + "," + blobs.registration;
}

void CheckCamera(const PinholeCamera& camera) {
  std::string error;
  if (!camera.IsValid(&error)) throw BlobError(error);
}

PinholeCamera DecodeCamera(std::string_view bytes) {
  BlobReader blob(bytes);
  PinholeCamera camera;
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value = blob.F64();
  camera.width = blob.U16();
  camera.height = blob.U16();
  CheckCamera(camera);
  if (!blob.AtEnd()) throw BlobError("too many bytes");
  return camera;
}

PinholeCamera ReadCamera(RowReader* row) {
  PinholeCamera camera;
  camera.width = static_cast<int>(row->Integer());
  camera.height = static_cast<int>(row->Integer());
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value = row->Real();
  CheckCamera(camera);
  return camera;
}

// The lens, if it is known.
std::shared_ptr<const CameraIntrinsics> ReadIntrinsics(const PinholeCamera& camera,
                                                       RowReader* row) {
  if (row->IsNull()) {
    for (int i = 0; i < 3; ++i) {
      if (!row->IsNull()) throw BlobError("a lens without a model");
    }
    return nullptr;
  }
  CameraIntrinsics intrinsics{camera, {}};
  const std::optional<LensModel> model = LensModelFromName(std::string(row->Text()));
  if (!model) throw BlobError("an unknown lens model");
  intrinsics.distortion.model = *model;
  BlobReader coefficients(row->Blob());
  for (double& k : intrinsics.distortion.k) k = coefficients.F64();
  if (!row->IsNull()) intrinsics.distortion.recorded = DecodeCamera(row->Blob());
  if (!row->IsNull()) {
    BlobReader registration(row->Blob());
    intrinsics.registration.emplace();
    for (double& value : *intrinsics.registration) value = registration.F64();
  }
  return std::make_shared<const CameraIntrinsics>(intrinsics);
}

void BlobOrNull(const std::string& bytes, RowWriter* row) {
  bytes.empty() ? row->Null() : row->Blob(bytes);
}

}  // namespace

void CalibrationRows::Read(const SqliteDatabase& database) {
  ForEachRow(database, "calibration", "id", [&](RowReader* row) {
    const int64_t id = row->Integer();
    FrameCalibration calibration;
    calibration.camera = ReadCamera(row);
    calibration.intrinsics = ReadIntrinsics(calibration.camera, row);
    row->Finish();
    Frame frame;
    frame.camera = calibration.camera;
    frame.intrinsics = calibration.intrinsics;
    ids_.emplace(Key(frame), id);
    rows_.emplace(id, std::move(calibration));
    next_id_ = id + 1;
  });
}

const FrameCalibration* CalibrationRows::Find(int64_t id) const {
  const auto found = rows_.find(id);
  return found != rows_.end() ? &found->second : nullptr;
}

int64_t CalibrationRows::Write(const SqliteDatabase& database, const Frame& frame) {
  const auto [place, is_new] = ids_.try_emplace(Key(frame), next_id_);
  if (!is_new) return place->second;
  const int64_t id = next_id_++;
  SqliteStatement insert =
      database.Prepare("INSERT INTO calibration VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  RowWriter row(&insert);
  const PinholeCamera& camera = frame.camera;
  row.Integer(id).Integer(camera.width).Integer(camera.height);
  row.Real(camera.fx).Real(camera.fy).Real(camera.cx).Real(camera.cy);
  IntrinsicsBlobs blobs;
  if (frame.intrinsics) {
    blobs = Encode(*frame.intrinsics);
    row.Text(LensModelName(frame.intrinsics->distortion.model)).Blob(blobs.coefficients);
    BlobOrNull(blobs.recorded, &row);
    BlobOrNull(blobs.registration, &row);
  } else {
    row.Null().Null().Null().Null();
  }
  row.Execute();
  return id;
}

}  // namespace msc_vo
