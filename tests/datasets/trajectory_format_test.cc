// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory_format.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Not;

constexpr char kEurocHeader[] =
    "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
    "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1]\n";
// A quarter turn about z at (1, 2, 3), in all formats.
constexpr char kTum[] = "1403636580.838 1 2 3 0 0 0.70710678 0.70710678\n";
constexpr char kKitti[] = "0 -1 0 1 1 0 0 2 0 0 1 3\n";
constexpr char kEuroc[] = "1403636580838000000,1,2,3,0.70710678,0,0,0.70710678";

class TrajectoryFormatTest : public TemporaryFolder {
 protected:
  TrajectoryFormat Detect(const std::string& text) { return Read(text).format; }
  TrajectoryFile Read(const std::string& text,
                      std::optional<TrajectoryFormat> format = std::nullopt) {
    WriteText("file", text);
    return ReadTrajectoryFile(Path("file"), format);
  }
};

TEST_F(TrajectoryFormatTest, DetectsFormats) {
  EXPECT_EQ(Detect(kTum), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect("# time tx ty tz qx qy qz qw\n\n" + std::string(kTum)), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect("1.5,1,2,3,0,0,0,1\n"), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect("# t,x,y,z,qx,qy,qz,qw\n1.5,1,2,3,0,0,0,1\n"), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect(""), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect(kKitti), TrajectoryFormat::kKitti);
  EXPECT_EQ(Detect("0,-1,0,1,1,0,0,2,0,0,1,3\n"), TrajectoryFormat::kKitti);
  EXPECT_EQ(Detect(std::string(kEurocHeader) + kEuroc + ",0,0,0\n"), TrajectoryFormat::kEuroc);
  EXPECT_EQ(Detect(std::string(kEuroc) + "\n"), TrajectoryFormat::kEuroc);  // a date in nanoseconds
  EXPECT_EQ(Detect("timestamp,x,y,z,qw,qx,qy,qz\n5000000,1,2,3,1,0,0,0\n"),
            TrajectoryFormat::kEuroc);
}

TEST_F(TrajectoryFormatTest, SevenNumbersHaveNoStamp) {
  const TrajectoryFile file = Read("1 2 3 0 0 0 1\n4 5 6 0 0 0 1\n");
  EXPECT_FALSE(file.has_stamps);
  ASSERT_EQ(file.poses.size(), 2u);
  EXPECT_EQ(file.poses[1].world_from_cam.translation(), Eigen::Vector3d(4, 5, 6));
}

TEST_F(TrajectoryFormatTest, LeavesOutRowsOfLostFrames) {
  const TrajectoryFile file = Read("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 0\n3 nan 0 0 0 0 0 1\n");
  EXPECT_EQ(file.poses.size(), 1u);
  EXPECT_EQ(file.num_left_out, 2);
  EXPECT_THAT(file.times_left_out, testing::ElementsAre(2.0, 3.0));
}

TEST_F(TrajectoryFormatTest, DistinguishesDamagedLinesFromOtherFiles) {
  EXPECT_THROW(Read("1 2\n2 3\n"), NotATrajectory);
  EXPECT_THROW(Read("frame status\n1 2\n"), NotATrajectory);
  try {
    Read("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n3 x 0 0 0 0 0 1\n");
    FAIL() << "accepts a damaged line";
  } catch (const NotATrajectory&) {
    FAIL() << "refuses the file for a damaged line";
  } catch (const std::runtime_error&) {
  }
  // All formats.
  const std::string pose = kKitti, no_rotation = "2 -1 0 1 1 0 0 2 0 0 1 3\n";
  EXPECT_THROW(Read(no_rotation + no_rotation), NotATrajectory);
  EXPECT_THROW(Read("1,5 0,0 0,0 0,0 0,0 0,0 0,0 1,0\n"), NotATrajectory);
  EXPECT_THROW(Read("1 0.5 0.5 0.5 0.5 1 2 0.3\n2 0.5 0.5 0.5 0.5 2 1 0.3\n"), NotATrajectory);
  try {
    Read(pose + pose + no_rotation);
    FAIL() << "accepts a damaged line";
  } catch (const NotATrajectory&) {
    FAIL() << "refuses the file for a damaged line";
  } catch (const std::runtime_error&) {
  }
}

