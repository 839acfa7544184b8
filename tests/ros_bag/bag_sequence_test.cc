// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/bag_sequence.h"

#include <functional>
#include <utility>

#include "tests/ros_bag/bag_writer.h"
#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::IsEmpty;

class BagSequenceTest : public TemporaryFolder {
 protected:
  // Five pairs; the images of pair i have the grey value 10 (i + 1) and i + 1 metres. Messages are
  // recorded in another order than their stamps.
  void WriteBag(const std::string& name, const std::string& depth_encoding) {
    WriteBag(WriteRos1Bag(Path(name)), depth_encoding);
  }
  void WriteBag(std::unique_ptr<BagWriter> bag, const std::string& depth_encoding) {
    const RosSerialization serialization = bag->serialization();
    CameraInfoFields info;
    info.width = 32;
    info.height = 24;
    info.cx = 15.5;
    info.cy = 11.5;
    bag->Write("/camera/rgb/camera_info", "sensor_msgs/CameraInfo", 1.0,
               CameraInfoMessage(info, serialization));
    for (const int i : {1, 0, 2, 4, 3}) {
      const auto nanoseconds = static_cast<uint32_t>(100000000 * i);
      const cv::Mat color(24, 32, CV_8UC3, cv::Scalar::all(10 * (i + 1)));
      const bool is_metres = depth_encoding == "32FC1";
      const cv::Mat depth(24, 32, is_metres ? CV_32FC1 : CV_16UC1,
                          cv::Scalar::all(is_metres ? i + 1 : 1000 * (i + 1)));
      const double recorded = 1.0 + 0.1 * recordings_++;
      bag->Write("/camera/rgb/image_color", "sensor_msgs/Image", recorded,
                 ImageMessage(100, nanoseconds, color, "bgr8", serialization));
      bag->Write("/camera/depth/image", "sensor_msgs/Image", recorded + 0.01,
                 ImageMessage(100, nanoseconds + 5000000, depth, depth_encoding, serialization));
    }
    bag->Write("/camera/ir/image", "sensor_msgs/Image", 9.0,
               ImageMessage(100, 0, cv::Mat::zeros(24, 32, CV_8UC1), "mono8", serialization));
  }
  int recordings_ = 0;

  static void ExpectFivePairs(const std::string& path) {
    SCOPED_TRACE(path);
    const RgbdDecoder decoder = Decoder(OpenBag(path));
    ASSERT_EQ(decoder.size(), 5);
    EXPECT_EQ(decoder.index().format, "ros-bag");
    EXPECT_EQ(decoder.calibration().camera.fx, 525.0);
    for (const int i : {0, 4, 2, 1, 3}) {  // in any order
      const RgbdImage image = decoder.Decode(i);
      EXPECT_NEAR(image.timestamp, 100.0 + 0.1 * i, 1e-9);
      EXPECT_NEAR(image.depth_delay, 0.005, 1e-9);
      EXPECT_EQ(image.gray.at<uint8_t>(3, 3), 10 * (i + 1));
      EXPECT_NEAR(image.depth.at<float>(3, 3), i + 1.0, 1e-6);
    }
  }

  // Ten pairs that are recorded at 30 Hz from 50 s on. `stamp_of` gives the seconds and nanoseconds
  // of the header of image i, the depth image if the second argument is true.
  using Stamp = std::pair<uint32_t, uint32_t>;
  SequenceIndex OpenStamped(const std::function<Stamp(int, bool)>& stamp_of,
                            const std::string& color_topic = "/rgb/image") {
    const cv::Mat color(2, 2, CV_8UC3, cv::Scalar::all(9)), depth(2, 2, CV_16UC1, 1000);
    {
      const auto bag = WriteRos1Bag(Path("stamped.bag"));
      for (int i = 0; i < 10; ++i) {
        const Stamp of_color = stamp_of(i, false), of_depth = stamp_of(i, true);
        const double recorded = 50.0 + i / 30.0;
        bag->Write(color_topic, "sensor_msgs/Image", recorded,
                   ImageMessage(of_color.first, of_color.second, color, "bgr8"));
        bag->Write("/depth/image", "sensor_msgs/Image", recorded + 0.003,
                   ImageMessage(of_depth.first, of_depth.second, depth, "16UC1"));
      }
    }
    return OpenBag(Path("stamped.bag"));
  }
  static void ExpectReceiveTimes(const SequenceIndex& index, const NamesMatcher& reason) {
    ASSERT_EQ(index.entries.size(), 10u);
    EXPECT_NEAR(index.entries[9].timestamp, 50.3, 1e-6);
    EXPECT_NEAR(index.entries[9].depth_delay, 0.003, 1e-6);
    EXPECT_THAT(index.warnings, ElementsAre(AllOf(reason, Names("recorded"))));
  }

