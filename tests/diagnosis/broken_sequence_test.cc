// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Verdicts on broken and miscalibrated copies of a rendered sequence.
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include "tests/diagnosis/recording.h"
#include "tests/support/temporary_folder.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/clipped_depth_search.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/diagnosis/sequence_check.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

constexpr int kNumImages = 60;
constexpr int kFewImages = 20;  // enough for checks without motion

using Damage = std::function<void(Recording*)>;

class BrokenSequenceTest : public TemporaryFolder {
 protected:
  static void SetUpTestSuite() { recording_ = new Recording(Record(SmallRoom(), kNumImages)); }
  static void TearDownTestSuite() { delete recording_; }

  // Writes a copy of the recording and returns the findings on it. `damage` changes the images and
  // poses that are written, `damage_files` the files.
  Findings Diagnose(const Damage& damage, bool deep, const std::string& name,
                    const std::function<void(const std::string& folder)>& damage_files = {},
                    const std::optional<double>& field_of_view = {}) {
    Recording recording = *recording_;
    if (!deep) recording.images.resize(kFewImages);
    for (Recording::Image& image : recording.images) {
      image.color = image.color.clone();
      image.depth = image.depth.clone();
    }
    if (damage) damage(&recording);
    const std::string folder = Path(name);
    recording.Write(folder);
    if (damage_files) damage_files(folder);
    SequenceIndex index = OpenSequence(folder);
    CameraSettings settings;
    settings.field_of_view = field_of_view;
    const Calibration calibration = ResolveCalibration(settings, "", &index);
    index.clipped_depth = FindClippedDepth(index);
    SequenceCheckOptions options;
    options.deep = deep;
    options.max_images = 12;
    const Findings findings = CheckSequence(RgbdDecoder(index, calibration), options);
    std::filesystem::remove_all(folder);
    return findings;
  }

  void ExpectWarning(const std::string& name, bool deep, const std::string& check,
                     const NamesMatcher& names, const Damage& damage) {
    ExpectFinding(Diagnose(damage, deep, name), Severity::kWarning, check, names, name);
  }
  void ExpectError(const std::string& name, const std::string& check, const NamesMatcher& names,
                   const Damage& damage) {
    ExpectFinding(Diagnose(damage, false, name), Severity::kError, check, names, name);
  }
  // A warning of the motion, and no other. Returns its value.
  double ExpectOnly(const std::string& name, const std::string& check, const NamesMatcher& names,
                    const Damage& damage) {
    const Findings findings = Diagnose(damage, true, name);
    ExpectFinding(findings, Severity::kWarning, check, names, name);
    double value = std::nan("");
    for (const Finding& finding : findings) {
      if (finding.check == check) {
        value = finding.value.value_or(value);
      } else {
        EXPECT_EQ(finding.severity, Severity::kGood) << name << ": " << Describe(finding);
      }
    }
    return value;
  }
  static void ExpectClean(const Findings& findings) {
    for (const Finding& finding : findings) {
      EXPECT_EQ(finding.severity, Severity::kGood) << finding.check << ": " << Describe(finding);
    }
  }

  static inline Recording* recording_ = nullptr;
};

void ForAllImages(Recording* recording, const std::function<void(Recording::Image*)>& change) {
  for (Recording::Image& image : recording->images) change(&image);
}

void Shift(double x, double y, cv::Mat* image) {
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, x, 0, 1, y);
  cv::Mat moved;
  cv::warpAffine(*image, moved, shift, image->size(), cv::INTER_NEAREST);
  *image = moved;
}

TEST_F(BrokenSequenceTest, FindsNothingInSoundSequences) {
  ExpectClean(Diagnose({}, true, "sound"));
  ExpectClean(Diagnose(
      [](Recording* r) {
        r->calibration.depth_scale = 1000.0;
        ForAllImages(r, [](Recording::Image* i) { i->depth.convertTo(i->depth, CV_16U, 0.2); });
      },
      true, "millimetres"));
}

TEST_F(BrokenSequenceTest, FindsNothingInAnotherScene) {
  SyntheticSequenceOptions options = SmallRoom();
  options.scene = SceneKind::kSlanted;
  options.seed = 2;
  const Recording other = Record(options, kNumImages);
  ExpectClean(Diagnose([&](Recording* r) { *r = other; }, true, "other"));
}