// EuRoC's own header of some files names no units.
TEST_F(TrajectoryFormatTest, HeadersOfEurocMeanNanoseconds) {
  const std::string header =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
      "q_RS_z []\n";
  TrajectoryFile file = Read(header + kEuroc + "\n1403636580843000000,1,2,3,1,0,0,0\n");
  EXPECT_EQ(file.format, TrajectoryFormat::kEuroc);
  EXPECT_EQ(file.unit, TimeUnit::kNanoseconds);
  EXPECT_NEAR(file.poses[0].timestamp, 1403636580.838, 1e-6);
  TrajectoryFile other = file;
  std::vector<std::string> warnings;
  ConvertToSeconds("a", "b", &file, &other, &warnings);
  EXPECT_THAT(warnings, testing::IsEmpty());
  // Seconds remain.
  EXPECT_NE(Read(header + "1.5,1,2,3,1,0,0,0\n2,1,2,3,1,0,0,0\n").unit, TimeUnit::kNanoseconds);
}

TEST_F(TrajectoryFormatTest, OnlyCommaSeparatedFilesAreThoseOfEuroc) {
  const TrajectoryFile file = Read("# time tx ty tz qw qx qy qz\n1.5 1 2 3 1 0 0 0\n");
  EXPECT_EQ(file.format, TrajectoryFormat::kTum);
  EXPECT_EQ(file.poses[0].world_from_cam.rotation().w(), 1.0);
}

TEST_F(TrajectoryFormatTest, SaysWhyThereAreNoPoses) {
  EXPECT_EQ(Read(kTum).DescribeLack(), "");
  EXPECT_THAT(Read("# no rows\n").DescribeLack(), Names("no poses", "comments"));
  EXPECT_THAT(Read("1 nan 0 0 0 0 0 1\n").DescribeLack(), Names("no poses", "1 row", "nan"));
}