  static RgbdDecoder Decoder(SequenceIndex index) {
    Calibration calibration = ResolveCalibration({}, "", &index);
    return {std::move(index), std::move(calibration)};
  }
};

TEST_F(BagSequenceTest, ReadsAllCompressionsAndEncodings) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    for (const char* encoding : {"32FC1", "16UC1"}) {
      const std::string path = Path(std::string(compression) + encoding + ".bag");
      WriteBag(WriteRos1Bag(path, compression), encoding);
      ExpectFivePairs(path);
    }
  }
}

TEST_F(BagSequenceTest, TreatsNoMeasurementInMetresAsZero) {
  {
    const auto bag = WriteRos1Bag(Path("x.bag"));
    cv::Mat depth(2, 2, CV_32FC1, cv::Scalar::all(1.5));
    depth.at<float>(0, 0) = std::nanf("");
    depth.at<float>(0, 1) = HUGE_VALF;
    depth.at<float>(1, 0) = -1.0f;
    bag->Write("/d", "sensor_msgs/Image", 1.0, ImageMessage(1, 0, depth, "32FC1"));
    bag->Write("/c", "sensor_msgs/Image", 1.0,
               ImageMessage(1, 0, cv::Mat::zeros(2, 2, CV_8UC1), "mono8"));
  }
  SequenceIndex index = OpenBag(Path("x.bag"));
  Calibration calibration;
  calibration.camera = {10.0, 10.0, 0.5, 0.5, 2, 2};
  const RgbdImage image = RgbdDecoder(index, calibration).Decode(0);
  EXPECT_EQ(image.depth.at<float>(0, 0), 0.0f);
  EXPECT_EQ(image.depth.at<float>(0, 1), 0.0f);
  EXPECT_EQ(image.depth.at<float>(1, 0), 0.0f);
  EXPECT_EQ(image.depth.at<float>(1, 1), 1.5f);
}

TEST_F(BagSequenceTest, TakesTheTopicsThatAreNamed) {
  WriteBag("x.bag", "16UC1");
  const auto open_other = [&] { OpenBag(Path("x.bag"), {"/no", ""}); };
  EXPECT_THAT(MessageOf(open_other),
              Names("x.bag", "/no", "--color-topic", "/camera/rgb/image_color"));
  const SequenceIndex infrared = OpenBag(Path("x.bag"), {"/camera/ir/image", ""});
  ASSERT_EQ(infrared.entries.size(), 1u);
  EXPECT_THAT(infrared.entries[0].color_path, Names("x.bag:/camera/ir/image", "0"));
}

TEST_F(BagSequenceTest, PrefersThePresetThatTheNameSuggests) {
  WriteBag("rgbd_dataset_freiburg1_xyz.bag", "32FC1");
  WriteText("rgbd_dataset_freiburg1_xyz-groundtruth.txt", "100.0 0 0 0 0 0 0 1\n");
  const SequenceIndex index = OpenBag(Path("rgbd_dataset_freiburg1_xyz.bag"));
  EXPECT_EQ(index.preset, "tum-fr1");
  EXPECT_FALSE(index.calibration);
  EXPECT_EQ(index.ground_truth.size(), 1u);
}

// Nanoseconds of image i at 30 Hz.
uint32_t At30Hz(int i) { return static_cast<uint32_t>(33333333 * i); }

