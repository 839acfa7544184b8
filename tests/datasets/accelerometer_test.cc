// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/accelerometer.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class AccelerometerTest : public TemporaryFolder {
 protected:
  // A sequence with images from 100 s to 102 s.
  SequenceIndex Index() {
    SequenceIndex index;
    index.directory = Folder();
    for (int i = 0; i <= 20; ++i) {
      index.entries.emplace_back();
      index.entries.back().timestamp = 100.0 + 0.1 * i;
    }
    return index;
  }
  std::vector<TimedAcceleration> Read(const std::string& text) {
    WriteText("accelerometer.txt", text);
    return ReadAccelerometer(Index());
  }
  std::string ErrorOf(const std::string& text) {
    return MessageOf([&] { Read(text); });
  }
};

TEST_F(AccelerometerTest, ReadsReadingsInOrderOfTime) {
  const std::vector<TimedAcceleration> readings =
      Read("# accelerometer data\n# timestamp ax ay az\n101.5 0.5 -9.8 0\r\n100.5,-1,-9.7,1e-1\n");
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[0].timestamp, 100.5);
  EXPECT_EQ(readings[0].acceleration, Eigen::Vector3d(-1.0, -9.7, 0.1));
  EXPECT_EQ(readings[1].timestamp, 101.5);
  EXPECT_EQ(readings[1].acceleration, Eigen::Vector3d(0.5, -9.8, 0.0));
}

TEST_F(AccelerometerTest, ConvertsMillisecondsToSeconds) {
  const std::vector<TimedAcceleration> readings = Read("100000 0 9.8 0\n102000 0 9.8 0\n");
  EXPECT_NEAR(readings[0].timestamp, 100.0, 1e-9);
  EXPECT_NEAR(readings[1].timestamp, 102.0, 1e-9);
}

TEST_F(AccelerometerTest, NamesTheMissingFile) {
  const std::string error = MessageOf([&] { ReadAccelerometer(Index()); });
  EXPECT_THAT(error, Names(Path("accelerometer.txt"), "exist", "time ax ay az"));
}

TEST_F(AccelerometerTest, NamesTheLineThatDoesNotFit) {
  EXPECT_THAT(ErrorOf("100 0 9.8 0\n101 9.8 0\n"), Names("accelerometer.txt:2", "3"));
  EXPECT_THAT(ErrorOf("# x\n100 0 9,8 0\n"), Names("accelerometer.txt:2"));
  EXPECT_THAT(ErrorOf("100 0 up 0\n"), Names("accelerometer.txt:1", "'up'"));
  EXPECT_THAT(ErrorOf("100 0 nan 0\n"), Names("accelerometer.txt:1", "'nan'"));
  EXPECT_THAT(ErrorOf("# timestamp ax ay az\n"), Names("accelerometer.txt", "no reading"));
}

TEST_F(AccelerometerTest, RejectsReadingsInOtherUnits) {
  EXPECT_THAT(ErrorOf("100 0 1.0 0\n101 0 1.01 0\n"),
              Names("accelerometer.txt", "9.81", "metres/second^2"));
  // A single bad reading does not matter.
  EXPECT_EQ(ErrorOf("100 0 9.8 0\n101 0 9.8 0\n101.5 40 0 0\n"), "");
}

// At 250 Hz, milliseconds look like seconds.
TEST_F(AccelerometerTest, ConvertsFastReadings) {
  std::string text;
  for (int i = 0; i <= 500; ++i) text += std::to_string(100000 + 4 * i) + " 0 9.8 0\n";
  const std::vector<TimedAcceleration> readings = Read(text);
  EXPECT_NEAR(readings.back().timestamp, 102.0, 1e-9);
}

TEST_F(AccelerometerTest, RejectsReadingsAtAnotherTime) {
  EXPECT_THAT(ErrorOf("200 0 9.8 0\n201 0 9.8 0\n"),
              Names("accelerometer.txt", "200.000", "overlap"));
}

TEST(RotationFromAxes, MapsAxesOfTheSensorToTheCamera) {
  EXPECT_EQ(RotationFromAxes("x,y,z"), Eigen::Matrix3d::Identity());
  // The sensor's x axis points forwards, its y axis to the left, its z axis upwards.
  const Eigen::Matrix3d rotation = RotationFromAxes("z,-x,-y");
  EXPECT_EQ(rotation * Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(-2.0, -3.0, 1.0));
}

TEST(RotationFromAxes, RejectsOtherText) {
  for (const char* axes : {"", "x", "x,y", "x,x,z", "x,y,-z", "a,y,z", "x,y,z,", "x y z"}) {
    EXPECT_THAT(MessageOf([&] { RotationFromAxes(axes); }), Names(axes, "right-handed")) << axes;
  }
}

}  // namespace
}  // namespace msc_vo
