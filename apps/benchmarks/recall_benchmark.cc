// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Recall and precision of place recognition: keyframes from one sequence with ground truth, queries
// from another one in the same world, or from another part of the same one.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/diagnosis/ground_truth_motion.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/place_recognition/place_index.h"

namespace msc_vo {

namespace {

struct View {
  std::shared_ptr<const Frame> frame;
  Rigid3 cam_from_world;
};

using ImageRange = std::pair<int, int>;  // the first one, and the one after the last

// Every `step`-th image of a range of a sequence, if it has a true pose.
std::vector<View> ReadViews(const std::string& folder, const ImageRange& range, int step) {
  SequenceIndex index = OpenSequence(folder);
  const Calibration calibration = ResolveCalibration({}, "", &index);
  const RgbdDecoder decoder(index, calibration);
  FrameBuilder builder({}, decoder.calibration().camera, decoder.calibration().distortion);
  std::vector<View> views;
  for (int i = range.first; i < std::min(range.second, decoder.size()); i += step) {
    const std::optional<Rigid3> world_from_cam =
        InterpolatePose(index.ground_truth, index.entries[i].timestamp);
    if (!world_from_cam) continue;
    views.push_back({std::make_shared<const Frame>(builder.Build(decoder.Decode(i))),
                     world_from_cam->Inverse()});
  }
  if (views.empty()) throw std::runtime_error(folder + ": no images with a true pose");
  return views;
}

// Whether a view shows a point of its camera: it is in the image, and as distant as what it shows.
bool Shows(const Frame& frame, const Eigen::Vector3d& x_in_cam) {
  constexpr double kTolerance = DepthRanges::kTolerance;
  if (x_in_cam.z() <= 0.0 || frame.depth_ranges.cells.empty()) return false;
  const Eigen::Vector2d pixel = frame.camera.Project(x_in_cam);
  if (!frame.camera.IsInside(pixel)) return false;
  const DepthRanges::Cell& cell =
      frame.depth_ranges.cells[DepthRanges::CellOf(frame.camera, pixel)];
  const double inverse_depth = 1.0 / x_in_cam.z();
  return cell.HasDepth() && inverse_depth > (1.0 - kTolerance) * cell.min_inverse_depth &&
         inverse_depth < (1.0 + kTolerance) * cell.max_inverse_depth;
}

// Whether a keyframe is a right answer: it shows at least 30 % of the points of the query that have
// a depth, from within 45 degrees.
bool IsRight(const View& query, const View& keyframe) {
  constexpr double kMinOverlap = 0.3;
  constexpr double kMaxAngle = DegreesToRadians(45.0);
  const Rigid3 keyframe_from_query = keyframe.cam_from_world * query.cam_from_world.Inverse();
  const Eigen::Vector3d axis = keyframe_from_query.rotation() * Eigen::Vector3d::UnitZ();
  if (axis.z() < std::cos(kMaxAngle)) return false;
  int num_points = 0, num_shown = 0;
  for (size_t i = 0; i < query.frame->points.size(); ++i) {
    if (query.frame->points[i].inverse_depth <= 0.0) continue;
    const Eigen::Vector3d x_in_query = query.frame->PointInCamera(static_cast<int>(i));
    ++num_points;
    num_shown += Shows(*keyframe.frame, keyframe_from_query * x_in_query) ? 1 : 0;
  }
  return num_points > 0 && num_shown >= kMinOverlap * num_points;
}

struct Answer {
  double score = 0.0;  // of the best-ranked keyframe
  int rank = -1;       // of the best-ranked right keyframe, from 0; -1: none is right
  bool has_right = false;
};

Answer Ask(const PlaceIndex& index, const std::vector<View>& keyframes, const View& query) {
  std::vector<bool> is_right;
  for (const View& keyframe : keyframes) is_right.push_back(IsRight(query, keyframe));
  Answer answer;
  answer.has_right = std::count(is_right.begin(), is_right.end(), true) > 0;
  const std::vector<Place> places = index.Query(*query.frame, index.size());
  for (size_t i = 0; i < places.size() && answer.rank < 0; ++i) {
    if (is_right[places[i].keyframe]) answer.rank = static_cast<int>(i);
  }
  if (!places.empty()) answer.score = places.front().score;
  return answer;
}

double Ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

// Of the queries that have a right keyframe, the ratio that has one among the first `num`.
double RecallAt(int num, const std::vector<Answer>& answers) {
  int num_queries = 0, num_found = 0;
  for (const Answer& answer : answers) {
    num_queries += answer.has_right ? 1 : 0;
    num_found += answer.rank >= 0 && answer.rank < num ? 1 : 0;
  }
  return Ratio(num_found, num_queries);
}

// Of the queries, the ratio whose best-ranked keyframe is right.
double Precision(const std::vector<Answer>& answers) {
  const auto is_right = [](const Answer& answer) { return answer.rank == 0; };
  return Ratio(std::count_if(answers.begin(), answers.end(), is_right), answers.size());
}

// Recall at 1 with the smallest threshold of the score that accepts no wrong keyframe.
double RecallWithoutErrors(std::vector<Answer> answers) {
  double threshold = 0.0;
  for (const Answer& answer : answers) {
    if (answer.rank != 0) threshold = std::max(threshold, answer.score);
  }
  for (Answer& answer : answers) {
    if (answer.score <= threshold) answer.rank = -1;
  }
  return RecallAt(1, answers);
}

void Measure(const std::vector<View>& keyframes, const std::vector<View>& queries) {
  PlaceIndex index;
  for (size_t i = 0; i < keyframes.size(); ++i) {
    index.Add(static_cast<KeyframeId>(i), keyframes[i].frame);
  }
  std::vector<Answer> answers;
  for (const View& query : queries) answers.push_back(Ask(index, keyframes, query));
  const auto has_right = [](const Answer& answer) { return answer.has_right; };
  std::printf(
      "%zu keyframes, %zu queries, %d of them with a right keyframe\n"
      "recall at 1, 5, 10: %.3f %.3f %.3f, precision at 1: %.3f, recall without errors: %.3f\n",
      keyframes.size(), queries.size(),
      static_cast<int>(std::count_if(answers.begin(), answers.end(), has_right)),
      RecallAt(1, answers), RecallAt(5, answers), RecallAt(10, answers), Precision(answers),
      RecallWithoutErrors(answers));
}

int RunRecall(int argc, char** argv) try {
  std::string index_folder, query_folder;
  ImageRange indexed{0, 1000000}, queried{0, 1000000};
  int step = 10;
  CLI::App app("Recall and precision of place recognition");
  app.add_option("index", index_folder, "Sequence of the keyframes, with ground truth")->required();
  app.add_option("queries", query_folder, "Sequence of the queries, with ground truth")->required();
  app.add_option("--index-images", indexed, "First image, and the one after the last")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--query-images", queried, "First image, and the one after the last")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--step", step, "Uses every STEP-th image of both")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  Measure(ReadViews(index_folder, indexed, step), ReadViews(query_folder, queried, step));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}

}  // namespace

}  // namespace msc_vo

int main(int argc, char** argv) { return msc_vo::RunRecall(argc, argv); }