TEST_F(BagSequenceTest, FallsBackToTheTimesOfRecording) {
  ExpectReceiveTimes(OpenStamped([](int, bool) { return Stamp(0, 0); }), Names("colour", "zero"));
  ExpectReceiveTimes(OpenStamped([](int, bool) { return Stamp(1604645033, 7); }),
                     Names("colour", "repeat"));
  ExpectReceiveTimes(OpenStamped([](int i, bool is_depth) {
                       return is_depth ? Stamp(0, 0) : Stamp(1604645033, At30Hz(i));
                     }),
                     Names("depth", "zero"));
  ExpectReceiveTimes(OpenStamped([](int i, bool is_depth) {
                       return Stamp(is_depth ? 1604645033 : 812, At30Hz(i));
                     }),
                     Names("clocks"));
  ExpectReceiveTimes(
      OpenStamped([](int i, bool) { return Stamp(i < 5 ? 1604645033 : 1604645013, At30Hz(i)); }),
      Names("20.0 s"));
}

TEST_F(BagSequenceTest, GivesAdviceForABagIfNothingIsPaired) {
  {
    const auto bag = WriteRos1Bag(Path("late.bag"));
    const cv::Mat color(2, 2, CV_8UC3, cv::Scalar::all(9)), depth(2, 2, CV_16UC1, 1000);
    for (uint32_t i = 0; i < 5; ++i) {
      bag->Write("/c", "sensor_msgs/Image", 10.0 + i, ImageMessage(10 + i, 0, color, "bgr8"));
      bag->Write("/d", "sensor_msgs/Image", 90.0 + i, ImageMessage(90 + i, 0, depth, "16UC1"));
    }
  }
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("late.bag")); }),
              AllOf(Names("late.bag", "80.000 s later", "copy"),
                    testing::Not(Names("associations.txt")), testing::Not(Names("list"))));
}

TEST_F(BagSequenceTest, LeavesOutMessagesWithoutStamps) {
  const SequenceIndex index = OpenStamped([](int i, bool) {
    return i < 2 ? std::pair<uint32_t, uint32_t>(0, 0)
                 : std::pair<uint32_t, uint32_t>(1604645033, At30Hz(i));
  });
  ASSERT_EQ(index.entries.size(), 8u);
  EXPECT_NEAR(index.entries[0].timestamp, 1604645033.066667, 1e-6);
  EXPECT_THAT(index.warnings, ElementsAre(Names("2", "10", "colour"), Names("2", "10", "depth")));
}

TEST_F(BagSequenceTest, SaysWhyTopicsAreNotUsed) {
  const auto stamp_of = [](int i, bool) {
    return std::pair<uint32_t, uint32_t>(1604645033, At30Hz(i));
  };
  EXPECT_EQ(OpenStamped(stamp_of, "/iris/camera/image_raw").entries.size(), 10u);
  EXPECT_THAT(MessageOf([&] { OpenStamped(stamp_of, "/camera/ir/image_raw"); }),
              Names("no topic", "/camera/ir/image_raw", "infrared", "--color-topic"));
  WriteBag("x.bag", "16UC1");
  EXPECT_THAT(OpenBag(Path("x.bag")).warnings, IsEmpty());
}

TEST_F(BagSequenceTest, NamesWhatIsWrong) {
  WriteText("text.bag", "this is no bag");
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("text.bag")); }),
              Names("text.bag", "no bag", "ROS 1", "ROS 2"));
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("no.bag")); }), Names("no.bag", "exist"));
  WriteRos1Bag(Path("empty.bag"));
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("empty.bag")); }),
              Names("empty.bag", "no topic", "depth", "none"));
  WriteBag("cut.bag", "16UC1");
  const std::string bytes = ReadFile(Path("cut.bag"));
  WriteText("cut.bag", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("cut.bag")); }), Names("cut.bag"));
}

TEST_F(BagSequenceTest, ReadsBagsOfRos2InAllCompressions) {
  for (const char* compression : {"none", "zstd"}) {
    const std::string path = Path(std::string(compression) + ".db3");
    WriteBag(WriteDb3Bag(path, compression), "16UC1");
    ExpectFivePairs(path);
  }
  for (const char* compression : {"", "zstd", "lz4"}) {
    for (const bool has_index : {true, false}) {
      const std::string path = Path(compression + std::to_string(has_index) + ".mcap");
      WriteBag(WriteMcapBag(path, {compression, true, has_index}), "32FC1");
      ExpectFivePairs(path);
    }
  }
  WriteBag(WriteMcapBag(Path("flat.mcap"), {"", false, false}), "16UC1");
  ExpectFivePairs(Path("flat.mcap"));
  WriteBag(WriteMcapBag(Path("ros1.mcap"), {}, RosSerialization::kRos1), "16UC1");
  ExpectFivePairs(Path("ros1.mcap"));
}