// Replaces each depth (metres) by a raw value, in place.
Damage Encode(const std::function<double(double depth)>& encode) {
  return [encode](Recording* r) {
    const double scale = r->calibration.depth_scale;
    ForAllImages(r, [&](Recording::Image* i) {
      for (auto p = i->depth.begin<uint16_t>(); p != i->depth.end<uint16_t>(); ++p) {
        if (*p > 0) *p = cv::saturate_cast<uint16_t>(encode(*p / scale));
      }
    });
    r->calibration.depth_scale = 1000.0;
  };
}

TEST_F(BrokenSequenceTest, NamesValuesThatAreNoDepths) {
  const Damage disparity = Encode([](double z) { return 6000.0 / z; });
  ExpectError("disparity", "depth.curve", Names("inverse"), disparity);
  ExpectError("inverted", "depth.curve", Names("inverted"),
              Encode([](double z) { return 10000.0 - 1000.0 * z; }));
  // No other part of the calibration is blamed.
  for (const Finding& finding : Diagnose(disparity, true, "deep")) {
    if (finding.check == "depth.curve") continue;
    EXPECT_NE(finding.severity, Severity::kError) << Describe(finding);
    EXPECT_FALSE(finding.check.rfind("calibration", 0) == 0 && finding.severity != Severity::kGood)
        << Describe(finding);
  }
}

TEST_F(BrokenSequenceTest, FindsDefectsOfDepth) {
  ExpectWarning("factor_5", false, "depth.scale", Names("depth_scale", "5000.0"),
                [](Recording* r) { r->calibration.depth_scale /= 5.0; });
  ExpectWarning("factor_1_5", false, "depth.scale", Names("depth_scale", "5000.0"),
                [](Recording* r) { r->calibration.depth_scale *= 5.0; });
  ExpectError("factor_absurd", "depth.scale", Names("depth_scale", "1000.0"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->depth.convertTo(i->depth, CV_16U, 0.2); });
    r->calibration.depth_scale = 100000.0;
  });
  for (const double units : {5000.0, 1000.0, 100.0}) {
    ExpectError("byte_swapped", "depth.byte_order", Names("bytes"), [units](Recording* r) {
      r->calibration.depth_scale = units;
      ForAllImages(r, [units](Recording::Image* i) {
        i->depth.convertTo(i->depth, CV_16U, units / 5000.0);
        for (auto p = i->depth.begin<uint16_t>(); p != i->depth.end<uint16_t>(); ++p) {
          *p = static_cast<uint16_t>(*p << 8 | *p >> 8);
        }
      });
    });
  }
  ExpectError("no_depth", "depth.valid", Names("measurement"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->depth.setTo(0); });
  });
  ExpectWarning("little_depth", false, "depth.valid", Names("%"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->depth.rowRange(40, 240).setTo(0); });
  });
  ExpectWarning("saturated", false, "depth.clipped", Names("13.107", "65535"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->depth.rowRange(0, 20).setTo(65535); });
  });
  ExpectWarning("clipped", false, "depth.clipped", Names("2.500", "12500"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { cv::min(i->depth, 12500, i->depth); });
  });
  ExpectWarning("clipped_near", false, "depth.clipped", Names("nearer"), [](Recording* r) {
    ForAllImages(
        r, [](Recording::Image* i) { i->depth.setTo(11000, (i->depth > 0) & (i->depth < 11000)); });
  });
  ExpectError("eight_bits", "images.decoding", Names("8 bits"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->depth.convertTo(i->depth, CV_8U, 0.01); });
  });
  ExpectError("size", "images.decoding", Names("160x100"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) {
      cv::resize(i->depth, i->depth, cv::Size(160, 100), 0, 0, cv::INTER_NEAREST);
    });
  });
}

TEST_F(BrokenSequenceTest, FindsDefectsOfRegistration) {
  ExpectWarning(
      "shifted", false, "registration.shift", Names("px", "registration"),
      [](Recording* r) { ForAllImages(r, [](Recording::Image* i) { Shift(15, 0, &i->depth); }); });
  ExpectError("mirrored_color", "registration.mirrored", Names("left", "right"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { cv::flip(i->color, i->color, 1); });
  });
  ExpectError("mirrored_depth", "registration.mirrored", Names("top", "bottom"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { cv::flip(i->depth, i->depth, 0); });
  });
}

TEST_F(BrokenSequenceTest, FindsMirroredImagesInFewImages) {
  Recording recording = *recording_;
  recording.images.resize(kFewImages);
  for (const bool is_mirrored : {false, true}) {
    for (Recording::Image& image : recording.images) {
      image.color = image.color.clone();
      if (is_mirrored) cv::flip(image.color, image.color, 0);
    }
    recording.Write(Path("quick"));
    SequenceIndex index = OpenSequence(Path("quick"));
    const Calibration calibration = ResolveCalibration({}, "", &index);
    const Findings findings = CheckSequenceQuickly(RgbdDecoder(index, calibration));
    EXPECT_EQ(findings.size(), is_mirrored ? 1u : 0u);
    if (!is_mirrored) continue;
    ExpectFinding(findings, Severity::kWarning, "registration.mirrored", Names("top", "bottom"),
                  "quick");
  }
}

