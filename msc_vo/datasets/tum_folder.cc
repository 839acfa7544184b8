// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/tum_folder.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "msc_vo/datasets/depth_folder.h"
#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/image_times.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Units per second of the stamps of the list `name`, whose median interval is at most
// `max_interval` seconds. `images` is the time range of the images, if it is known.
double StampsPerSecond(const std::string& name, const std::vector<double>& stamps,
                       WholeStamps whole, const std::optional<TimeRange>& images,
                       double max_interval, SequenceIndex* index) {
  const TimeUnit unit = GuessTimeUnit(stamps, images, max_interval);
  const auto overlap_at = [&](double rate) {
    const TimeRange range = RangeOf(stamps, unit);
    return images ? Overlap({range.begin / rate, range.end / rate, unit}, *images) : 1.0;
  };
  if (whole == WholeStamps::kFrameNumbers && AreFrameNumbers(stamps)) {
    const double overlap = overlap_at(kDefaultFrameRate);
    // Ground truth of a whole recording overlaps little with the images of a part.
    const bool is_of_more = overlap > 0.0 && MedianInterval(stamps) < 1e3 * kMinImageInterval;
    if (is_of_more || overlap >= overlap_at(UnitsPerSecond(unit))) {
      if (!images) index->has_assumed_times = true;
      return kDefaultFrameRate;
    }
  }
  if (!images) index->stamp_unit = unit;
  if (!images && unit == TimeUnit::kSeconds && AreFrameNumbers(stamps)) {
    index->warnings.push_back(name +
                              ": the stamps are whole numbers and interpreted as seconds; if they "
                              "are frame numbers, divide them by the images per second, or pair "
                              "rgb/ and depth/ by name with --format rgb-depth, at the times of "
                              "times.txt or 30 per second");
  }
  if (unit != TimeUnit::kSeconds) {
    const bool is_certain = images || UnitOfDate(stamps.front()) == unit;
    const double interval = MedianInterval(stamps) / UnitsPerSecond(unit);
    index->warnings.push_back(name + ": the stamps are " + ToString(unit) +
                              " and are converted to seconds" +
                              (is_certain ? "" : DescribeSlowRate(interval)));
  }
  return UnitsPerSecond(unit);
}

// Converts the stamps of the images to seconds. `other`: the time range of the other list.
void ToSeconds(const std::string& name, WholeStamps whole, const std::optional<TimeRange>& other,
               std::vector<ListedImage>* images, SequenceIndex* index) {
  const double rate = StampsPerSecond(name, TimestampsOf(*images, &ListedImage::stamp), whole,
                                      other, kMaxImageInterval, index);
  for (ListedImage& image : *images) image.stamp /= rate;
}

void ToSeconds(const std::string& color_name, const std::string& depth_name, WholeStamps whole,
               ImageLists* images, SequenceIndex* index) {
  ToSeconds(color_name, whole, std::nullopt, &images->color, index);
  const TimeRange range =
      RangeOf(TimestampsOf(images->color, &ListedImage::stamp), index->stamp_unit);
  ToSeconds(depth_name, whole, range, &images->depth, index);
}

// Reads the lists of a folder, with stamps in seconds.
ImageLists ReadLists(const fs::path& folder, WholeStamps whole, SequenceIndex* index) {
  const std::string color = FindColorList(folder.string());
  const std::string depth = FindDepth(folder.string(), ".txt", &index->warnings);
  if (color.empty() || depth.empty()) {
    throw std::runtime_error((folder / (color.empty() ? "rgb.txt" : "depth.txt")).string() +
                             ": does not exist; a TUM folder needs rgb.txt and depth.txt (or "
                             "associations.txt). --format rgb-depth pairs rgb/ and depth/ by name");
  }
  ImageLists images = {ReadImageList(color, &index->warnings),
                       ReadImageList(depth, &index->warnings)};
  ToSeconds(fs::path(color).filename().string(), fs::path(depth).filename().string(), whole,
            &images, index);
  return images;
}