TEST_F(BagSequenceTest, UnpacksFilesThatAreCompressedAsAWhole) {
  for (const std::string name : {"x.db3", "x.mcap"}) {
    WriteBag(name == "x.db3" ? WriteDb3Bag(Path(name)) : WriteMcapBag(Path(name)), "16UC1");
    CompressFile(Path(name), Path(name + ".zstd"));
    ExpectFivePairs(Path(name + ".zstd"));
    WriteText("cut-" + name + ".zstd", ReadFile(Path(name + ".zstd")).substr(0, 200));
    EXPECT_THAT(MessageOf([&] { OpenBag(Path("cut-" + name + ".zstd")); }),
                Names("cut-" + name + ".zstd", "cut off"));
  }
}

// The parts follow each other as metadata.yaml lists them; without it, as their numbers do.
TEST_F(BagSequenceTest, ReadsBagsInSeveralFiles) {
  for (const std::string ending : {".db3", ".mcap"}) {
    const std::string folder = "split" + ending.substr(1);
    std::filesystem::create_directory(Path(folder));
    for (const int i : {2, 10}) {
      const std::string path = Path(folder + "/x_" + std::to_string(i) + ending);
      const auto bag = ending == ".db3" ? WriteDb3Bag(path) : WriteMcapBag(path);
      bag->Write("/c", "sensor_msgs/Image", i,
                 ImageMessage(0, 0, cv::Mat(2, 2, CV_8UC3), "bgr8", bag->serialization()));
      bag->Write("/d", "sensor_msgs/Image", i,
                 ImageMessage(0, 0, cv::Mat(2, 2, CV_16UC1), "16UC1", bag->serialization()));
    }
    const auto names = [&] {
      const std::unique_ptr<BagFile> bag = OpenBagFile(Path(folder));
      EXPECT_EQ(bag->NumMessages("/c"), 2);
      return std::vector<double>{bag->ReceiveTime("/c", 0), bag->ReceiveTime("/c", 1)};
    };
    EXPECT_TRUE(IsBag(Path(folder)));
    std::filesystem::create_directory(Path(folder + "/rgb"));
    EXPECT_FALSE(IsBag(Path(folder)));
    std::filesystem::remove(Path(folder + "/rgb"));
    EXPECT_THAT(names(), ElementsAre(2.0, 10.0));
    WriteText(folder + "/metadata.yaml",
              "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n    - x_10" +
                  ending + "\n    - x_2" + ending + "\n");
    EXPECT_THAT(names(), ElementsAre(10.0, 2.0));
    CompressFile(Path(folder + "/x_2" + ending), Path(folder + "/x_2" + ending + ".zstd"));
    std::filesystem::remove(Path(folder + "/x_2" + ending));
    EXPECT_THAT(names(), ElementsAre(10.0, 2.0));
    std::filesystem::remove(Path(folder + "/x_2" + ending + ".zstd"));
    EXPECT_THAT(MessageOf(names), Names("x_2" + ending, "does not exist", "metadata.yaml"));
    WriteText(folder + "/metadata.yaml", "rosbag2_bagfile_information: [\n");
    EXPECT_THAT(MessageOf(names), Names("metadata.yaml", "cannot be read"));
  }
}

TEST_F(BagSequenceTest, NamesBagsWithoutTheirEndings) {
  std::filesystem::create_directory(Path("walk_2026.01.02"));
  EXPECT_EQ(BagName(Path("walk_2026.01.02")), "walk_2026.01.02");
  EXPECT_EQ(BagName(Path("walk_2026.01.02/")), "walk_2026.01.02");
  EXPECT_EQ(BagName("a/walk.db3"), "walk");
  EXPECT_EQ(BagName("a/walk_0.mcap.zstd"), "walk_0");
}