TEST_F(BrokenSequenceTest, FindsDefectsOfImages) {
  ExpectError("black", "images.uniform", Names("black", "leave"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) {
      i->color.setTo(2);
      i->depth.setTo(0);
    });
  });
  ExpectWarning("dark", false, "images.uniform", Names("black", "planes"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->color.setTo(2); });
  });
  const Findings some_black = Diagnose(
      [](Recording* r) {
        for (int i = 10; i < 15; ++i) r->images[i].color.setTo(2);
      },
      false, "some_black");
  ExpectFinding(some_black, Severity::kWarning, "images.uniform", Names("black"), "some_black");
  for (const Finding& f : some_black) EXPECT_NE(f.check, "files.frozen_color") << Describe(f);
  ExpectWarning("frozen_color", false, "files.frozen_color", Names("frozen"), [](Recording* r) {
    for (int i = 11; i < 16; ++i) r->images[i].color = r->images[10].color.clone();
  });
  ExpectWarning("frozen_depth", false, "files.frozen_depth", Names("frozen"), [](Recording* r) {
    for (int i = 11; i < 16; ++i) r->images[i].depth = r->images[10].depth.clone();
  });
  ExpectWarning("overexposed", false, "images.overexposed", Names("exposure"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->color = i->color * 2.5; });
  });
  ExpectWarning("dim", false, "images.dim", Names("light"), [](Recording* r) {
    ForAllImages(r, [](Recording::Image* i) { i->color = i->color * 0.2; });
  });
  ExpectWarning("blurred", false, "images.blur", Names("px", "focus"), [](Recording* r) {
    ForAllImages(
        r, [](Recording::Image* i) { cv::GaussianBlur(i->color, i->color, cv::Size(), 3.0); });
  });
}

TEST_F(BrokenSequenceTest, FindsDefectsOfStamps) {
  ExpectWarning("duplicate", false, "sequence", Names("2", "time stamp"), [](Recording* r) {
    for (int i = 10; i < 13; ++i) {
      r->images[i].color_stamp = r->images[i].depth_stamp = r->images[10].color_stamp;
    }
  });
  ExpectWarning("unordered", false, "sequence", Names("order"),
                [](Recording* r) { std::swap(r->images[10], r->images[13]); });
  ExpectWarning("milliseconds", false, "sequence", Names("milliseconds"),
                [](Recording* r) { r->stamp_factor = 1000.0; });
  ExpectWarning("gap", false, "stamps.gaps", Names("1", "gap"), [](Recording* r) {
    r->images.erase(r->images.begin() + 10, r->images.begin() + 16);
  });
  ExpectWarning("depth_clock", false, "sequence", Names("5", "depth image"), [](Recording* r) {
    for (int i = 10; i < 15; ++i) r->images[i].depth_stamp += 10.0;
  });
}

TEST_F(BrokenSequenceTest, FindsDefectsOfFiles) {
  ExpectFinding(Diagnose({}, false, "missing",
                         [](const std::string& folder) {
                           std::filesystem::remove(folder + "/depth/0007.png");
                         }),
                Severity::kError, "files.readable", Names("0007.png", "exist"), "missing");
  ExpectFinding(Diagnose({}, false, "truncated",
                         [](const std::string& folder) {
                           std::filesystem::resize_file(folder + "/rgb/0000.png", 9000);
                         }),
                Severity::kError, "images.decoding", Names("0000.png"), "truncated");
}

TEST_F(BrokenSequenceTest, FindsWrongCalibration) {
  const auto with_focal_length = [](double factor) {
    return [factor](Recording* r) {
      r->calibration.camera.fx *= factor;
      r->calibration.camera.fy *= factor;
    };
  };
  // Within three standard deviations of the estimates.
  const std::string focal_length = "calibration.focal_length";
  const double truth = recording_->calibration.camera.fx;
  EXPECT_NEAR(ExpectOnly("focal_10", focal_length, Names("long", "px"), with_focal_length(1.10)),
              truth, 5.0);
  EXPECT_NEAR(ExpectOnly("focal_3", focal_length, Names("long", "px"), with_focal_length(1.03)),
              truth, 5.0);
  EXPECT_NEAR(ExpectOnly("short", focal_length, Names("short", "px"), with_focal_length(0.95)),
              truth, 5.0);
  EXPECT_NEAR(ExpectOnly("centre", "calibration.principal_point", Names("px"),
                         [](Recording* r) { r->calibration.camera.cx += 10.0; }),
              10.0, 2.4);
}