TEST_F(TrajectoryFormatTest, ReadsTheSamePoseFromAllFormats) {
  for (const std::string& text :
       {std::string(kTum), std::string(kKitti), kEurocHeader + std::string(kEuroc) + ",0,0,0\n"}) {
    const TrajectoryFile file = Read(text);
    ASSERT_EQ(file.poses.size(), 1u) << text;
    EXPECT_EQ(file.has_stamps, file.format != TrajectoryFormat::kKitti);
    EXPECT_NEAR(file.poses[0].timestamp, file.has_stamps ? 1403636580.838 : 0.0, 1e-6);
    const Rigid3& pose = file.poses[0].world_from_cam;
    EXPECT_NEAR((pose.translation() - Eigen::Vector3d(1, 2, 3)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((pose.rotation() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 0.0,
                1e-8);
  }
}

// The pose of kTum in columns of many programs.
TEST_F(TrajectoryFormatTest, HeadersDecideTheColumns) {
  const std::string q = "0.70710678", xyzw = "0,0," + q + "," + q, wxyz = q + ",0,0," + q;
  const std::string rows[] = {
      "# timestamp tx ty tz qw qx qy qz\n1403636580.838 1 2 3 " + q + " 0 0 " + q + "\n",
      "# ground truth\n# t, x, y, z, qw, qx, qy, qz\n# of a camera\n1403636580.838,1,2,3," + wxyz,
      "timestamp,tx,ty,tz,qx,qy,qz,qw,tracking_state\n1403636580.838,1,2,3," + xyzw + ",OK\n",
      "num,t,x,y,z,qx,qy,qz,qw\r\n0,1403636580.838,1,2,3," + xyzw + ",\r\n",
      "t;x;y;z;q_w;q_x;q_y;q_z\n1403636580.838;1;2;3;" + q + ";0;0;" + q + ";\n",
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.pose.position.x,"
      "field.pose.position.y,field.pose.position.z,field.pose.orientation.w,"
      "field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z\n"
      "1403636580900000000,0,1403636580838000000,,1,2,3," +
          wxyz,
      "secs,nsecs,px,py,pz,qx,qy,qz,qw\n1403636580,838000000,1,2,3," + xyzw,
      "timestamp [ms] x [mm] y [mm] z [mm] qx qy qz qw\n1403636580838 1000 2000 3000 0 0 " + q +
          " " + q,
      "timestamp [ms] x [mm] y z qx qy qz qw\n1403636580838 1000 2000 3000 0 0 " + q + " " + q,
      // A number in front of the row that the header does not name.
      "timestamp tx ty tz qx qy qz qw\n0 1403636580.838 1 2 3 0 0 " + q + " " + q + "\n",
      // Words in front of the names.
      "# columns: timestamp tx ty tz qw qx qy qz\n1403636580.838 1 2 3 " + q + " 0 0 " + q,
      // No header: the quaternion is the one of unit length.
      "7,1403636580.838,1,2,3," + xyzw, "1403636580.838,1,2,3," + xyzw + ",1,0,0.5\n",
      "1403636580.838 7 1 2 3 0 0 " + q + " " + q + "\n"};
  for (const std::string& text : rows) {
    TrajectoryFile file = Read(text);
    std::vector<std::string> warnings;
    TrajectoryFile tum = Read(kTum);
    ConvertToSeconds("a", "b", &tum, &file, &warnings);
    ASSERT_EQ(file.poses.size(), 1u) << text;
    EXPECT_NEAR(file.poses[0].timestamp, 1403636580.838, 1e-6) << text;
    const Rigid3& pose = file.poses[0].world_from_cam;
    EXPECT_NEAR((pose.translation() - Eigen::Vector3d(1, 2, 3)).norm(), 0.0, 1e-9) << text;
    EXPECT_NEAR((pose.rotation() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 0.0,
                1e-8)
        << text;
  }
}

TEST_F(TrajectoryFormatTest, MagnitudesOfStampsTellEurocWithoutAHeader) {
  const std::string rows = ",1,2,3,1,0,0,0,5\n";
  EXPECT_EQ(Detect("1403636580838000000" + rows), TrajectoryFormat::kEuroc);
  EXPECT_EQ(Detect("1403636580.838" + rows), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect("1.5" + rows), TrajectoryFormat::kTum);
  EXPECT_EQ(Detect("5000000000" + rows + "5033000000" + rows), TrajectoryFormat::kEuroc);
  EXPECT_EQ(Detect("5000000000" + rows + "5004000000" + rows), TrajectoryFormat::kEuroc);
}

// At 250 Hz, milliseconds look like seconds, and the other trajectory tells.
TEST_F(TrajectoryFormatTest, UnitsOfTwoTrajectoriesAreJudgedTogether) {
  const std::string pose = " 1 2 3 0 0 0 1\n";
  std::string fast, slow;
  for (int i = 0; i < 500; ++i) fast += std::to_string(4 * i) + pose;
  for (int i = 0; i < 60; ++i) slow += std::to_string(i / 30.0) + pose;
  for (const bool fast_is_reference : {true, false}) {
    TrajectoryFile reference = Read(fast_is_reference ? fast : slow);
    TrajectoryFile estimate = Read(fast_is_reference ? slow : fast);
    std::vector<std::string> warnings;
    ConvertToSeconds("a", "b", &reference, &estimate, &warnings);
    EXPECT_NEAR(reference.poses.back().timestamp, 2.0, 0.05);
    EXPECT_NEAR(estimate.poses.back().timestamp, 2.0, 0.05);
    EXPECT_THAT(warnings, ElementsAre(Names(fast_is_reference ? "a" : "b", "milliseconds")));
  }
}

TEST_F(TrajectoryFormatTest, ReadsTablesWithoutTime) {
  const TrajectoryFile file = Read("tx ty tz qx qy qz qw\n1 2 3 0 0 0 1\n4 5 6 0 0 0 1\n");
  EXPECT_FALSE(file.has_stamps);
  ASSERT_EQ(file.poses.size(), 2u);
  EXPECT_EQ(file.poses[1].timestamp, 1.0);
  // All 16 numbers of a matrix.
  EXPECT_EQ(Detect("0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1\n"), TrajectoryFormat::kKitti);
  // Twelve columns that are no matrix.
  EXPECT_EQ(Detect("1.5 1 2 3 0 0 0 1 9 9 9 9\n"), TrajectoryFormat::kTum);
}

TEST_F(TrajectoryFormatTest, ReadsMatricesBehindTimeStamps) {
  const std::string row = " 0 -1 0 0.1 1 0 0 0.2 0 0 1 0.3", last = " 0 0 0 1";
  for (const std::string& end : {std::string("\n"), last + "\n"}) {
    const TrajectoryFile file = Read("5.5" + row + end + "4.5" + row + end);
    EXPECT_EQ(file.format, TrajectoryFormat::kKitti);
    EXPECT_TRUE(file.has_stamps);
    ASSERT_EQ(file.poses.size(), 2u);
    EXPECT_EQ(file.poses[0].timestamp, 4.5);  // in order of time
    EXPECT_EQ(file.poses[1].world_from_cam.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  }
  EXPECT_THAT(MessageOf([&] { Read("5.5" + row + "\n" + row + "\n"); }),
              Names("file:2", "time stamp", "12"));
}

// Identity, in whose rows every other order has columns with the length of a quaternion.
TEST_F(TrajectoryFormatTest, RefusesMatricesInAnotherOrder) {
  for (const char* row :
       {"5 0.1 0.2 0.3 1 0 0 0 1 0 0 0 1\n", "5 1 0 0 0 1 0 0 0 1 0.1 0.2 0.3\n",
        "5 1 0 0 0 0 1 0 0 0 0 1 0 0.1 0.2 0.3 1\n", "0.1 0.2 0.3 1 0 0 0 1 0 0 0 1\n"}) {
    EXPECT_THAT(MessageOf([&] { Read(row); }), Names("file:1", "rotation", "[R t]")) << row;
  }
}

TEST_F(TrajectoryFormatTest, RefusesQuaternionsInAnotherOrder) {
  EXPECT_THAT(MessageOf([&] { Read("5 0 0 0.1 0.99498744 0.1 0 0\n5 0 0 0 1 0.2 0 0\n"); }),
              Names("file:1", "2-5", "5-8", "header"));
  // A header decides, and so do the lengths if it has two meanings.
  const TrajectoryFile first = Read("t x y z w x y z\n5 0 0 0.1 0.99498744 0.1 0 0\n");
  EXPECT_EQ(first.poses.at(0).world_from_cam.translation(), Eigen::Vector3d(0.1, 0, 0));
  const TrajectoryFile second = Read("t x y z w x y z\n5 7 8 9 1 0 0 0\n");
  EXPECT_EQ(second.poses.at(0).world_from_cam.translation(), Eigen::Vector3d(7, 8, 9));
  // Rounded components are no reason to refuse.
  EXPECT_EQ(Read("5 0 0 0 0.7 0 0 0.7\n").poses.size(), 1u);
}

TEST_F(TrajectoryFormatTest, ReadsPosesBesideInfiniteOnesAndBeforeFurtherColumns) {
  EXPECT_EQ(Read("5 0 0 0 0 0 0 1\n6 0 0 0 inf inf inf inf\n").num_left_out, 1);
  const std::string row = "5 1 2 3 0 0 0 1 1 0 0 0 1 0 0 0 1\n";  // and a rotation matrix
  EXPECT_EQ(Read(row).poses.at(0).world_from_cam.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(MessageOf([&] { Read("5 0 0 0 0 0 0 1\n6 0 0 0 0 0\n"); }), Names("file:2"));
}

TEST_F(TrajectoryFormatTest, SkipsLinesBeforeTheNamesOfColumns) {
  const TrajectoryFile file = Read(
      ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position\n"
      "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z\n0,5.5,0,0,0,1,0.1,0.2,0.3\n");
  ASSERT_EQ(file.poses.size(), 1u);
  EXPECT_EQ(file.poses[0].timestamp, 5.5);
  EXPECT_EQ(file.poses[0].world_from_cam.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
}

// As "%d.%d" writes seconds and nanoseconds.
TEST_F(TrajectoryFormatTest, RestoresZerosInFrontOfNanoseconds) {
  const std::string q = " 0 0 0 0 0 0 1\n";
  const TrajectoryFile file =
      Read("7.966666667" + q + "8.0" + q + "8.33333333" + q + "8.100000000" + q);
  ASSERT_EQ(file.poses.size(), 4u);
  EXPECT_NEAR(file.poses[2].timestamp, 8.033333333, 1e-9);
}

TEST_F(TrajectoryFormatTest, RefusesRowsThatHeaderAndFormatDoNotExplain) {
  EXPECT_THAT(MessageOf([&] { Read("a,b,c\n1,2,3,4,5,6,7,8\n"); }),
              AllOf(Names("file:1", "time tx ty tz qx qy qz qw"), Not(Names("quaternion"))));
  EXPECT_THAT(MessageOf([&] { Read("5 1 2 3 0 0 0 9 9\n"); }),
              Names("file:1", "9", "quaternion", "header"));
  EXPECT_THAT(MessageOf([&] { Read("1,5;0;0;0;0;0;0;1\n"); }),
              Names("file:1", "'1,5'"));  // decimal commas
  EXPECT_THAT(MessageOf([&] { Read("t,x,y,z,qx,qy,qz,qw\n1,2,,3,0,0,0,1\n"); }),
              Names("file:2", "''"));
  // Of two rows, one is wrong: no other columns are tried.
  EXPECT_THAT(
      MessageOf([&] { Read("# t x y z qw qx qy qz s\n1 0 0 0 1 0 0 0 5\n2 0 0 0 0.5 0 0 0 5\n"); }),
      Names("file:3", "qw qx qy qz", "0.500"));
}

TEST_F(TrajectoryFormatTest, SkipsRowsThatAreNotFinite) {
  const TrajectoryFile kitti =
      Read("nan -1 0 1 1 0 0 2 0 0 1 3\n" + std::string(kKitti), TrajectoryFormat::kKitti);
  EXPECT_EQ(kitti.num_left_out, 1);
  ASSERT_EQ(kitti.poses.size(), 1u);
  EXPECT_EQ(kitti.poses[0].timestamp, 1.0);  // the row in the file
  EXPECT_EQ(Read("5000000,nan,2,3,1,0,0,0\n", TrajectoryFormat::kEuroc).num_left_out, 1);
}

TEST_F(TrajectoryFormatTest, NamesFileAndLineOfErrors) {
  EXPECT_THAT(MessageOf([&] { Read(std::string(kKitti) + "1 2 3\n"); }),
              Names("file:2", "12", "3"));
  EXPECT_THAT(MessageOf([&] { Read("2 -1 0 1 1 0 0 2 0 0 1 3\n"); }), Names("file:1", "rotation"));
  EXPECT_THAT(MessageOf([&] { Read("0 -1 0 x 1 0 0 2 0 0 1 3\n"); }), Names("file:1", "'x'"));
  const std::string header = kEurocHeader;
  EXPECT_THAT(MessageOf([&] { Read(header + "1,2,3\n"); }), Names("file:2", "8", "header", "3"));
  EXPECT_THAT(MessageOf([&] { Read(header + "1,2,3,4,5,0,0,0\n"); }),
              Names("file:2", "qw qx qy qz", "5.000"));
  // The override of the format decides how a row is read.
  EXPECT_THAT(MessageOf([&] { Read(kTum, TrajectoryFormat::kKitti); }), Names("file:1", "12", "8"));
}

TEST_F(TrajectoryFormatTest, RefusesDecimalCommas) {
  for (const std::string separator : {" ", ";", "; "}) {
    std::string row = "1,5";
    for (const char* number : {"0,25", "-1,5", "2,0", "0,0", "0,0", "0,0", "1,0"}) {
      row += separator + number;
    }
    EXPECT_THAT(MessageOf([&] { Read("# comment\n" + row + "\n"); }), Names("file:2", "commas"));
  }
  EXPECT_EQ(Read("1,2,3,4,0,0,0,1\n").poses.size(), 1u);
}

TEST_F(TrajectoryFormatTest, SharesStampsRowByRow) {
  TrajectoryFile kitti = Read(std::string(kKitti) + kKitti);
  TrajectoryFile tum = Read("5 0 0 0 0 0 0 1\n6 1 0 0 0 0 0 1\n");
  ShareStamps("a", "b", &tum, &kitti);
  EXPECT_EQ(kitti.poses[0].timestamp, 5.0);
  EXPECT_EQ(kitti.poses[1].timestamp, 6.0);
  TrajectoryFile first = Read(kKitti), second = Read(kKitti);
  ShareStamps("a", "b", &first, &second);
  EXPECT_FALSE(first.has_stamps);

  TrajectoryFile longer = Read(std::string(kKitti) + kKitti + kKitti);
  EXPECT_THAT(MessageOf([&] { ShareStamps("a.txt", "b.txt", &tum, &longer); }),
              Names("a.txt", "2", "b.txt", "3", "KITTI"));
  TrajectoryFile holes = Read("5 0 0 0 0 0 0 1\n6 nan 0 0 0 0 0 1\n");
  TrajectoryFile two = Read(std::string(kKitti) + kKitti);
  EXPECT_THAT(MessageOf([&] { ShareStamps("a.txt", "b.txt", &holes, &two); }),
              Names("a.txt", "nan"));
}

}  // namespace
}  // namespace msc_vo
