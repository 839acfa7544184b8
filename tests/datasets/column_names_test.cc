// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/column_names.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// "time position quaternion", the quaternion in the order x y z w, with the unit of time.
std::string Describe(const std::string& header) {
  const std::optional<PoseColumns> columns = FindPoseColumns(header);
  if (!columns) return "none";
  std::string text = columns->time ? std::to_string(*columns->time) : "-";
  if (columns->nanoseconds) text += "+" + std::to_string(*columns->nanoseconds);
  text += " ";
  for (const size_t column : columns->position) text += std::to_string(column);
  text += " ";
  for (const size_t column : columns->quaternion) text += std::to_string(column);
  if (columns->unit) text += std::string(" ") + ToString(*columns->unit);
  return text;
}

TEST(FindPoseColumns, ReadsNamesOfManyPrograms) {
  const std::pair<const char*, const char*> headers[] = {
      {"# timestamp tx ty tz qx qy qz qw", "0 123 4567"},
      {"# timestamp tx ty tz qw qx qy qz", "0 123 5674"},
      {"timestamp,tx,ty,tz,qx,qy,qz,qw,tracking_state", "0 123 4567"},
      {"num,t,x,y,z,qx,qy,qz,qw", "1 234 5678"},
      {"#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y "
       "[], "
       "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
       "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1]",
       "0 123 5674 nanoseconds"},
      {"#timestamp [ns], p_RS_R_x [m], y, z, q_RS_w [], q_RS_x [], y, z", "0 123 5674 nanoseconds"},
      {"%time,field.header.seq,field.header.stamp,field.header.frame_id,field.pose.position.x,"
       "field.pose.position.y,field.pose.position.z,field.pose.orientation.x,"
       "field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w",
       "2 456 78910"},
      {"header.stamp.sec,header.stamp.nanosec,pose.position.x,pose.position.y,pose.position.z,"
       "pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w",
       "0+1 234 5678 seconds"},
      {"secs nsecs px py pz qx qy qz qw", "0+1 234 5678 seconds"},
      {"Time(s);PosX;PosY;PosZ;RotW;RotX;RotY;RotZ", "0 123 5674 seconds"},
      {"\"timestamp_us\"\t\"x\"\t\"y\"\t\"z\"\t\"q_w\"\t\"q_x\"\t\"q_y\"\t\"q_z\"\r",
       "0 123 5674 microseconds"},
      {"TIMESTAMP TX TY TZ QX QY QZ QW", "0 123 4567"},
      {"t [ms] x [m] y [m] z [m] rotation.w rotation.x rotation.y rotation.z",
       "0 123 5674 milliseconds"},
      {"timestamp,qw,qx,qy,qz,tx,ty,tz", "0 567 2341"},
      {"time, w, x, y, z, tx, ty, tz", "0 567 2341"},
      {"# time position (x, y, z) quaternion (w, x, y, z)", "0 123 5674"},
      {"# stamp p(xyz) q(wxyz)", "0 123 5674"},
      {"timestamp x y z q0 q1 q2 q3", "0 123 5674"},
      {"timestamp,timestamp_sample,position[0],position[1],position[2],q[0],q[1],q[2],q[3]",
       "0 234 6785"},
      {"timestamp,vx,vy,vz,wx,wy,wz,x,y,z,qx,qy,qz,qw", "0 789 10111213"},
      {",timestamp,tx,ty,tz,qx,qy,qz,qw", "1 234 5678"},
      {"frame tx ty tz qx qy qz qw", "0 123 4567"},
      {"Frame,Time (Seconds),X,Y,Z,W,X,Y,Z", "1 678 2345 seconds"},
      {"x y z qx qy qz qw", "- 012 3456"}};
  for (const auto& [header, columns] : headers) EXPECT_EQ(Describe(header), columns) << header;
}

TEST(FindPoseColumns, RejectsOtherText) {
  for (const char* text :
       {"", "#", "# ground truth trajectory", "# file: 'rgbd_dataset_freiburg1_xyz.bag'",
        "timestamp filename", "# time x y z", "# timestamp tx ty tz roll pitch yaw",
        "# t x y z qx qy qz", "# segment 2, world 0", "1.5 1 2 3 0 0 0 1", "((((", "[", ",,,"}) {
    EXPECT_EQ(Describe(text), "none") << text;
  }
}

TEST(FindPoseColumns, ReadsUnitsOfPositions) {
  EXPECT_EQ(FindPoseColumns("t x[mm] y[mm] z[mm] qx qy qz qw")->metres, 1e-3);
  EXPECT_EQ(FindPoseColumns("t,tx_cm,ty_cm,tz_cm,qx,qy,qz,qw")->metres, 1e-2);
  EXPECT_EQ(FindPoseColumns("t,tx_m,ty_m,tz_m,qx,qy,qz,qw")->metres, 1.0);
}

}  // namespace
}  // namespace msc_vo