TEST_F(BrokenSequenceTest, FindsALensThatTheCalibrationDoesNotGive) {
  SyntheticSequenceOptions options = SmallRoom();
  options.lens.k[0] = -0.12;
  const Recording recording = Record(options, kNumImages);
  EXPECT_NEAR(ExpectOnly("lens", "calibration.lens", Names("k1", "k2"),
                         [&](Recording* r) { *r = recording; }),
              options.lens.k[0], 0.02);
}

TEST_F(BrokenSequenceTest, FindsUnregisteredDepth) {
  SyntheticSequenceOptions options = SmallRoom();
  const Eigen::AngleAxisd roll(0.01, Eigen::Vector3d::UnitZ());
  options.depth_rig = DepthRig{290.0, {Eigen::Quaterniond(roll), {0.025, 0.0, 0.0}}};
  const Recording recording = Record(options, kNumImages);
  const Findings findings =
      Diagnose([&](Recording* r) { *r = recording; }, true, "unregistered depth");
  ExpectFinding(findings, Severity::kWarning, "calibration.depth_registration",
                Names("depth camera", "fx", "px"), "rig");
  for (const Finding& finding : findings) {
    if (finding.check == "calibration.depth_registration") {
      EXPECT_NEAR(*finding.value, 290.0, 6.0) << Describe(finding);
    } else if (finding.check.find("calibration.") == 0 || finding.check == "depth.scale" ||
               finding.check == "ground_truth.scale") {
      // Only the registration is wrong, not the scale of depth.
      EXPECT_EQ(finding.severity, Severity::kGood) << Describe(finding);
    }
  }
}

TEST_F(BrokenSequenceTest, ReportsTheRecordedCamera) {
  const auto check = [this](double factor, const std::string& name) {
    return Diagnose(
        [factor](Recording* r) {
          r->calibration.camera.fx *= factor, r->calibration.camera.fy *= factor;
        },
        true, name, {}, 80.0);
  };
  ExpectFinding(check(1.0, "wide"), Severity::kGood, "camera.source", Names("fx", "262.500"),
                "wide");
  ExpectFinding(check(1.0, "wide"), Severity::kGood, "camera.undistorted", Names("80 degrees"),
                "wide");
  ExpectFinding(check(1.04, "wrong"), Severity::kWarning, "calibration.focal_length",
                Names("273.0"), "wrong");
}

TEST_F(BrokenSequenceTest, FindsMirroredImagesWithTheCalibrationOfUnmirroredOnes) {
  // A camera whose principal point is 20 px off the centre: mirroring moves it by 40 px.
  const Findings findings = Diagnose(
      [](Recording* r) {
        ForAllImages(r, [](Recording::Image* i) {
          Shift(20, 0, &i->color);
          Shift(20, 0, &i->depth);
          cv::flip(i->color, i->color, 1);
          cv::flip(i->depth, i->depth, 1);
        });
        r->calibration.camera.cx += 20.0;
      },
      true, "both_mirrored");
  const Finding offset = ExpectFinding(findings, Severity::kWarning, "calibration.principal_point",
                                       Names("px"), "both");
  EXPECT_NEAR(offset.value.value_or(0.0), 40.0, 10.0);
  ExpectFinding(findings, Severity::kWarning, "ground_truth.convention", Names("mirrored"), "both");
}

TEST_F(BrokenSequenceTest, FindsLateDepth) {
  SyntheticSequenceOptions options = SmallRoom();
  options.fps = 20.0;
  options.path.shake = 3.0;  // uniform motion does not tell a latency from a shift
  const Recording recording = Record(options, kNumImages);
  ExpectWarning("late", true, "stamps.depth_latency", Names("ms", "later"), [&](Recording* r) {
    *r = recording;
    // Depth is 0.1 s younger than its stamp says.
    for (int i = 0; i + 2 < kNumImages; ++i) r->images[i].depth = recording.images[i + 2].depth;
    r->images.resize(kNumImages - 2);
  });
}

TEST_F(BrokenSequenceTest, FindsGroundTruthOfOtherTimes) {
  ExpectWarning("other_time", false, "ground_truth.overlap", Names("clock"), [](Recording* r) {
    for (TimedPose& pose : r->truth) pose.timestamp += 1000.0;
  });
}

}  // namespace
}  // namespace msc_vo
