// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The depth sensor of recorded and rendered sequences that are not part of the project: skipped
// where ../shared/sequences is missing.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/sensor/depth_statistics.h"

namespace msc_vo {
namespace {

constexpr double kDepthFactor = 5000.0;  // of all of them

class RecordedDepthSensorTest : public testing::TestWithParam<std::string> {};

TEST_P(RecordedDepthSensorTest, IsStructuredLight) {
  const std::filesystem::path folder = std::filesystem::path(MSC_VO_SHARED_SEQUENCES) / GetParam();
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " does not exist";
  const SequenceIndex index = OpenSequence(folder.string());
  for (size_t i = 0; i < index.entries.size(); i += 25) {
    cv::Mat depth;
    cv::imread(index.entries[i].depth_path, cv::IMREAD_UNCHANGED)
        .convertTo(depth, CV_32F, 1.0 / kDepthFactor);
    ASSERT_FALSE(depth.empty()) << i;
    EXPECT_EQ(ClassifyDepthSensor(MeasureDepthStatistics(depth)), DepthSensor::kStructuredLight)
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Sequences, RecordedDepthSensorTest,
                         testing::Values("kitchen", "fr1_rpy", "snot_far", "living", "corridor",
                                         "bare", "nonmanhattan", "icl_office"));

}  // namespace
}  // namespace msc_vo
