// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/trajectory_export.h"

#include <cmath>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

std::string FormatKitti(const std::vector<TimedPose>& poses) {
  std::string text;
  for (const TimedPose& pose : poses) {
    const Eigen::Matrix3d rotation = pose.world_from_cam.rotation().toRotationMatrix();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) text += FormatText("%.9g ", rotation(row, column));
      text += FormatText("%.9g%c", pose.world_from_cam.translation()[row], row < 2 ? ' ' : '\n');
    }
  }
  return text;
}

// Stamps are good to a microsecond, as in trajectories: a double has no nanoseconds of the year.
std::string FormatEuroc(const std::vector<TimedPose>& poses) {
  std::string text =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
      "q_RS_z []\n";
  for (const TimedPose& pose : poses) {
    const Eigen::Vector3d t = pose.world_from_cam.translation();
    const Eigen::Quaterniond q = pose.world_from_cam.rotation();
    text += FormatText("%lld,%.9g,%.9g,%.9g,%.10g,%.10g,%.10g,%.10g\n",
                       static_cast<long long>(std::llround(1e6 * pose.timestamp)) * 1000, t.x(),
                       t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
  }
  return text;
}

}  // namespace msc_vo
