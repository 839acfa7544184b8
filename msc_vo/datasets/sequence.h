// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/sensor/depth_limits.h"
#include "msc_vo/sensor/depth_sensor.h"

namespace msc_vo {

class ImageContainer;
class ImageMasks;
class RgbdCamera;
struct SequenceFormat;

/// The files of one RGB-D image of a sequence.
struct SequenceEntry {
  double timestamp = 0.0;  ///< seconds
  std::string color_path;
  std::string depth_path;
  std::string origin;  ///< list that names the pair, "rgb.txt:12"; empty: found in a folder
  /// Seconds from the colour image to the depth image; 0 if their stamps are on different clocks.
  double depth_delay = 0.0;
  /// Positions in SequenceIndex::container, if there is one; the paths then only name the images.
  int color_index = -1;
  int depth_index = -1;
  /// Positions of the images in their streams, before images without a partner were left out; -1:
  /// not known.
  int color_position = -1;
  int depth_position = -1;
};

/// Raw depth values at which the images of a sequence are clipped.
struct ClippedDepth {
  DepthLimits limits;      ///< raw units; values at and beyond them do not count as measured
  bool is_metric = false;  ///< the images hold metres, which then are the raw units
  /// Ratio of the pixels that are left out because they are too near or too far.
  double nearest_ratio = 0.0;
  double farthest_ratio = 0.0;
};

/// What the source does not say of its cameras, one sentence each; empty: nothing.
struct CameraWarnings {
  std::string color;
  std::string depth;
};

/// The contents of a sequence folder or of another source of images; images are not decoded.
struct SequenceIndex {
  std::string format;                  ///< name of the layout, "tum"
  std::string recorder;                ///< what recorded it, as far as known: "Stray Scanner"
  std::string directory;               ///< without trailing slash; or the file of a recording
  std::vector<SequenceEntry> entries;  ///< in order of time, stamps unique
  size_t num_listed = 0;  ///< images that the source names, of the stream with fewer of them
  size_t num_color = 0;   ///< colour images before pairing, see SequenceEntry::color_position
  size_t num_depth = 0;   ///< the same of depth
  TimeUnit stamp_unit = TimeUnit::kSeconds;  ///< original unit of the image stamps
  bool has_assumed_times = false;  ///< no source gives times; they follow from an assumed rate
  /// Calibration file of the folder; for images of the size of depth.
  std::optional<Calibration> calibration;
  std::string preset;          ///< camera preset guessed from the layout or the name; may be empty
  int invalid_depth = 0;       ///< raw depth value for "no measurement", in addition to 0
  ClippedDepth clipped_depth;  ///< see FindClippedDepth()
  bool scale_color = false;    ///< colour is larger than depth and is scaled down to its size
  /// Size of the stored colour images, if FitToImageSizes() reduces them; none: it does not.
  std::optional<ImageSize> reduced_from;
  /// Depth shows the view of the colour images, whatever its size.
  bool is_same_view = false;
  /// The images, if they are in one file; null: every image is a file.
  std::shared_ptr<const ImageContainer> container;
  /// What is left out of the images; null: nothing.
  std::shared_ptr<const ImageMasks> masks;
  /// A live camera. There are no entries then.
  std::shared_ptr<RgbdCamera> camera;
  /// Raw depth units per metre that the source defines. They replace those of a camera preset.
  std::optional<double> depth_scale;
  /// Units per metre of depth images of floating-point numbers.
  double float_depth_scale = 1.0;
  std::vector<TimedPose> ground_truth;  ///< in order of time; empty: there is none
  /// Empty if `ground_truth` is that. Otherwise the poses are the estimate of another program,
  /// which this names, "ARKit": a reference to compare with, whose errors are not known.
  std::string reference;
  std::vector<std::string> warnings;  ///< for the user, one sentence each
  CameraWarnings camera_warnings;     ///< not among `warnings`; see ResolveCalibration()

  /// The sensor of the depth images according to `calibration`; kAuto: the source gives none.
  DepthSensor GivenDepthSensor() const {
    return calibration ? calibration->depth_sensor : DepthSensor::kAuto;
  }
};

/// Returns the names that OpenSequence() accepts as `format`, except "auto".
std::vector<std::string> SequenceFormatNames();

/// Reads the lists and the ground truth of a sequence folder. `format` is "auto" or one of
/// SequenceFormatNames().
/// Throws std::runtime_error naming file, line and fix if the folder is not a sequence, a list or
/// the ground truth is malformed, or fewer than half of the images can be used;
/// std::invalid_argument on an unknown format.
SequenceIndex OpenSequence(const std::string& directory, const std::string& format = "auto");
/// The same with further layouts, which are looked for first.
SequenceIndex OpenSequence(const std::string& directory, const std::string& format,
                           const std::vector<SequenceFormat>& further);

/// Sorts the entries by time and removes those with the stamp of another one, with warnings.
void OrderEntries(SequenceIndex* index);

/// Throws std::runtime_error that gives the warnings as reasons if no entry is left, or fewer than
/// half of the listed images. `source` says where they were looked for, "x.bag (/color, /depth)".
void RequireMostImages(const SequenceIndex& index, const std::string& source);

/// What SequenceIndex::ground_truth is called, "ground truth" or "reference (ARKit)", and the name
/// of the file that it is written to, groundtruth.txt or reference.txt.
std::string TruthName(const SequenceIndex& index);
const char* TruthFileName(const SequenceIndex& index);

/// Returns the folder of the sequence and the folders of its images, or the file that holds them.
std::vector<std::string> InputFolders(const SequenceIndex& index);

/// Throws std::runtime_error if writing `file` would destroy a part of the sequence: an image or
/// the file that holds them, or a text file of its folder (lists, camera, trajectories); or if
/// `file` lies in a folder of its images. Other files in the folder of the sequence are results.
void RefuseToOverwriteSequence(const SequenceIndex& index, const std::string& file);

}  // namespace msc_vo