// Warns if an association file has far fewer rows than the lists beside it.
void CheckAssociated(const std::string& directory, const std::string& name, size_t num_rows,
                     SequenceIndex* index) {
  constexpr double kUsual = 0.9;  // ratio; some images have no partner
  const std::string color = FindColorList(directory);
  const std::string depth = FindDepth(directory, ".txt");
  if (color.empty() || depth.empty()) return;
  const size_t num_listed = std::min(ReadTextLines(color).size(), ReadTextLines(depth).size());
  if (static_cast<double>(num_rows) >= kUsual * static_cast<double>(num_listed)) return;
  index->warnings.push_back(name + FormatText(": has %zu rows, but the lists beside it have %zu "
                                              "images; remove the file to use all of them",
                                              num_rows, num_listed));
}

// Reads the reference that `record` writes, whose first comment says what it is. Other files of
// this name are ignored.
void ReadReferenceFile(const std::string& path, WholeStamps whole, SequenceIndex* index) {
  if (!HasEntry(path)) return;
  const std::vector<TextLine> lines = ReadTextLines(path);
  const std::string prefix = kReferenceComment;
  if (lines.empty() || lines[0].comment.rfind(prefix, 0) != 0) return;
  ReadGroundTruthFile(path, whole, index);
  index->reference = lines[0].comment.substr(prefix.size());
}

}  // namespace

void ReadTumEntries(const std::string& directory, WholeStamps whole, SequenceIndex* index) {
  const std::string associations = FindAssociations(directory);
  if (!associations.empty()) {
    ImageLists images = ReadAssociations(associations, &index->warnings);
    const std::string name = fs::path(associations).filename().string();
    CheckAssociated(directory, name, images.color.size(), index);
    ToSeconds(name + ", colour", name + ", depth", whole, &images, index);
    PairByRow(images, index);
    return;
  }
  const ImageLists images = ReadLists(directory, whole, index);
  PairByTime(images, MaxPairDifference(images), index);
}

void ReadTumGroundTruth(const std::string& directory, WholeStamps whole, SequenceIndex* index) {
  const std::string path = FindEntry(directory, "groundtruth.txt");
  const std::string truth = path.empty() ? FindFreiburgTruth(directory) : path;
  if (!truth.empty()) {
    ReadGroundTruthFile(truth, whole, index);
  } else {
    ReadReferenceFile(PathIn(directory, "reference.txt"), whole, index);
  }
}

void ReadGroundTruthFile(const std::string& path, WholeStamps whole, SequenceIndex* index) {
  const std::string name = fs::path(path).filename().string();
  std::optional<TrajectoryFile> file;
  try {
    file = ReadTrajectoryFile(path);
  } catch (const NotATrajectory& error) {
    index->warnings.push_back(error.what() + std::string("; the ground truth is left out"));
    return;
  }
  if (file->num_left_out > 0) index->warnings.push_back(name + ": " + file->DescribeLeftOut());
  if (!file->has_stamps) return AssignPosesInOrder(name, std::move(*file), index);
  std::vector<double> times = TimestampsOf(file->poses, &TimedPose::timestamp);
  times.insert(times.end(), file->times_left_out.begin(), file->times_left_out.end());
  std::sort(times.begin(), times.end());
  const TimeRange images =
      RangeOf(TimestampsOf(index->entries, &SequenceEntry::timestamp), index->stamp_unit);
  const double rate =
      file->unit ? 1.0 : StampsPerSecond(name, times, whole, images, kMaxPoseInterval, index);
  for (TimedPose& pose : file->poses) pose.timestamp /= rate;
  for (double& time : times) time /= rate;
  index->ground_truth = std::move(file->poses);
  if (!file->unit && rate == kDefaultFrameRate) {
    CheckTimesOfTruth(name, index);
  } else {
    AdoptTimesOfTruth(name, times, index);
  }
}

std::string FindFreiburgTruth(const std::string& directory) {
  constexpr char kEnding[] = ".gt.freiburg";
  std::string first;
  for (const std::string& path : ListFolder(directory)) {
    const size_t at = path.rfind(kEnding);
    if (at == std::string::npos || at + sizeof(kEnding) - 1 != path.size()) continue;
    if (first.empty() || path < first) first = path;
  }
  return first;
}

}  // namespace msc_vo
