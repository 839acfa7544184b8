// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/recorded_run.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <nlohmann/json.hpp>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/calibration_json.h"
#include "msc_vo/results/covariance_columns.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/named_columns.h"

namespace msc_vo {

namespace {

constexpr const char* kPose[] = {"odom_qx", "odom_qy", "odom_qz", "odom_qw",
                                 "odom_x",  "odom_y",  "odom_z"};

// Of result files.
constexpr ColumnFixes kFixes = {"it was written by an earlier version; run the sequence again",
                                "run the sequence again"};

RecordedReading ParseReading(const nlohmann::json& json) {
  RecordedReading reading;
  json.at("color_is_reduced").get_to(reading.color_is_reduced);
  json.at("float_depth_scale").get_to(reading.float_depth_scale);
  if (!json.at("mask").is_null()) json.at("mask").get_to(reading.mask);
  json.at("mask_zero").get_to(reading.mask_zero);
  json.at("settings").get_to(reading.settings);
  return reading;
}

// The columns of a covariance.
class CovarianceColumns {
 public:
  CovarianceColumns(const NamedColumns& table, const std::string& prefix)
      : table_(table), names_(SigmaColumns(prefix)) {
    for (const std::string& name : names_) sigmas_.push_back(table.Column(name));
    for (const std::string& name : CorrelationColumns(prefix)) {
      correlations_.push_back(table.Column(name));
    }
  }

  // None if the row states none.
  std::optional<PoseCovariance> Read(size_t row) const {
    PoseCovariance covariance;
    for (int i = 0; i < 6; ++i) {
      const double sigma = table_.Number(row, sigmas_[i]);
      if (sigma < 0.0) table_.Fail(row, names_[i] + " is negative");
      covariance(i, i) = i < 3 ? DegreesToRadians(sigma) : sigma;
    }
    auto column = correlations_.begin();
    for (int i = 0; i < 6; ++i) {
      for (int j = i + 1; j < 6; ++j) {
        const double correlation = table_.Number(row, *column++);
        if (std::abs(correlation) > 1.0) {
          table_.Fail(row, "a correlation must be within [-1, 1]");
        }
        covariance(i, j) = covariance(j, i) = correlation * covariance(i, i) * covariance(j, j);
      }
    }
    covariance.diagonal() = covariance.diagonal().cwiseAbs2().eval();
    return covariance.trace() > 0.0 ? std::make_optional(covariance) : std::nullopt;
  }

 private:
  const NamedColumns& table_;
  std::vector<std::string> names_;  // of sigmas_
  std::vector<size_t> sigmas_, correlations_;
};

}  // namespace

int64_t Microseconds(double seconds) { return std::llround(1e6 * seconds); }

std::map<int64_t, RecordedFrame> ReadFramesCsv(const std::string& path) {
  const NamedColumns table(path, kFixes);
  const size_t time = table.Column("time");
  std::vector<size_t> pose;
  for (const char* name : kPose) pose.push_back(table.Column(name));
  const CovarianceColumns in_world(table, "world_"), in_odometry(table, "odom_");
  std::map<int64_t, RecordedFrame> frames;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    RecordedFrame frame;
    for (int i = 0; i < 7; ++i) frame.odom_from_cam.params[i] = table.Number(row, pose[i]);
    const double length = frame.odom_from_cam.rotation().norm();
    if (!(std::abs(length - 1.0) < 1e-3)) {
      table.Fail(row, "the quaternion has no unit length");
    }
    frame.odom_from_cam.rotation().normalize();
    frame.world_covariance = in_world.Read(row);
    frame.odometry_covariance = in_odometry.Read(row);
    if (!frames.emplace(Microseconds(table.Number(row, time)), frame).second) {
      table.Fail(row, "its time stands in a row before");
    }
  }
  return frames;
}

RecordedRun ReadRecordedRun(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / "summary.json").string();
  RecordedRun run;
  if (!FileProblem(path).empty()) return run;
  try {
    const auto json = nlohmann::json::parse(ReadFile(path));
    if (json.contains("final_camera")) {
      run.calibration = ParseCalibrationJson(json["final_camera"].dump());
      run.calibration->origin = path;
    }
    const auto sequence = json.find("sequence");
    if (sequence != json.end() && sequence->contains("reading")) {
      run.reading = ParseReading(sequence->at("reading"));
    }
    for (const auto& segment : json.value("segments", nlohmann::json::array())) {
      if (segment.at("in_map").get<bool>()) run.map_world = segment.at("world").get<int>();
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": cannot be read as the summary of a run: " + error.what());
  }
  return run;
}

}  // namespace msc_vo