// A recorder that was killed leaves no end, and in its last chunk no index.
TEST_F(BagSequenceTest, ReadsMcapFilesThatWereCutOff) {
  WriteBag(WriteMcapBag(Path("whole.mcap"), {"zstd", true, true}), "16UC1");
  const std::string bytes = ReadFile(Path("whole.mcap"));
  WriteText("cut.mcap", bytes.substr(0, bytes.size() - 30));
  const SequenceIndex index = OpenBag(Path("cut.mcap"));
  EXPECT_EQ(index.entries.size(), 5u);
  EXPECT_THAT(index.warnings, ElementsAre(Names("cut.mcap", "end", "missing")));
  for (size_t size = 0; size < bytes.size(); size += 7) {
    WriteText("cut.mcap", bytes.substr(0, size));
    try {
      EXPECT_LE(OpenBag(Path("cut.mcap")).entries.size(), 5u);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), Names("cut.mcap"));
    }
  }
}

TEST_F(BagSequenceTest, NamesDamagedBagsOfRos2) {
  WriteText("x.db3", std::string("SQLite format 3\0", 16) + std::string(1000, 'x'));
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("x.db3")); }), Names("x.db3", "ROS 2"));
  WriteText("x.mcap", "\x89MCAP0\r\n");
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("x.mcap")); }), Names("x.mcap", "no topic", "depth"));
  WriteText("y.mcap", "\x89MCAP9\r\n");
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("y.mcap")); }), Names("y.mcap", "version"));
  // One byte of a compressed image.
  WriteBag(WriteMcapBag(Path("z.mcap"), {"zstd", true, true}), "16UC1");
  std::string bytes = ReadFile(Path("z.mcap"));
  const size_t frame = bytes.find("\x28\xb5\x2f\xfd");
  ASSERT_NE(frame, std::string::npos);
  WriteText("z.mcap", bytes.replace(frame + 4, 8, "\xff\xff\xff\xff\xff\xff\xff\xff"));
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("z.mcap")); }), Names("z.mcap"));
}

// Found by fuzzing: rosbag_storage allocated 2 GB for a file of 21 bytes.
TEST_F(BagSequenceTest, RefusesBagsOfRos1WithLyingLengths) {
  WriteText("lying.bag", "#ROSBAG V2.0\n\xff\xff\xff\x7f   ");
  WriteText("short.bag", "#ROSBAG V2.0\n\xff");
  for (const auto& [name, what] :
       {std::pair("lying.bag", "longer than the file"), std::pair("short.bag", "too early")}) {
    try {
      OpenBag(Path(name));
      ADD_FAILURE() << name << " is read";
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), Names(name, what));
    }
  }
}

TEST_F(BagSequenceTest, LeavesNothingBesideABag) {
  WriteBag(WriteDb3Bag(Path("x.db3")), "16UC1");
  // A database that keeps a log while it is open, as recorders set it.
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(Path("x.db3").c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  EXPECT_EQ(OpenBag(Path("x.db3")).entries.size(), 5u);
  EXPECT_THAT(ListFolder(Folder()), ElementsAre(Path("x.db3")));
}

TEST_F(BagSequenceTest, FindsTheGroundTruthOfAFolderWithASlash) {
  std::filesystem::create_directory(Path("walk"));
  WriteBag(WriteDb3Bag(Path("walk/walk_0.db3")), "16UC1");
  WriteText("walk-groundtruth.txt", "100.0 0 0 0 0 0 0 1\n");
  EXPECT_EQ(OpenBag(Path("walk/")).ground_truth.size(), 1u);
}

TEST_F(BagSequenceTest, GoesOnWithoutATopicThatIsDamaged) {
  auto bag = WriteDb3Bag(Path("x.db3"));
  bag->Write("/other", "sensor_msgs/Image", 1.0, "short");
  WriteBag(std::move(bag), "16UC1");
  const SequenceIndex index = OpenBag(Path("x.db3"));
  EXPECT_EQ(index.entries.size(), 5u);
  EXPECT_THAT(index.warnings, ElementsAre(Names("/other, message 0", "ends too early")));
}

}  // namespace
}  // namespace msc_vo
